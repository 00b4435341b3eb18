// Numbers of a part's document that are given as data sheets print them.
#ifndef PLENUM_API_CATALOGUE_PRINTED_PRINTED_DOCUMENT_H_
#define PLENUM_API_CATALOGUE_PRINTED_PRINTED_DOCUMENT_H_

#include <string>

#include "api/json/reader.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Whether a field that the document has is given so: a sonic conductance as { "cv": 0.05 } or
// "Cv 0.05", a body as { "length_mm", "width_mm", "height_mm" }, { "diameter_mm", "length_mm" } or
// "70 x 30 x 50 mm", a battery's current as { "c_rate": 25 } or "25C", its capacity as {
// "energy_wh": 19.2 } or "19.2 Wh", a curve as { "free_flow_l_per_min", "current_a"? } or "free
// flow 12 L/min, 0.8 A".
bool IsPrinted(Reader& reader, const std::string& name);

// Derives those numbers of the part, once its other numbers are read: with formula and source.
void DerivePrinted(Reader& reader, const catalog::Family& family, catalog::Part& part);
// The same for a curve that is printed, once all numbers and texts are read.
void DerivePrintedCurve(Reader& reader, catalog::Part& part);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PRINTED_PRINTED_DOCUMENT_H_
