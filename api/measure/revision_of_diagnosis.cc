#include "api/measure/revision_of_diagnosis.h"

#include <algorithm>

#include "api/simulate/effects.h"
#include "calibration/values/specimens.h"
#include "model/effects/learned/learned.h"

namespace plenum::api {
namespace {

// The name of an effect's parameter in the contract and how large 1 in SI is in its unit.
struct UnitOfParameter {
  std::string name;
  double size = 1.0;
};

UnitOfParameter UnitOfFitted(const model::Effect& effect, std::size_t parameter) {
  model::Effect one = effect;
  one.parameters.assign(effect.parameters.size(), 0.0);
  one.parameters[parameter] = 1.0;
  const Json rendered = RenderEffects({&one, 1})[0]["parameters"];
  for (const auto& [name, value] : rendered.items())
    if (value.is_number() && value.get<double>() != 0.0)
      return {std::string(effect.spec->id) + "." + name, value.get<double>()};
  return {std::string(effect.spec->id)};
}

bool IsWrong(const calibration::Diagnosis& diagnosis, calibration::Declared number) {
  const auto is_it = [&](const auto& wrong) { return wrong.number == number; };
  const auto& tied = diagnosis.tied_sets;
  return std::any_of(diagnosis.numbers.begin(), diagnosis.numbers.end(), is_it) ||
         (!tied.empty() &&
          std::any_of(tied.front().numbers.begin(), tied.front().numbers.end(), is_it));
}

// A number of a saved model: the mean of some rows of the estimates' covariance. They are one but
// of a declared number that each specimen has.
struct Kept {
  std::string name;
  double size = 1.0;  // 1 in SI in its unit
  std::vector<std::size_t> rows = {};
  double scatter = 0.0;  // standard deviation between specimens: the model is that of another piece
};

double CovarianceOf(const Kept& a, const Kept& b, const calibration::Estimates& estimates) {
  double sum = 0.0;
  for (const std::size_t i : a.rows)
    for (const std::size_t j : b.rows) sum += estimates.covariance[i][j];
  return a.size * b.size * sum / static_cast<double>(a.rows.size() * b.rows.size());
}

// The declared numbers but wrong ones, whose rows begin at `row`.
void KeepFactors(const calibration::Diagnosis& diagnosis, const calibration::Estimates& estimates,
                 std::size_t row, std::vector<Kept>& kept, SavedModel& model) {
  for (int k = 0; k < calibration::kDeclaredCount; ++k) {
    const auto number = static_cast<calibration::Declared>(k);
    Kept one{std::string(calibration::Name(number))};
    std::vector<double> factors;
    for (std::size_t i = 0; i < estimates.fitted.size(); ++i) {
      if (estimates.fitted[i].number != number) continue;
      one.rows.push_back(row + i);
      factors.push_back(estimates.fitted[i].factor.value);
    }
    if (factors.empty() || IsWrong(diagnosis, number)) continue;
    if (factors.size() > 1) one.scatter = calibration::DeviationOf(factors);
    model.factors.emplace_back(number, calibration::MeanOf(factors));
    kept.push_back(std::move(one));
  }
}

}  // namespace

// A declared number that is wrong is the measured rig's and no property of the part: it stays out.
SavedModel RevisionOf(const calibration::Diagnosis& diagnosis, const Provenance& provenance) {
  SavedModel model;
  std::vector<Kept> kept;
  std::size_t row = 0;
  const calibration::Estimates& estimates =
      diagnosis.learned ? diagnosis.discrepancy->beside : diagnosis;
  const calibration::ErrorReport& after = diagnosis.learned ? *diagnosis.learned : diagnosis.after;
  const bool first_of_tie = !diagnosis.learned && !diagnosis.tied_sets.empty();
  for (const calibration::FittedEffect& fitted :
       first_of_tie ? diagnosis.tied_sets.front().effects : estimates.effects) {
    model.effects.push_back(fitted.effect);
    for (std::size_t i = 0; i < fitted.parameters.size(); ++i) {
      if (model::OfEachRun(fitted.effect.spec->parameters[i])) continue;
      const UnitOfParameter unit = UnitOfFitted(fitted.effect, i);
      kept.push_back({unit.name, unit.size, {row++}});
    }
  }
  KeepFactors(diagnosis, estimates, row, kept, model);
  for (const Kept& one : kept) {
    model.covariance.parameters.push_back(one.name);
    std::vector<double>& of_one = model.covariance.rows.emplace_back();
    for (const Kept& other : kept)
      of_one.push_back(CovarianceOf(one, other, estimates) +
                       (&one == &other ? one.scatter * one.scatter : 0.0));
  }
  for (const Provenance::File& file : provenance.files)
    model.data.push_back({file.name, file.sha256});
  model.tied = diagnosis.tied;
  model.noise_pa = diagnosis.noise_pa;
  model.before_rms_pa = diagnosis.before.rms_pa;
  model.after_rms_pa = after.rms_pa;
  model.holdout_rms_pa = after.holdout_rms_pa;
  return model;
}

}  // namespace plenum::api
