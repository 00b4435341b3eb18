// Measured numbers of a diagnosis into a part of the catalogue.
//
// A number that the part holds already is met as follows, u the relative standard deviations:
//   * measured before, with its uncertainty: both combine with weights 1/(u·value)²;
//   * of any other provenance: the measurement takes its place;
//   * where both differ by more than their uncertainties (95 % of a measurement, else the
//   half-width
//     of the provenance, catalog/fields/half_width.h) the contradiction is told and nothing is
//     written, unless that is asked for: then the new measurement alone stands.
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

inline constexpr double kCurveShare = 0.1;

struct PartRevision {
  std::optional<catalog::Part> part;  // to be written; none: refused
  // { "part", "numbers": [{ "field", "before", "before_uncertainty", "before_provenance",
  //   "measured", "uncertainty", "value", "combined", "contradiction" }], "refused": [ reasons ] }
  Json told;
};

// `answer` is the diagnosis/1 of recordings `files`; `anyway` writes contradicted numbers, too.
PartRevision RevisePart(const catalog::Part& part, const Json& answer,
                        const std::vector<Provenance::File>& files, bool anyway);

// Why a measurement gives nothing for the part; "" where it does or where `id` is "".
std::string WhyNotMeasured(const calibration::Dataset& dataset, const std::string& id);

// The revision written, by one transaction: `told` with "revision", its name; null: refused.
Json SavePart(catalog::Store& store, const std::string& id, const Json& answer,
              const std::vector<Provenance::File>& files, bool anyway,
              const catalog::Signature& by);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_PART_REVISION_H_
