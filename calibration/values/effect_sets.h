// Sets of effects that a search tries. A declared number that may be wrong stands in them as an
// effect without parameters: a set that holds it frees the number (model_state.h).
#ifndef PLENUM_CALIBRATION_VALUES_EFFECT_SETS_H_
#define PLENUM_CALIBRATION_VALUES_EFFECT_SETS_H_

#include <optional>
#include <string_view>
#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"
#include "calibration/values/placed_leaks.h"
#include "model/effects/effect.h"

namespace plenum::calibration {

using EffectSet = std::vector<const model::EffectSpec*>;  // in the order of the registry

// "number:source_pressure"; of one of several chambers "number:rest_volume[2]".
const model::EffectSpec& Freeing(Declared number);
const model::EffectSpec& Freeing(Declared number, std::size_t chamber);
std::optional<Declared> FreedBy(const model::EffectSpec& spec);
// The chamber, where it is a number of one of several.
std::optional<std::size_t> ChamberFreedBy(const model::EffectSpec& spec);
// Sets what the spec frees.
void Free(const model::EffectSpec& spec, Freed& freed);
// What is freed.
EffectSet SpecsOf(const Freed& freed);
EffectSet EffectsAlone(EffectSet set);

// Whether the registry has `a` before `b`; numbers come after all effects.
bool Precedes(const model::EffectSpec* a, const model::EffectSpec* b);

EffectSet With(EffectSet set, const model::EffectSpec* in);
EffectSet Without(EffectSet set, const model::EffectSpec* out);

bool HoldsId(const EffectSet& set, std::string_view id);

// A term that stands for what has no name (discrepancy.h).
bool IsLearned(const model::EffectSpec& spec);

// Whether the model has the effect in all of the runs: not one of a single direction where a source
// below ambient has gas cross the line the other way, nor one of a supply whose flow is given.
bool HasPlace(const model::EffectSpec& spec, const std::vector<Run>& runs);

// The effects that have a name, of which the runs can tell: a valve that never opens tells nothing
// of itself, of its line and of what feeds it. Of several chambers each may leak.
EffectSet NamedEffects(const std::vector<Run>& runs);

// The declared numbers that may be wrong and of which the runs can tell, the unknown ones apart,
// which are fitted freely as it is. Nor is the operating pressure one: it is no property of the rig
// but the point at which the expansion ratio holds, and both have one effect on the volume. Zero
// and gain of the gauge beyond its accuracy are the effects sensor_offset and sensor_gain.
EffectSet NumbersThatMayBeWrong(const Dataset& dataset);

// What a set may hold: those effects, then those numbers.
EffectSet Nameable(const Dataset& dataset);

// How many numbers the set adds to a model.
std::size_t NumbersOf(const EffectSet& set);

// Effects that shift strokes in time, as a clock does.
bool ActsInTime(const model::EffectSpec& spec);

// Effects that ring: a simulation less exact damps them, and where they ring in step is all that
// tells them.
bool Rings(const model::EffectSpec& spec);
bool AnyRings(const EffectSet& set);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_EFFECT_SETS_H_
