#include "api/measure/measured_document.h"

#include "api/json/units.h"
#include "api/measure/rig_parts.h"
#include "calibration/names/measured_numbers.h"

namespace plenum::api {
namespace {

using calibration::MeasuredNumber;

struct Unit {
  double factor;  // SI of one
  const char* name;
};

Unit UnitOf(MeasuredNumber::Kind kind) {
  switch (kind) {
    case MeasuredNumber::Kind::kConductance:
      return {kM3PerSPaPerDm3PerSBar, "dm3_per_s_bar"};
    case MeasuredNumber::Kind::kVolume:
      return {kM3PerMl, "ml"};
    case MeasuredNumber::Kind::kDelivery:
      return {kM3PerSPerLPerMin, "l_per_min"};
    case MeasuredNumber::Kind::kRatio:
      break;
  }
  return {1.0, "1"};
}

Json Render(const calibration::MeasuredEstimate& estimate, const calibration::Dataset& dataset) {
  const MeasuredNumber& number = dataset.measured[estimate.number];
  const Unit unit = UnitOf(number.kind);
  const std::string refused = calibration::WhyNotKept(dataset, estimate);
  Json row = {{"part", number.part},
              {"number", number.name},
              {"field", FieldOfMeasured(number.name)},
              {"declared", Number(estimate.declared / unit.factor)},
              {"fitted", Number(estimate.value / unit.factor)},
              {"unit", unit.name},
              {"uncertainty",
               estimate.low > 0.0 ? Number(estimate.deviation / estimate.value) : Json(nullptr)},
              {"interval_95", Json::array({Number(estimate.low / unit.factor),
                                           Number(estimate.high / unit.factor)})},
              {"refused", refused.empty() ? Json(nullptr) : Json(refused)}};
  if (number.kind == MeasuredNumber::Kind::kDelivery)
    row["pressure_kpa_gauge"] =
        Number(KpaGaugeFromPa(number.pressure_pa, dataset.runs.front().ambient));
  return row;
}

}  // namespace

void AddMeasured(const calibration::Diagnosis& diagnosis, const calibration::Dataset& dataset,
                 Json& answer) {
  answer["measured"] = answer["measured_refused"] = Json::array();
  if (dataset.measured.empty()) return;
  for (const calibration::MeasuredEstimate& estimate : diagnosis.measured)
    answer["measured"].push_back(Render(estimate, dataset));
  for (const std::string& reason : calibration::WhyNoRevision(dataset, diagnosis))
    answer["measured_refused"].push_back(reason);
}

}  // namespace plenum::api
