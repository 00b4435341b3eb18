// The generator of measured data sets with known truth is itself checked: against what it states of
// itself, and its readings against the program's model.
#include "tests/support/bench/bench_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "calibration/fit/forward.h"
#include "tests/support/bench/bench_dataset.h"
#include "tests/support/bench/bench_json.h"
#include "tests/support/bench/bench_refit.h"

namespace plenum::test {
namespace bench_case_test {

#ifdef PLENUM_SANITIZED
constexpr int kClean = 6;
#else
constexpr int kClean = 16;
#endif

const std::vector<BenchCase>& CleanCases() {
  static const std::vector<BenchCase> cases = [] {
    std::vector<BenchCase> drawn;
    for (std::uint64_t seed = 1; seed <= kClean; ++seed) {
      drawn.push_back(DrawCase(seed, CaseKind::kClean));
    }
    return drawn;
  }();
  return cases;
}

TEST(BenchCase, FollowsFromItsSeed) {
  const std::string once = MeasurementJson(DrawCase(1, CaseKind::kClean)).dump();
  EXPECT_EQ(once, MeasurementJson(CleanCases()[0]).dump());
  EXPECT_NE(once, MeasurementJson(CleanCases()[1]).dump());
}

// Standard normal deviations of every declared number with a known uncertainty.
TEST(BenchCase, DeclaredNumbersAreOffAsStated) {
  std::vector<double> z;
  for (const BenchCase& bench : CleanCases()) {
    for (std::size_t n = 0; n < bench.factors.size(); ++n) {
      const double sd = bench.uncertainty[n];
      if (sd == 0.0) {
        EXPECT_EQ(bench.factors[n], 1.0) << kNumberNames[n];
      }
      if (sd > 0.0 && std::isfinite(sd)) z.push_back((bench.factors[n] - 1.0) / sd);
    }
  }
  double sum = 0.0, squares = 0.0;
  for (const double x : z) {
    sum += x;
    squares += x * x;
    EXPECT_LT(std::abs(x), 5.0);
  }
  const auto count = static_cast<double>(z.size());
  EXPECT_GT(count, 4.0 * kClean);
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1.0, 4.0 * std::sqrt(2.0 / count));
}

// Noise as stated: its standard deviation, and its correlation from sample to sample.
TEST(BenchCase, ReadingsHaveTheirNoise) {
  int correlated = 0;
  for (const BenchCase& bench : CleanCases()) {
    const Sensor& sensor = bench.sensor;
    if (sensor.outliers > 0 || sensor.clip_low_pa > -1e9 || sensor.clip_high_pa < 1e9 ||
        sensor.quantum_pa > 2.0 * sensor.noise_pa) {
      continue;
    }
    double squares = 0.0, products = 0.0, count = 0.0;
    for (const Record& record : bench.records) {
      double before = std::nan("");
      for (std::size_t i = 0; i < record.t_s.size(); ++i) {
        const double noise = record.reading_gauge_pa[i] - record.clean_gauge_pa[i];
        if (!std::isnan(noise)) {
          squares += noise * noise;
          count += 1.0;
          if (!std::isnan(before)) products += noise * before;
        }
        before = noise;
      }
    }
    const double floor_pa = sensor.NoiseFloor();
    const double variance = floor_pa * floor_pa;
    // A correlated process counts for fewer independent readings, (1 − φ²)/(1 + φ²) of them.
    const double phi2 = sensor.correlation * sensor.correlation;
    const double error = 5.0 * std::sqrt(2.0 / count * (1.0 + phi2) / (1.0 - phi2));
    EXPECT_NEAR(squares / count / variance, 1.0, error) << bench.seed;
    const double expected =
        sensor.correlated_share * sensor.correlation * sensor.noise_pa * sensor.noise_pa / variance;
    if (sensor.missing_share == 0.0) {
      EXPECT_NEAR(products / count / variance, expected, error) << bench.seed;
    }
    correlated += sensor.correlated_share > 0.0;
  }
#ifndef PLENUM_SANITIZED
  EXPECT_GT(correlated, 0);
#endif
}

TEST(BenchCase, ReadingsLieOnTheGridAndInTheRange) {
  int on_grid = 0;
  for (const BenchCase& bench : CleanCases()) {
    const Sensor& sensor = bench.sensor;
    for (const Record& record : bench.records) {
      EXPECT_TRUE(std::is_sorted(record.t_s.begin(), record.t_s.end()));
      EXPECT_GE(record.t_s.front(), 0.0);
      for (const double p : record.reading_gauge_pa) {
        if (std::isnan(p)) continue;
        EXPECT_GE(p, sensor.clip_low_pa);
        EXPECT_LE(p, sensor.clip_high_pa);
        if (sensor.quantum_pa == 0.0 || p == sensor.clip_high_pa) continue;
        const double steps = p / sensor.quantum_pa;
        EXPECT_NEAR(steps, std::round(steps), 1e-6);
        ++on_grid;
      }
    }
  }
  EXPECT_GT(on_grid, 0);
}

// Clocks are off by less than a sample and by one amount in a run.
TEST(BenchCase, ClocksAreOffWithinASample) {
  int off = 0;
  for (const BenchCase& bench : CleanCases()) {
    for (std::size_t r = 0; r < bench.runs.size(); ++r) {
      const std::vector<double>& truth = bench.runs[r].t_s;
      const std::vector<double>& recorded = bench.records[r].t_s;
      const double interval_s =
          (truth.back() - truth.front()) / static_cast<double>(truth.size() - 1);
      const double late_s = recorded[0] - truth[0];
      EXPECT_LE(std::abs(late_s), bench.sensor.clock_share * interval_s + 2e-6);
      EXPECT_NEAR(recorded.back() - truth.back(), late_s, 3e-6);
      off += std::abs(late_s) > 0.01 * interval_s;
    }
  }
  EXPECT_GT(off, 0);
}

TEST(BenchCase, RunsAreThoseOfABench) {
  for (const BenchCase& bench : CleanCases()) {
    ASSERT_GE(bench.runs.size(), 5u);
    double samples = 0.0;
    for (const BenchRun& run : bench.runs) samples += static_cast<double>(run.t_s.size());
    EXPECT_LE(samples, 31000.0);
    const BenchRun& held_out = bench.runs.back();
    EXPECT_FALSE(held_out.blocked);
    for (std::size_t r = 0; r + 1 < bench.runs.size(); ++r) {
      const BenchRun& run = bench.runs[r];
      if (bench.declared.supply == BenchSupply::kNone) {
        EXPECT_NE(run.initial_gauge_pa, held_out.initial_gauge_pa);
      } else {
        EXPECT_NE(run.source_gauge_pa, held_out.source_gauge_pa);
        EXPECT_GT(run.source_gauge_pa, bench.declared.operating_gauge_pa);
      }
      // A stroke that deserves the name, and nothing beyond what the actuator is for.
      const auto& clean = bench.records[r].clean_gauge_pa;
      const double highest_pa = *std::max_element(clean.begin(), clean.end());
      EXPECT_GT(highest_pa, 0.45 * bench.declared.operating_gauge_pa) << bench.seed << run.id;
      EXPECT_LT(highest_pa, 1.4 * bench.declared.operating_gauge_pa) << bench.seed << run.id;
    }
  }
}

TEST(BenchCase, VisibleAsItsKindAsks) {
  for (const std::string effect : {"sensor_offset", "exhaust_restriction"}) {
    const BenchCase full = DrawCase(3, CaseKind::kFull, effect);
    EXPECT_GE(full.visible, kVisibleLow) << effect;
    EXPECT_LE(full.visible, kVisibleHigh) << effect;
    // The re-fit takes something away from what the effect does, and not all of it.
    Readings clean;
    for (const Record& record : full.records) clean.push_back(record.clean_gauge_pa);
    const Readings base = BaseReadings(full.declared, full.runs, full.factors);
    EXPECT_GT(FittedRms(clean, base), full.visible * full.sensor.NoiseFloor() * 0.999) << effect;
  }
  EXPECT_EQ(CleanCases()[0].visible, 0.0);
}

// A fifth of the parameters gives about a fifth of the residual, whatever the effect.
TEST(BenchCase, SizesScaleTheResidual) {
  Random random(11);
  const BenchRig rig = DrawRig(BenchSupply::kRegulated, random);
  BenchRun run;
  run.source_gauge_pa = 2.0 * rig.operating_gauge_pa;
  const StrokeTimes stroke = TimesOf(rig, false, run.source_gauge_pa);
  run.schedule = {{0.1, 1}, {0.1 + stroke.rise_s, 0}, {1.6 + stroke.rise_s, -1}};
  for (int i = 1; i <= 300; ++i) run.t_s.push_back(i * (1.6 + 2.0 * stroke.rise_s) / 300.0);
  BenchCase bench;
  bench.declared = rig;
  bench.runs = {run, run};
  const auto residual = [&](const std::vector<TrueEffect>& effects) {
    const auto readings = TrueReadings(bench, run, 0, kAsDeclared, effects);
    const auto base = TrueReadings(bench, run, 0, kAsDeclared, {});
    return FittedRms({readings, {}}, {base, {}});
  };
  EXPECT_EQ(residual({}), 0.0);
  std::vector<std::string> ids = ListedEffects();
  ids.insert(ids.end(), OutsideEffects().begin(), OutsideEffects().end());
  for (const std::string& id : ids) {
    if (id == "softening") continue;  // not in the first stroke
    const TrueEffect typical = DrawEffect(id, rig, stroke.rise_s, random);
    const double small = residual({Sized(typical, 0.3)}), tiny = residual({Sized(typical, 0.1)});
    EXPECT_GT(small, 0.0) << id;
    EXPECT_LT(tiny, 0.6 * small) << id;
    EXPECT_GT(residual({typical}), small) << id;
  }
}

TEST(BenchJson, FollowsTheContractAndTellsNothing) {
  const BenchCase bench = DrawCase(5, CaseKind::kOutside, "kinking_line");
  const api::Json json = MeasurementJson(bench);
  EXPECT_TRUE(std::holds_alternative<api::Json>(api::ParseJson(json.dump())));
  EXPECT_EQ(json["schema"], "measurement/1");
  EXPECT_EQ(json["holdout"], api::Json({bench.runs.back().id}));
  ASSERT_EQ(json["runs"].size(), bench.runs.size());
  for (const api::Json& run : json["runs"]) {
    EXPECT_EQ(run["t_s"].size(), run["pressure_kpa_gauge"].size());
    EXPECT_EQ(run["valve"][0]["t_s"], 0.0);
    EXPECT_EQ(run["valve"][0]["state"], "hold");
  }
  for (const auto& [name, sd] : json["relative_uncertainty"].items()) {
    EXPECT_NE(std::find(kNumberNames.begin(), kNumberNames.end(), name), kNumberNames.end());
    EXPECT_TRUE(sd == "unknown" || sd > 0.0) << name;
  }
  const std::string text = json.dump();
  for (const auto* ids : {&ListedEffects(), &OutsideEffects()}) {
    for (const std::string& id : *ids) EXPECT_EQ(text.find(id), std::string::npos) << id;
  }
  for (const char* word : {"kind\":\"outside", "truth", "effect", "noise", "seed"}) {
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(TruthJson(bench)["effects"][0]["id"], "kinking_line");
}

// Largest difference between the case's readings and what the program's model gives with the true
// numbers and effects.
double LargestDisagreement(const BenchCase& bench) {
  const calibration::Dataset dataset = NoiseFree(bench);
  const calibration::ForwardModel forward(dataset);
  calibration::ModelState state = forward.Declared();
  std::copy(bench.factors.begin(), bench.factors.end(), state.factor.begin());
  state.effects = ListedOf(bench);
  calibration::PredictOptions options;
  options.relative_tolerance = 1e-8;
  double largest_pa = 0.0;
  for (std::size_t r = 0; r < bench.runs.size(); ++r) {
    state.initial_pressure_pa[r] = bench.declared.ambient_pa + bench.runs[r].initial_gauge_pa;
    const auto prediction = forward.Predict(r, state, {}, options);
    EXPECT_EQ(prediction.status, model::SimulateStatus::kDone) << prediction.detail;
    const std::vector<double>& clean = bench.records[r].clean_gauge_pa;
    if (prediction.reading.pressure_pa.size() != clean.size()) return INFINITY;
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const double gauge_pa = prediction.reading.pressure_pa[i] - bench.declared.ambient_pa;
      largest_pa = std::max(largest_pa, std::abs(gauge_pa - clean[i]));
    }
  }
  return largest_pa;
}

// A measured source is known at the sample times only.
double Limit(const BenchCase& bench) {
  return bench.declared.supply == BenchSupply::kMeasured ? 0.2 * bench.sensor.NoiseFloor() : 2.0;
}

TEST(BenchDataset, TheModelAgreesOnCleanCases) {
  for (int i = 0; i < std::min(kClean, 12); ++i) {
    const BenchCase& bench = CleanCases()[static_cast<std::size_t>(i)];
    EXPECT_LT(LargestDisagreement(bench), Limit(bench))
        << bench.seed << " supply " << static_cast<int>(bench.declared.supply);
  }
}

// Each effect at its typical size in two runs of some rig.
TEST(BenchDataset, TheModelAgreesOnEveryEffect) {
  Random random(21);
  for (const std::string& id : ListedEffects()) {
    BenchCase bench;
    do {
      bench = random.Pick(CleanCases());
    } while (!Shows(id, bench.declared.supply));
    bench.runs.resize(2);
    bench.records.resize(2);
    bench.kind = CaseKind::kFull;
    bench.effects = {DrawEffect(id, bench.declared, 0.5, random)};
    for (std::size_t r = 0; r < 2; ++r) {
      bench.records[r] = Observe(bench, bench.runs[r], static_cast<int>(r));
    }
    EXPECT_LT(LargestDisagreement(bench), Limit(bench))
        << id << ' ' << bench.seed << " supply " << static_cast<int>(bench.declared.supply);
  }
}

}  // namespace bench_case_test
}  // namespace plenum::test
