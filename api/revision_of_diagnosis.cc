#include "api/revision_of_diagnosis.h"

#include <cmath>

#include "api/effects.h"

namespace plenum::api {
namespace {

constexpr double kIntervalSigmas = 2.0 * 1.96;  // width of a 95 % interval

void AddVariance(const std::string& name, double deviation, std::vector<double>& variances,
                 SavedModel& model) {
  model.covariance.parameters.push_back(name);
  variances.push_back(deviation * deviation);
}

// The effect's deviations in the contract's units, which are proportional to the model's.
Json Deviations(const calibration::FittedEffect& fitted) {
  model::Effect deviations = fitted.effect;
  for (std::size_t i = 0; i < deviations.parameters.size(); ++i)
    deviations.parameters[i] =
        (fitted.parameters[i].high - fitted.parameters[i].low) / kIntervalSigmas;
  return RenderEffects({&deviations, 1})[0]["parameters"];
}

}  // namespace

SavedModel RevisionOf(const calibration::Diagnosis& diagnosis, const Provenance& provenance) {
  SavedModel model;
  std::vector<double> variances;
  for (const calibration::FittedEffect& fitted : diagnosis.effects) {
    model.effects.push_back(fitted.effect);
    for (const auto& [name, deviation] : Deviations(fitted).items())
      if (deviation.is_number())
        AddVariance(std::string(fitted.effect.spec->id) + "." + name, deviation.get<double>(),
                    variances, model);
  }
  for (const auto& [number, estimate] : diagnosis.fitted) {
    model.factors.emplace_back(number, estimate.value);
    AddVariance(std::string(calibration::Name(number)),
                (estimate.high - estimate.low) / kIntervalSigmas, variances, model);
  }
  for (std::size_t i = 0; i < variances.size(); ++i) {
    model.covariance.rows.emplace_back(variances.size(), 0.0);
    model.covariance.rows[i][i] = variances[i];
  }
  for (const Provenance::File& file : provenance.files)
    model.data.push_back({file.name, file.sha256});
  model.noise_pa = diagnosis.noise_pa;
  model.before_rms_pa = diagnosis.before.rms_pa;
  model.after_rms_pa = diagnosis.after.rms_pa;
  model.holdout_rms_pa = diagnosis.after.holdout_rms_pa;
  return model;
}

}  // namespace plenum::api
