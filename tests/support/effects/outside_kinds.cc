#include <numbers>

#include "tests/support/effects/effect_kinds.h"

namespace plenum::test {

const std::map<std::string, Kind>& OutsideKinds() {
  static const std::map<std::string, Kind> kinds = {
      {"softening",
       {[](const Bench& b) {
          return Parameters{{"share", b.random.Uniform(0.1, 0.3)}};
        },
        Times("share"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.softening = {e["share"]};
        }}},
      {"kinking_line",
       {[](const Bench& b) {
          return Parameters{{"loss", b.random.Uniform(0.2, 0.6)}};
        },
        Times("loss"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.kinking_line = {e["loss"]};
        }}},
      {"second_chamber",
       {[](const Bench& b) {
          return Parameters{
              {"volume_m3", b.rig.rest_volume_m3 * b.random.Uniform(0.1, 0.5)},
              {"conductance", b.rig.fill.conductance * b.random.LogUniform(0.01, 0.1)},
              {"critical_ratio", b.AnyRatio()}};
        },
        Times("volume_m3"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.second_chamber = {e["volume_m3"], e["conductance"], e["critical_ratio"]};
        }}},
      {"gaping_seam",
       {[](const Bench& b) {
          return Parameters{
              {"open_share", b.random.Uniform(0.4, 0.8)},
              {"conductance", b.rig.fill.conductance * b.random.LogUniform(0.01, 0.1)},
              {"critical_ratio", b.AnyRatio()}};
        },
        Times("conductance"),
        [](const TrueEffect& e, const BenchRig& rig, EffectRig& plant) {
          plant.unlisted.gaping_seam = {rig.ambient_pa + e["open_share"] * rig.operating_gauge_pa,
                                        0.02 * rig.operating_gauge_pa, e["conductance"],
                                        e["critical_ratio"]};
        }}},
      {"snap_through",
       {[](const Bench& b) {
          return Parameters{{"share", b.random.Uniform(0.1, 0.3)},
                            {"centre", b.random.Uniform(0.25, 0.7)},
                            {"width", b.random.Uniform(0.01, 0.03)}};
        },
        Times("share"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.snap_through = {e["share"], e["centre"], e["width"]};
        }}},
      {"sticking_valve",
       {[](const Bench& b) {
          return Parameters{{"delay_s", b.rise_s * b.random.Uniform(0.05, 0.2)},
                            {"share_of_strokes", b.random.Uniform(0.3, 0.5)}};
        },
        Times("delay_s"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
      {"swinging_regulator",
       {[](const Bench& b) {
          return Parameters{{"amplitude", b.random.Uniform(0.02, 0.08)},
                            {"frequency_hz", b.random.LogUniform(0.5, 3.0) / b.rise_s}};
        },
        Times("amplitude"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
      {"drifting_sensor",
       {[](const Bench& b) {
          return Parameters{
              {"amplitude_pa", b.rig.operating_gauge_pa * b.random.Uniform(0.01, 0.04)},
              {"period_s", b.random.Uniform(5.0, 20.0)},
              {"phase", b.random.Uniform(0.0, 2.0 * std::numbers::pi)}};
        },
        Times("amplitude_pa"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
  };
  return kinds;
}

}  // namespace plenum::test
