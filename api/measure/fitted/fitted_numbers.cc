#include "api/measure/fitted/fitted_numbers.h"

#include <algorithm>
#include <string>
#include <utility>

#include "api/json/units.h"
#include "api/measure/words/effect_words.h"
#include "calibration/values/specimens.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Declared;
using calibration::Estimate;
using calibration::FittedFactor;
using calibration::Run;

std::optional<DeclaredNumber> DeclaredOfRun(const Run& run, Declared number) {
  const auto first_piece = [&](bool tube) {
    return std::find_if(run.line.begin(), run.line.end(),
                        [&](const auto& piece) { return piece.tube.has_value() == tube; });
  };
  const double ambient = run.ambient.pressure_pa;
  switch (number) {
    case Declared::kRestVolume:
      return DeclaredNumber{run.chamber.rest_volume_m3, kM3PerMl, "ml"};
    case Declared::kExpansionRatio:
      return DeclaredNumber{run.chamber.expansion_ratio, 1.0, "1"};
    case Declared::kOperatingPressure:
      return DeclaredNumber{run.chamber.operating_pressure_pa - ambient, kPaPerKpa, "kpa_gauge"};
    case Declared::kSourcePressure:
      if (run.supply == calibration::Supply::kNone) return {};
      return DeclaredNumber{run.source_pressure_pa - ambient, kPaPerKpa, "kpa_gauge"};
    case Declared::kSonicConductance:
    case Declared::kCriticalRatio: {
      const auto piece = first_piece(false);
      if (piece == run.line.end()) return {};
      if (number == Declared::kCriticalRatio)
        return DeclaredNumber{piece->fill.critical_ratio, 1.0, "1"};
      return DeclaredNumber{piece->fill.sonic_conductance_m3_per_s_pa, kM3PerSPaPerDm3PerSBar,
                            "dm3_per_s_bar"};
    }
    case Declared::kTubeInnerDiameter: {
      const auto piece = first_piece(true);
      if (piece == run.line.end()) return {};
      return DeclaredNumber{piece->tube->inner_diameter_m, kMPerMm, "mm"};
    }
    case Declared::kReservoirVolume:
      if (run.reservoir_volume_m3 <= 0.0) return {};
      return DeclaredNumber{run.reservoir_volume_m3, kM3PerMl, "ml"};
    case Declared::kAmbientPressure:
      return DeclaredNumber{ambient, kPaPerKpa, "kpa_abs"};
    case Declared::kSensorZero:
      return DeclaredNumber{calibration::kSensorZeroPa, kPaPerKpa, "kpa", 1.0};
    case Declared::kSensorGain:
      return DeclaredNumber{1.0, 1.0, "1"};
  }
  return {};
}

}  // namespace

std::optional<DeclaredNumber> DeclaredIn(const Dataset& dataset, Declared number,
                                         std::optional<std::size_t> specimen) {
  std::optional<DeclaredNumber> declared;
  if (dataset.several && specimen) {
    Run run = dataset.runs.front();
    run.chamber = calibration::ChamberOf(run, *specimen);
    return DeclaredOfRun(run, number);
  }
  for (const Run& run : dataset.runs)
    if (!declared && (!specimen || run.specimen == *specimen))
      declared = DeclaredOfRun(run, number);
  return declared;
}

Json RenderEstimate(const Estimate& estimate, double factor) {
  return {{"value", Number(estimate.value / factor)},
          {"ci95", Json::array({Number(estimate.low / factor), Number(estimate.high / factor)})},
          {"identified", estimate.identified}};
}

Json RenderFactor(const FittedFactor& fitted, const DeclaredNumber& declared) {
  const double one = declared.in_unit(), origin = declared.origin;
  const Estimate& factor = fitted.factor;
  Json rendered = RenderEstimate(
      {factor.value - origin, factor.low - origin, factor.high - origin, factor.identified},
      1.0 / one);
  rendered["declared"] = Number((1.0 - origin) * one);
  rendered["unit"] = declared.unit;
  rendered["factor"] = Number(factor.value);
  return rendered;
}

Json RenderFitted(const std::vector<FittedFactor>& factors, const Dataset& dataset) {
  Json document = Json::object();
  for (const FittedFactor& fitted : factors) {
    std::string name(calibration::Name(fitted.number));
    if (dataset.several && fitted.specimen) name += "[" + dataset.specimens[*fitted.specimen] + "]";
    const auto declared = DeclaredIn(dataset, fitted.number, fitted.specimen);
    if (!declared || document.contains(name)) continue;
    document[name] = RenderFactor(fitted, *declared);
    if (fitted.specimen)
      document[name][dataset.several ? "chamber" : "specimen"] =
          SpecimenName(dataset.specimens[*fitted.specimen]);
  }
  return document;
}

Json RenderWrong(const calibration::WrongNumber& wrong, const Dataset& dataset) {
  std::optional<std::size_t> specimen;
  std::string name(calibration::Name(wrong.number));
  if (wrong.specimen) {
    const auto found =
        std::find(dataset.specimens.begin(), dataset.specimens.end(), *wrong.specimen);
    specimen = static_cast<std::size_t>(found - dataset.specimens.begin());
    name += calibration::OfSpecimenInWords(*wrong.specimen);
  }
  const std::optional<DeclaredNumber> declared = DeclaredIn(dataset, wrong.number, specimen);
  const double one = declared ? declared->in_unit() : 1.0;
  const std::string unit = declared ? declared->unit : "1";
  Json document = {
      {"name", calibration::Name(wrong.number)},
      {"declared", Number(one)},
      {"fitted", Number(wrong.factor * one)},
      {"unit", unit},
      {"deviation_sigma", wrong.deviation_sigma ? Number(*wrong.deviation_sigma) : Json(nullptr)},
      {"instead_of", wrong.instead_of},
      {"words", NumberInWords(name, one, wrong.factor * one, unit)}};
  if (wrong.specimen)
    document[dataset.several ? "chamber" : "specimen"] = SpecimenName(*wrong.specimen);
  return document;
}

Json SpecimenName(const std::string& name) { return name.empty() ? Json(nullptr) : Json(name); }

}  // namespace plenum::api
