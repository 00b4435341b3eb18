// One run: numbers that it does not fix cost nothing, those that it fixes what they take of their
// prior; and the gap between two fits scatters as its noise makes it.
#include "calibration/judge/closeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "calibration/judge/evidence.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace closeness_test {

// A rise and a hold, never emptied, with every declared number exact.
struct OneRun {
  explicit OneRun(const test::Change& change, std::uint64_t seed)
      : dataset(Measured(change, seed)),
        forward(dataset),
        observed(Observe(dataset)),
        bench{dataset, forward, observed, {}, {}, OriginalsOf(dataset), {}} {
    bench.data.forward = &forward;
    bench.data.observed = &observed;
    bench.data.sizes = SizesOf(dataset);
    bench.data.runs = {0};
    bench.tight.function_tolerance = 1e-9;
  }

  static Dataset Measured(const test::Change& change, std::uint64_t seed) {
    Dataset dataset;
    dataset.runs = {test::DeclaredRun("only", 3e5, false)};
    dataset.runs[0].valve.resize(3);  // inflate, then hold
    test::Measure(change, seed, test::kBenchNoisePa, dataset.runs[0]);
    return dataset;
  }

  Fit With(const std::string& id, const std::string& law = "") const {
    Fit best;
    for (const model::Effect& start : EffectStarts(*model::FindEffect(id, law), bench.data.sizes)) {
      ModelState state = forward.Declared();
      state.effects = {start};
      Fit fit = FitModel(bench.data, state, bench.tight);
      if (!best.Usable() || (fit.Usable() && fit.chi2_data < best.chi2_data)) best = std::move(fit);
    }
    return best;
  }

  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  Bench bench;
};

TEST(Closeness, ANumberThatTheRunDoesNotFixCostsNothing) {
  const OneRun one({}, 3);
  const Fit base = FitModel(one.bench.data, one.forward.Declared(), one.bench.tight);
  const Fit unseen = one.With("exhaust_restriction");
  ASSERT_TRUE(base.Usable() && unseen.Usable());
  EXPECT_GT(BicWith(unseen, 1.0) - BicWith(base, 1.0), 10.0);  // two numbers of 251 readings
  EXPECT_NEAR(EvidenceOf(one.bench, unseen, 1.0), EvidenceOf(one.bench, base, 1.0), 0.01);
}

// An offset moves every reading alike: H = n·(s/σ)², s the coordinate's scale.
TEST(Closeness, ANumberThatItFixesCostsWhatTheDataTake) {
  const OneRun one([](test::EffectRig& rig) { rig.sensor_offset_pa = 800.0; }, 4);
  const Fit fit = one.With("sensor_offset");
  ASSERT_TRUE(fit.Usable());
  ASSERT_EQ(fit.coordinates.size(), 1u);
  const double n = static_cast<double>(fit.rows);
  const double sigma_pa = one.observed[0].signals[0].sigma;
  const double scale_pa = fit.coordinates[0].Slope(fit.u[0]);
  for (const double memory : {1.0, 5.0}) {
    const double expected = n / memory * std::log(fit.chi2_data / n) +
                            std::log(1.0 + n * std::pow(scale_pa / sigma_pa, 2) / memory);
    EXPECT_NEAR(EvidenceOf(one.bench, fit, memory), expected, 1e-3) << memory;
  }
}

// In white noise the gap between the true model and another is |d|² ± 2·|d|, d the difference of
// their predictions in units of the noise.
TEST(Closeness, TheGapScattersAsItsNoise) {
  const test::Change creeps = [](test::EffectRig& rig) { rig.creep = test::Creep{0.006, 0.4}; };
  double expected = 0.0, stated = 0.0, off = 0.0, squares = 0.0;
  int draws = 0;
  for (std::uint64_t seed = 101; seed <= 112; ++seed) {
    const OneRun one(creeps, seed);
    if (one.observed[0].noise.memory.theta_s > 0.0) continue;  // not read as white
    const Fit creep = one.With("creep"), leak = one.With("leak", "laminar");
    ASSERT_TRUE(leak.Usable() && creep.Usable());
    const Reading a = Predicted(one.bench.data, creep.state, 0, one.bench.tight);
    const Reading b = Predicted(one.bench.data, leak.state, 0, one.bench.tight);
    double d2 = 0.0;
    for (std::size_t i = 0; i < a.pressure_pa.size(); ++i)
      d2 += std::pow((a.pressure_pa[i] - b.pressure_pa[i]) / test::kBenchNoisePa, 2);
    const Gap gap = GapTo(one.bench, creep, leak, 1.0);
    const double charge = std::log(static_cast<double>(leak.rows));  // leak has a number less
    const double chance = gap.size + charge - d2;
    off += chance;
    squares += chance * chance;
    expected += 4.0 * d2;
    stated += gap.scatter * gap.scatter;
    ++draws;
  }
  ASSERT_GT(draws, 8);
  EXPECT_GT(expected / draws, 40.0);
  EXPECT_NEAR(stated / expected, 1.0, 0.35);
  EXPECT_LT(std::abs(off), 3.0 * std::sqrt(expected));
  EXPECT_LT(squares, 3.0 * expected);
}

}  // namespace closeness_test
}  // namespace plenum::calibration
