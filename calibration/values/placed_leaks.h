// Leaks of one of several chambers, as specs of their own: "leak[2]" is a leak of the second one.
// A set of effects may hold one of each chamber, and sets with leaks of different chambers may tie.
// The simulator knows them by the spec without a chamber.
#ifndef PLENUM_CALIBRATION_VALUES_PLACED_LEAKS_H_
#define PLENUM_CALIBRATION_VALUES_PLACED_LEAKS_H_

#include <cstddef>
#include <optional>
#include <string>

#include "model/effects/effect.h"

namespace plenum::calibration {

inline constexpr std::size_t kChambersMax = 8;

bool IsLeak(const model::EffectSpec& spec);

// The leak, of any law, in that chamber, counted without a junction.
const model::EffectSpec& InChamber(const model::EffectSpec& leak, std::size_t chamber);

// Of such a spec; none of others.
std::optional<std::size_t> ChamberOfLeak(const model::EffectSpec& spec);

// The spec that the simulator knows.
const model::EffectSpec& WithoutChamber(const model::EffectSpec& spec);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_PLACED_LEAKS_H_
