#include "tests/support/bench/real_case.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/bench/bench_draws.h"
#include "tests/support/bench/bench_refit.h"

namespace plenum::test {
namespace {

constexpr int kAttempts = 200;
constexpr std::uint64_t kRealStream = 4000;

BenchSupply DrawSupply(Random& random) {
  const double x = random.Uniform(0.0, 1.0);
  if (x < 0.6) return BenchSupply::kRegulated;
  if (x < 0.72) return BenchSupply::kMeasured;
  return x < 0.78 ? BenchSupply::kCompressor : BenchSupply::kNone;
}

Sensor DrawSensor(const BenchRig& rig, bool few, Random& random) {
  Sensor sensor;
  const double full_pa = rig.operating_gauge_pa;
  sensor.noise_pa = full_pa * random.LogUniform(5e-4, 5e-3);
  if (random.Coin(0.6)) {
    sensor.correlated_share = random.Uniform(0.3, 0.9);
    sensor.correlation = random.Uniform(0.5, 0.95);
  }
  if (random.Coin(0.3)) sensor.quantum_pa = 2.5 * full_pa / random.Pick<double>({256, 1024});
  if (random.Coin(0.12)) sensor.clip_high_pa = full_pa * random.Uniform(0.85, 0.98);
  if (random.Coin(0.3)) sensor.zero_drift_pa = full_pa * random.LogUniform(3e-4, 3e-3);
  if (random.Coin(0.5)) sensor.clock_share = random.Uniform(0.2, 1.0);
  if (!few && random.Coin(0.2)) sensor.missing_share = random.Uniform(0.005, 0.03);
  if (random.Coin(0.08)) sensor.outliers = random.Integer(1, 2);
  sensor.source_noise_pa = 0.3 * sensor.noise_pa;
  return sensor;
}

// Some of the runs of a bench, and the one to hold out.
std::vector<BenchRun> DrawFewRuns(const BenchRig& rig, bool few, Random& random) {
  std::vector<BenchRun> all = DrawRuns(rig, random);
  const auto fitted = static_cast<std::size_t>(random.Integer(1, 4));
  std::vector<BenchRun> runs(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(fitted));
  runs.push_back(std::move(all.back()));
  const double count = few ? random.Integer(8, 30) : random.LogUniform(60.0, 500.0);
  for (BenchRun& run : runs) {
    run.t_s.clear();
    for (int i = 0; i < static_cast<int>(count); ++i)
      run.t_s.push_back(std::round(run.end_s * i / (std::floor(count) - 1.0) * 1e6) * 1e-6);
  }
  return runs;
}

struct Plan {
  bool wrong = false;
  std::optional<std::string> effect;
};

Plan DrawPlan(Random& random) {
  Plan plan;
  plan.wrong = random.Coin(0.25);
  if (plan.wrong && !random.Coin(0.2)) return plan;
  if (!plan.wrong && random.Coin(0.25)) return plan;
  const bool listed = plan.wrong || random.Coin(2.0 / 3.0);
  plan.effect = random.Pick(listed ? ListedEffects() : OutsideEffects());
  return plan;
}

// A number that is off by much more than is said of it; false where that cannot be seen.
bool DrawWrongNumber(BenchCase& bench, Random& random) {
  std::vector<int> numbers = {kRestVolume};
  if (bench.declared.supply != BenchSupply::kNone) numbers.push_back(kSonicConductance);
  if (bench.declared.supply == BenchSupply::kRegulated) numbers.push_back(kSourcePressure);
  numbers.push_back(kExpansionRatio);
  const auto n = static_cast<std::size_t>(random.Pick(numbers));
  if (std::isinf(bench.uncertainty[n])) return false;
  const Numbers stated = bench.factors;
  bench.factors[n] = 1.0 + random.Sign() * random.Uniform(0.1, 0.35);
  if (n == kExpansionRatio && bench.factors[n] * bench.declared.expansion_ratio < 1.05)
    return false;
  if (random.Coin()) bench.uncertainty[n] = 0.0;  // declared as exact
  Numbers near = stated;
  near[n] = 1.0;
  const BaseFitter fitter(bench.declared, bench.runs, bench.uncertainty, near);
  const double floor_pa = bench.sensor.NoiseFloor();
  const Readings readings = BaseReadings(bench.declared, bench.runs, bench.factors);
  bench.visible = fitter.Fit(readings, floor_pa).rms_pa / floor_pa;
  bench.wrong = n;
  return bench.visible > kVisibleLow;
}

std::optional<BenchCase> Draw(std::uint64_t seed, Random& random) {
  BenchCase bench;
  bench.seed = seed;
  bench.kind = CaseKind::kReal;
  const Plan plan = DrawPlan(random);
  const BenchSupply supply = DrawSupply(random);
  if (plan.effect && !Shows(*plan.effect, supply)) return {};
  const bool few = random.Coin(1.0 / 3.0);
  bench.declared = DrawRig(supply, random);
  bench.runs = DrawFewRuns(bench.declared, few, random);
  bench.holdout_recorded = random.Coin(0.7);
  bench.uncertainty = DrawUncertainty(bench.declared, random);
  bench.factors = DrawFactors(bench.uncertainty, random);
  bench.sensor = DrawSensor(bench.declared, few, random);
  bench.initial_declared = supply == BenchSupply::kNone || random.Coin(0.7);
  if (plan.effect && !DrawEffects(bench, {*plan.effect}, random)) return {};
  if (plan.wrong && !DrawWrongNumber(bench, random)) return {};
  for (std::size_t r = 0; r < bench.runs.size(); ++r)
    bench.records.push_back(Observe(bench, bench.runs[r], static_cast<int>(r)));
  if (random.Coin(0.15)) {  // the first run stands there twice
    bench.runs.insert(bench.runs.begin() + 1, bench.runs.front());
    bench.runs[1].id = "copy";
    bench.records.insert(bench.records.begin() + 1, Record(bench.records.front()));
  }
  return bench;
}

}  // namespace

BenchCase RealOfSeries(std::uint64_t series, int index) {
  const std::uint64_t seed = series * 1'000'003 + static_cast<std::uint64_t>(index);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Random random(seed, kRealStream + static_cast<std::uint64_t>(attempt));
    if (std::optional<BenchCase> bench = Draw(seed, random)) return *std::move(bench);
  }
  throw std::runtime_error("real_case: nothing visible was drawn");
}

}  // namespace plenum::test
