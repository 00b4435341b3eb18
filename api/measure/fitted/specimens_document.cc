#include "api/measure/fitted/specimens_document.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "api/measure/fitted/fitted_numbers.h"
#include "api/measure/words/effect_words.h"
#include "calibration/values/specimens.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Declared;
using calibration::Diagnosis;
using calibration::FittedFactor;

// Of that specimen alone, or of all.
bool BelongsTo(const FittedFactor& fitted, std::size_t specimen) {
  if (static_cast<int>(fitted.number) >= calibration::kOfActuator) return false;
  return !fitted.specimen || *fitted.specimen == specimen;
}

// Why a specimen has no fitted number.
std::string WhyNoneFitted(const Diagnosis& diagnosis, const Dataset& dataset) {
  const bool others =
      std::any_of(diagnosis.fitted.begin(), diagnosis.fitted.end(),
                  [](const FittedFactor& fitted) { return fitted.specimen.has_value(); });
  if (others) return "no fit saw a run of it: it has the mean of the other specimens";
  const auto& uncertainty = dataset.relative_uncertainty;
  const bool exact =
      std::all_of(uncertainty.begin(), uncertainty.begin() + calibration::kOfActuator,
                  [](double one) { return one == 0.0; });
  return exact ? "its numbers are declared as exact" : "no number of it was fitted";
}

Json RenderSpecimen(const Diagnosis& diagnosis, const Dataset& dataset, std::size_t specimen) {
  Json runs = Json::array(), numbers = Json::object();
  for (const calibration::Run& run : dataset.runs)
    if (run.specimen == specimen) runs.push_back(run.id);
  std::string words;
  for (const FittedFactor& fitted : diagnosis.fitted) {
    const auto declared = DeclaredIn(dataset, fitted.number, specimen);
    if (!BelongsTo(fitted, specimen) || !declared) continue;
    const std::string name(calibration::Name(fitted.number));
    const double one = declared->in_unit();
    numbers[name] = RenderFactor(fitted, *declared);
    words += words.empty() ? "" : "; ";
    words += NumberInWords(name, one, fitted.factor.value * one, declared->unit);
  }
  if (words.empty()) words = WhyNoneFitted(diagnosis, dataset);
  return {{"name", SpecimenName(dataset.specimens[specimen])},
          {"runs", std::move(runs)},
          {"fitted", std::move(numbers)},
          {"words", std::move(words)}};
}

Json SpreadOf(const Diagnosis& diagnosis, const Dataset& dataset) {
  Json spread = Json::object();
  for (int k = 0; k < calibration::kOfActuator; ++k) {
    const auto number = static_cast<Declared>(k);
    std::vector<double> values;
    for (const FittedFactor& fitted : diagnosis.fitted)
      if (const auto declared = DeclaredIn(dataset, number, fitted.specimen);
          fitted.number == number && fitted.specimen && declared)
        values.push_back(fitted.factor.value * declared->value);
    if (values.size() > 1)
      spread[std::string(calibration::Name(number))] =
          Number(calibration::DeviationOf(values) / calibration::MeanOf(values));
  }
  return spread;
}

}  // namespace

void AddSpecimens(const Diagnosis& diagnosis, const Dataset& dataset, Json& answer) {
  if (dataset.specimens.empty()) return;
  Json& pieces = answer[dataset.several ? "chambers" : "specimens"] = Json::array();
  for (std::size_t specimen = 0; specimen < dataset.specimens.size(); ++specimen)
    pieces.push_back(RenderSpecimen(diagnosis, dataset, specimen));
  if (!dataset.several) answer["specimen_spread"] = SpreadOf(diagnosis, dataset);
}

}  // namespace plenum::api
