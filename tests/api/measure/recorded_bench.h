// Recordings of one chamber by the independent simulator, as measurement documents.
#ifndef PLENUM_TESTS_API_MEASURE_RECORDED_BENCH_H_
#define PLENUM_TESTS_API_MEASURE_RECORDED_BENCH_H_

#include <functional>
#include <string>
#include <vector>

#include "tests/api/support.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::api {

// 50 mL, ε 2 at 100 kPa, behind a line and a regulator, as declared; without runs.
inline Json DeclaredBench() {
  return Parse(R"({
    "schema": "measurement/1",
    "rig": {
      "actuator": { "rest_volume_ml": 50, "expansion_ratio": 2,
                    "operating_pressure_kpa_gauge": 100 },
      "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
      "supply": { "kind": "regulated" },
      "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 } },
    "runs": [] })");
}

// A run from rest, 201 readings in 4 s: of the rig as it is, fed and vented through the declared
// line, with the source and the instants (state 0 hold, 1 inflate, −1 deflate) that the record has.
inline Json RecordedBench(const std::string& id, test::EffectRig rig, double source_kpa,
                          const std::vector<test::MassCommand>& recorded,
                          const std::function<double()>& noise_kpa) {
  rig.fill = rig.exhaust = {{0.05e-8, 0.3}};
  std::vector<double> t_s;
  for (int i = 0; i <= 200; ++i) t_s.push_back(0.02 * i);
  Json run = {{"id", id},
              {"source_pressure_kpa_gauge", source_kpa},
              {"initial", {{"pressure_kpa_gauge", 0}}},
              {"t_s", t_s}};
  for (const auto& [at_s, state] : recorded)
    run["valve"].push_back({{"t_s", at_s},
                            {"state", state > 0   ? "inflate"
                                      : state < 0 ? "deflate"
                                                  : "hold"}});
  for (const double pa : test::SimulateEffects(rig, t_s, 5e-4).measured_pa)
    run["pressure_kpa_gauge"].push_back((pa - 1e5) / 1e3 + noise_kpa());
  return run;
}

}  // namespace plenum::api

#endif  // PLENUM_TESTS_API_MEASURE_RECORDED_BENCH_H_
