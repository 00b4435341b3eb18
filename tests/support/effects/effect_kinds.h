// How each kind of effect is drawn for a bench, resized, and applied to the simulator.
#ifndef PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_KINDS_H_
#define PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_KINDS_H_

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/bench/bench_effects.h"

namespace plenum::test {

inline constexpr double kUnitC = 1e-8;                     // m³/(s·Pa) in 1 dm³/(s·bar)
inline constexpr double kLaminarUnit = 1e-3 / 60.0 / 1e5;  // m³/(s·Pa) in 1 L/(min·bar)
inline constexpr double kMl = 1e-6, kKpa = 1e3;

using Parameters = std::vector<std::pair<std::string, double>>;

struct Bench {
  const BenchRig& rig;
  double rise_s;
  Random& random;

  double LineC() const { return rig.fill.conductance / kUnitC; }
  double RestMl() const { return rig.rest_volume_m3 / kMl; }
  double OperatingKpa() const { return rig.operating_gauge_pa / kKpa; }
  double AnyRatio() const { return random.Uniform(0.1, 0.5); }
};

struct Kind {
  std::function<Parameters(const Bench&)> draw;
  std::function<void(TrueEffect&, double)> resize;
  std::function<void(const TrueEffect&, const BenchRig&, EffectRig&)> apply;
};

inline auto Times(std::string name) {  // the named parameter in proportion to the size
  return [=](TrueEffect& e, double size) { e[name] *= size; };
}
inline auto TimesAboutOne(std::string name) {
  return [=](TrueEffect& e, double size) { e[name] = 1.0 + size * (e[name] - 1.0); };
}
inline auto ByRoot(std::string name) {  // 1/parameter² in proportion to the size
  return [=](TrueEffect& e, double size) { e[name] /= std::sqrt(size); };
}

// By id: the effects that the program knows, and those that it does not know.
const std::map<std::string, Kind>& ListedKinds();
const std::map<std::string, Kind>& OutsideKinds();

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_KINDS_H_
