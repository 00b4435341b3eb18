// Which effects act on which chamber of several: of the valve, the line and the supply on the one
// that the valve leads to; of walls and of the gas on all, but for the junction; a leak on the
// chamber that it is of (values/effect_sets.h); dead volume, outgassing and learned flows on the
// first; of the gauge on the one with the gauge.
#ifndef PLENUM_CALIBRATION_FIT_RIG_RIG_EFFECTS_H_
#define PLENUM_CALIBRATION_FIT_RIG_RIG_EFFECTS_H_

#include <cstddef>
#include <string_view>
#include <vector>

#include "calibration/values/dataset.h"
#include "model/effects/effect.h"

namespace plenum::calibration {

// Of the list those on group `group` of the run's rig, as the simulator knows them.
std::vector<model::Effect> EffectsOn(const std::vector<model::Effect>& effects, const Run& run,
                                     std::size_t group);

// Of the numbers of one effect of the list those in the groups of the rig.
std::vector<const double*> NumbersOfEffect(const std::vector<model::Effect>& effects,
                                           std::size_t effect, std::size_t number, const Run& run,
                                           const model::Rig& rig);

// Null where the effect has no such parameter.
double* NumberNamed(model::Effect& effect, std::string_view name);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RIG_RIG_EFFECTS_H_
