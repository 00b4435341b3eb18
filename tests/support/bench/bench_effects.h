// Effects with parameters as a bench might show them, and their sizes.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_EFFECTS_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_EFFECTS_H_

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/bench/bench_rig.h"

namespace plenum::test {

// One effect in the units of the contract. For what the contract does not list the parameters are
// those of unlisted_effects.h, shares or SI.
struct TrueEffect {
  std::string id;
  std::string law;  // of a leak, else empty
  std::vector<std::pair<std::string, double>> parameters;
  double operator[](std::string_view name) const;
  double& operator[](std::string_view name);
};

// Ids. Listed: those of the contract, and two more that the program knows. Outside: those it does
// not know.
const std::vector<std::string>& ListedEffects();
const std::vector<std::string>& OutsideEffects();

// Whether the effect can show on a bench with that supply.
bool Shows(const std::string& id, BenchSupply supply);

// Typical parameters for the rig, whose rise takes `rise_s`.
TrueEffect DrawEffect(const std::string& id, const BenchRig& rig, double rise_s, Random& random);

// The same effect `size` times as large: its residual grows about in proportion, and it vanishes
// with the size. What is scaled: flow of a leak, volume of creep and dead volume, widths, delays,
// pressures, time constants of heat and sensor, deviation from 1 of gain and fill factor, 1/ω² of
// inertia, 1/C² of the restriction and of the droop's refill, length of the tube, shares.
TrueEffect Sized(const TrueEffect& effect, double size);

// Within what is physically possible: a volume that grows with pressure, a conductance above 0.
bool Possible(const TrueEffect& effect, const BenchRig& rig);

// The effect in the simulator. `stream` makes what is random in it — strokes that stick, the phase
// of a swinging regulator — different in every run and the same every time.
void Apply(const TrueEffect& effect, const BenchRig& rig, std::uint64_t stream, EffectRig& plant);

// What a drifting sensor adds, at a time of the session; 0 for every other effect.
double Drift(const TrueEffect& effect, double session_s);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_EFFECTS_H_
