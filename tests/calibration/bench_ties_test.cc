// Cases that may be ties, and the sensors that a diagnosis may ask for: against what they state of
// themselves and against the program's model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "calibration/fit/forward.h"
#include "tests/support/bench/bench_case.h"
#include "tests/support/bench/bench_channels.h"
#include "tests/support/bench/bench_dataset.h"
#include "tests/support/bench/bench_json.h"

namespace plenum::test {
namespace bench_ties_test {

constexpr std::uint64_t kSeries = 51;

#ifdef PLENUM_SANITIZED
constexpr int kTies = 3;
#else
constexpr int kTies = 12;
#endif

TEST(TieCase, ShowsLittleAndAlwaysTheSame) {
  int alone = 0;
  for (int i = 0; i < kTies; ++i) {
    const BenchCase bench = TieOfSeries(kSeries, i);
    SCOPED_TRACE(bench.effects.at(0).id);
    EXPECT_EQ(bench.effects[0].id, ListedEffects()[static_cast<std::size_t>(i)]);
    EXPECT_GT(bench.visible, 1.0);
    EXPECT_LT(bench.visible, 6.0);
    EXPECT_TRUE(bench.runs.size() == 2 || bench.runs.size() == 3);
    for (const BenchRun& run : bench.runs) {
      EXPECT_EQ(run.source_gauge_pa, bench.runs[0].source_gauge_pa);
      EXPECT_EQ(run.blocked, bench.runs[0].blocked);
      EXPECT_EQ(run.end_s, bench.runs[0].end_s);
      EXPECT_GE(run.t_s.size(), 39u);
      EXPECT_LE(run.t_s.size(), 601u);
    }
    const api::Json measurement = MeasurementJson(bench);
    EXPECT_EQ(measurement["runs"].size(), bench.runs.size() - (bench.holdout_recorded ? 0 : 1));
    EXPECT_EQ(measurement.contains("holdout"), bench.holdout_recorded);
    alone += measurement["runs"].size() == 1;
  }
#ifndef PLENUM_SANITIZED
  EXPECT_GT(alone, 0);
#endif
}

TEST(TieCase, FollowsFromItsTruth) {
  const BenchCase bench = TieOfSeries(kSeries, 0);
  api::Json truth = TruthJson(bench);
  truth["series"] = kSeries;
  truth["index"] = 0;
  EXPECT_EQ(truth["kind"], "tie");
  EXPECT_EQ(MeasurementJson(CaseOfTruth(truth)).dump(), MeasurementJson(bench).dump());
}

// Readings of a channel are the model's and noise of 1 % of its range.
TEST(BenchChannels, AreTheModelsWithNoise) {
  const std::vector<std::pair<std::string, std::vector<double> calibration::Channels::*>> channels =
      {{"volume_ml", &calibration::Channels::volume_m3},
       {"flow_l_per_min_anr", &calibration::Channels::flow_m3_per_s},
       {"inlet_pressure_kpa_gauge", &calibration::Channels::inlet_pressure_pa}};
  BenchCase bench;
  for (std::uint64_t seed = 1; !bench.declared.tube; ++seed) {
    bench = DrawCase(seed, CaseKind::kClean);
    if (bench.declared.supply != BenchSupply::kRegulated) bench.declared.tube.reset();
  }
  bench.effects = {{"directional_conductance", "", {{"fill_factor", 0.9}}}};
  bench.kind = CaseKind::kFull;
  calibration::Dataset dataset = NoiseFree(bench);
  dataset.runs[0].channels.inlet_pressure_pa.assign(dataset.runs[0].t_s.size(), 1e5);
  dataset.runs[0].initial_pressure_pa = bench.declared.ambient_pa;
  const calibration::ForwardModel forward(dataset);
  calibration::ModelState state = forward.Declared();
  std::copy(bench.factors.begin(), bench.factors.end(), state.factor.begin());
  state.effects = ListedOf(bench);
  const auto reading = forward.Predict(0, state, {}, {}).reading;
  for (const auto& [name, values] : channels) {
    const std::vector<double> seen = ChannelReadings(bench, bench.runs[0], 0, name);
    const std::vector<double>& model = reading.channels.*values;
    ASSERT_EQ(seen.size(), model.size()) << name;
    const bool pressure = name == "inlet_pressure_kpa_gauge";
    const double unit = pressure ? 1e3 : name == "volume_ml" ? 1e-6 : 1.0 / 6e4;
    const double zero = pressure ? bench.declared.ambient_pa : 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      sum += std::pow(unit * seen[i] + zero - model[i], 2);
    const auto [low, high] = std::minmax_element(model.begin(), model.end());
    const auto count = static_cast<double>(seen.size());
    EXPECT_NEAR(std::sqrt(sum / count) / (*high - *low), 0.01, 0.01 * 5.0 / std::sqrt(2.0 * count))
        << name;
  }
  EXPECT_THROW(ChannelReadings(bench, bench.runs[0], 0, "weight_kg"), std::invalid_argument);
}

}  // namespace bench_ties_test
}  // namespace plenum::test
