#include "api/measure/revision_of_diagnosis.h"

#include <algorithm>

#include "api/simulate/effects.h"
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
  return std::any_of(diagnosis.numbers.begin(), diagnosis.numbers.end(),
                     [&](const auto& wrong) { return wrong.number == number; });
}

}  // namespace

// A declared number that is wrong is the measured rig's and no property of the part: it stays out.
SavedModel RevisionOf(const calibration::Diagnosis& diagnosis, const Provenance& provenance) {
  SavedModel model;
  std::vector<double> sizes;      // of what is kept, 1 in SI in its unit
  std::vector<std::size_t> kept;  // of the rows of the estimates' covariance
  std::size_t row = 0;
  const calibration::Estimates& estimates =
      diagnosis.learned ? diagnosis.discrepancy->beside : diagnosis;
  const calibration::ErrorReport& after = diagnosis.learned ? *diagnosis.learned : diagnosis.after;
  for (const calibration::FittedEffect& fitted : estimates.effects) {
    model.effects.push_back(fitted.effect);
    for (std::size_t i = 0; i < fitted.parameters.size(); ++i) {
      if (model::OfEachRun(fitted.effect.spec->parameters[i])) continue;
      const UnitOfParameter unit = UnitOfFitted(fitted.effect, i);
      model.covariance.parameters.push_back(unit.name);
      sizes.push_back(unit.size);
      kept.push_back(row++);
    }
  }
  for (const auto& [number, estimate] : estimates.fitted) {
    const std::size_t own = row++;
    if (IsWrong(diagnosis, number)) continue;
    kept.push_back(own);
    model.factors.emplace_back(number, estimate.value);
    model.covariance.parameters.emplace_back(calibration::Name(number));
    sizes.push_back(1.0);
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    std::vector<double>& of_one = model.covariance.rows.emplace_back();
    for (std::size_t j = 0; j < kept.size(); ++j)
      of_one.push_back(sizes[i] * sizes[j] * estimates.covariance[kept[i]][kept[j]]);
  }
  for (const Provenance::File& file : provenance.files)
    model.data.push_back({file.name, file.sha256});
  model.noise_pa = diagnosis.noise_pa;
  model.before_rms_pa = diagnosis.before.rms_pa;
  model.after_rms_pa = after.rms_pa;
  model.holdout_rms_pa = after.holdout_rms_pa;
  return model;
}

}  // namespace plenum::api
