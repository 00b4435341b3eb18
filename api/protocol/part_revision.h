// Measured numbers of a diagnosis into a part of the catalogue.
//
// A number that the part holds already is met as follows:
//   * measured before on the same piece: both combine with weights 1/(u·value)², u the relative
//     standard deviations;
//   * measured before on other pieces of the type: the part holds the mean of the pieces, and the
//     uncertainty of a piece drawn at random (piece_tests.h);
//   * of any other provenance: the measurement takes its place.
// Where an earlier test of the piece, or a sheet (datasheet, third party, derived), is off by more
// than both uncertainties (95 % of a measurement, else the half-width of the provenance,
// catalog/fields/half_width.h), the contradiction is told and that number is not written, the
// others are; asked for, the new measurement stands in its place. An estimate that is off is told
// as a warning and written over.
// A pump's curve is one number at all its points; its uncertainty is the largest of the points with
// at least kCurveShare of the largest delivery.
#ifndef PLENUM_API_PROTOCOL_PART_REVISION_H_
#define PLENUM_API_PROTOCOL_PART_REVISION_H_

#include <optional>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "api/measure/diagnosis_document.h"
#include "catalog/fields/part.h"
#include "catalog/store/store.h"

namespace plenum::api {

struct PartRevision {
  std::optional<catalog::Part> part;  // to be written; none: nothing is
  // { "part", "specimen", "numbers": [{ "field", "before", "before_uncertainty",
  //   "before_provenance", "measured", "uncertainty", "value", "combined", "pieces", "spread",
  //   "standard_error", "contradiction", "warning", "written" }], "refused": [ reasons ] }
  Json told;
};

// `answer` is the diagnosis/1 of recordings `files`; `anyway` writes contradicted numbers, too.
// `specimen` is the piece of the type that was tested; "": a piece without a name.
PartRevision RevisePart(const catalog::Part& part, const Json& answer,
                        const std::vector<Provenance::File>& files, bool anyway,
                        const std::string& specimen = "");

// Why a measurement gives nothing for the part; "" where it does or where `id` is "".
std::string WhyNotMeasured(const calibration::Dataset& dataset, const std::string& id);

// Why this is no name of a piece of the part `id`, which is "" where none is saved; or "".
inline constexpr std::size_t kSpecimenNameMax = 64;
std::string WhyInvalidSpecimen(const std::string& specimen, const std::string& id);

// The revision written, by one transaction: `told` with "revision", its name; null: refused.
Json SavePart(catalog::Store& store, const std::string& id, const Json& answer,
              const std::vector<Provenance::File>& files, bool anyway, const catalog::Signature& by,
              const std::string& specimen = "");

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_PART_REVISION_H_
