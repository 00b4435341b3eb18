#include "calibration/judge/residual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "calibration/noise/whiteness.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace residual_test {

using model::ValveState;
using test::AgreesWithRate;
using test::AtMostRate;
using test::CorrelatedNoise;
using test::EvenTimes;
using test::RandomTimes;
using test::RoundTo;
using test::WhiteNoise;

constexpr double kSigmaPa = 200.0;
#ifdef PLENUM_SANITIZED
constexpr int kSeeds = 100;
#else
constexpr int kSeeds = 1000;
#endif

// Two cycles of rise, hold, fall and rest.
double Pressure(double t_s) {
  const double t = std::fmod(t_s, 4.0);
  if (t < 1.0) return 1e5 + 1e5 * (1.0 - std::exp(-t / 0.2));
  if (t < 2.0) return 2e5 - 1e5 * std::exp(-5.0);
  return 1e5 + 1e5 * (1.0 - std::exp(-5.0)) * std::exp(-(t - 2.0) / 0.2);
}

struct Case {
  calibration::Run run;
  FittedRun fitted;
};

// The model is the pressure above; the readings are that, `noise`, and what the model lacks.
Case MakeCase(const std::vector<double>& t_s, const std::vector<double>& noise,
              double theta_s = 0.0, const std::function<double(double)>& lacking = {}) {
  Case made;
  made.run.id = "r";
  made.run.chamber.operating_pressure_pa = 2e5;
  for (const double start : {0.0, 4.0}) {
    made.run.valve.push_back({start, ValveState::kInflate});
    made.run.valve.push_back({start + 1.0, ValveState::kHold});
    made.run.valve.push_back({start + 2.0, ValveState::kDeflate});
    made.run.valve.push_back({start + 3.5, ValveState::kHold});
  }
  made.run.t_s = t_s;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    made.fitted.model_pa.push_back(Pressure(t_s[i]));
    made.run.pressure_pa.push_back(Pressure(t_s[i]) + noise[i] + (lacking ? lacking(t_s[i]) : 0));
  }
  made.fitted.noise.sigma_pa = kSigmaPa;
  made.fitted.noise.relative_error = 0.0;
  made.fitted.noise.memory.theta_s = theta_s;
  made.fitted.noise.spacing_s = t_s[1] - t_s[0];
  return made;
}

ResidualReport Assess(Case& made, std::vector<InputCorrelation>* by_input = nullptr) {
  made.fitted.run = &made.run;
  return AssessResiduals({made.fitted}, 0, by_input);
}

struct Alarms {
  int white = 0, inputs = 0, fit = 0;
  void Count(const ResidualReport& report) {
    white += !report.white;
    inputs += !report.independent_of_inputs;
    fit += report.lack_of_fit > report.lack_of_fit_limit;
  }
};

TEST(Residual, WhiteNoiseRaisesAlarmsAtTheStatedRate) {
  Alarms alarms;
  const std::vector<double> t_s = EvenTimes(400, 0.02);
  for (int seed = 0; seed < kSeeds; ++seed) {
    Case made = MakeCase(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa));
    alarms.Count(Assess(made));
  }
  EXPECT_TRUE(AgreesWithRate(alarms.white, kSeeds, kFalseAlarm)) << alarms.white;
  EXPECT_TRUE(AgreesWithRate(alarms.inputs, kSeeds, kFalseAlarm)) << alarms.inputs;
  EXPECT_TRUE(AgreesWithRate(alarms.fit, kSeeds, kFalseAlarm)) << alarms.fit;
}

TEST(Residual, SoDoesCorrelatedNoiseOfKnownCorrelation) {
  Alarms even, uneven;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::vector<double> t_s = EvenTimes(400, 0.02);
    Case made = MakeCase(t_s, CorrelatedNoise(seed, t_s, 0.06, kSigmaPa), 0.06);
    even.Count(Assess(made));
    const std::vector<double> times = RandomTimes(seed + 7, 400, 0.02);
    Case random = MakeCase(times, CorrelatedNoise(seed, times, 0.06, kSigmaPa), 0.06);
    uneven.Count(Assess(random));
  }
  for (const Alarms& alarms : {even, uneven}) {
    EXPECT_TRUE(AgreesWithRate(alarms.white, kSeeds, kFalseAlarm)) << alarms.white;
    EXPECT_TRUE(AgreesWithRate(alarms.inputs, kSeeds, kFalseAlarm)) << alarms.inputs;
  }
  EXPECT_TRUE(AtMostRate(even.fit, kSeeds, 0.004)) << even.fit;
}

TEST(Residual, CorrelatedNoiseTakenForWhiteIsSeen) {
  const std::vector<double> t_s = EvenTimes(400, 0.02);
  int seen = 0;
  for (int seed = 0; seed < kSeeds / 10; ++seed) {
    Case made = MakeCase(t_s, CorrelatedNoise(seed, t_s, 0.02, kSigmaPa));  // ρ = 0.37
    seen += !Assess(made).white;
  }
  EXPECT_GE(seen, kSeeds / 10 * 95 / 100);
}

// With noise estimated from the same readings instead of known, as in use.
TEST(Residual, EstimatedNoiseKeepsTheAlarmsRare) {
  for (const double rho : {0.0, 0.5, 0.8}) {
    Alarms alarms;
    const std::vector<double> t_s = EvenTimes(800, 0.01);
    const double theta_s = rho > 0.0 ? -0.01 / std::log(rho) : 1e-9;
    for (int seed = 0; seed < kSeeds / 4; ++seed) {
      Case made = MakeCase(t_s, CorrelatedNoise(seed, t_s, theta_s, kSigmaPa));
      made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
      alarms.Count(Assess(made));
    }
    const int draws = kSeeds / 4;
    EXPECT_TRUE(AtMostRate(alarms.white, draws, 0.01)) << rho << ": " << alarms.white;
    EXPECT_TRUE(AtMostRate(alarms.inputs, draws, 0.01)) << rho << ": " << alarms.inputs;
    // Of correlated noise 300 windows give σ to 20 to 40 %, with a skew that no normal limit has.
    const double rate = rho > 0.0 ? 0.06 : 0.005;
    EXPECT_TRUE(AtMostRate(alarms.fit, draws, rate)) << rho << ": " << alarms.fit;
  }
}

TEST(Residual, RoundingToACoarseGridIsNoStructure) {
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  for (const double noise : {0.0, 0.1, 0.3, 1.0}) {  // of the quantum
    Alarms alarms;
    constexpr int kDraws = kSeeds / 20;
    for (int seed = 0; seed < kDraws; ++seed) {
      Case made = MakeCase(t_s, WhiteNoise(seed, t_s.size(), 1000.0 * noise));
      for (double& y : made.run.pressure_pa) y = RoundTo(y + 10.0 * seed, 1000.0) - 10.0 * seed;
      made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
      alarms.Count(Assess(made));
    }
    EXPECT_LE(alarms.white, 1 + kDraws / 50) << noise;
    EXPECT_LE(alarms.inputs, 1 + kDraws / 50) << noise;
    EXPECT_LE(alarms.fit, 1 + kDraws / 50) << noise;
  }
}

// Rounding hides that the noise remembers: in the readings, not in what a right model leaves.
TEST(Residual, NoiseThatRemembersBelowACoarseGridIsNoStructure) {
  Alarms alarms;
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  constexpr int kDraws = kSeeds / 20;
  for (int seed = 0; seed < kDraws; ++seed) {
    Case made = MakeCase(t_s, CorrelatedNoise(seed, t_s, -0.005 / std::log(0.7), 300.0));
    for (double& y : made.run.pressure_pa) y = RoundTo(y + 10.0 * seed, 1000.0) - 10.0 * seed;
    made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
    EXPECT_TRUE(made.fitted.noise.staircase);
    alarms.Count(Assess(made));
  }
  EXPECT_LE(alarms.white, 1 + kDraws / 50);
  EXPECT_LE(alarms.inputs, 1 + kDraws / 50);
}

// What a model may lack, at about half the noise's size.
struct Lack {
  std::string name;
  std::function<double(double)> error;
  std::string input;  // that must be among the leading ones
};

TEST(Residual, StructureBelowTheNoiseIsSeenAndLaidToItsInput) {
  const std::vector<Lack> lacks = {
      {"gain", [](double t) { return 0.002 * (Pressure(t) - 1e5); }, "pressure"},
      {"offset", [](double) { return 100.0; }, "mean"},
      {"drift", [](double t) { return 25.0 * (t - 4.0); }, "time"},
      {"fall", [](double t) { return std::fmod(t, 4.0) > 2.0 ? 120.0 : 0.0; }, "valve"},
      {"first cycle", [](double t) { return t < 4.0 ? 150.0 : 0.0; }, "cycle"},
      {"delay",
       [](double t) { return (Pressure(t - 2e-3) - Pressure(t)) * (std::fmod(t, 4.0) > 0.01); },
       "rate"},
  };
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  for (const Lack& lack : lacks) {
    int seen = 0, laid = 0;
    constexpr int kDraws = kSeeds / 50;
    for (int seed = 0; seed < kDraws; ++seed) {
      Case made = MakeCase(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa), 0.0, lack.error);
      std::vector<InputCorrelation> by_input;
      const ResidualReport report = Assess(made, &by_input);
      seen += !report.independent_of_inputs && !report.white;
      laid += std::any_of(by_input.begin(), by_input.end(), [&](const InputCorrelation& one) {
        return one.input == lack.input && one.statistic > report.cross_limit &&
               one.statistic > 0.7 * by_input.front().statistic;
      });
    }
    EXPECT_GE(seen, kDraws * 9 / 10) << lack.name;
    EXPECT_GE(laid, kDraws * 9 / 10) << lack.name;
  }
}

// The allowance for a memory of the noise that is only estimated must not excuse structure.
TEST(Residual, StructureIsSeenWithEstimatedNoiseToo) {
  const auto creep = [](double t) { return 250.0 * std::sin(0.8 * t); };
  const auto gain = [](double t) { return 0.003 * (Pressure(t) - 1e5); };
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  for (const std::function<double(double)>& error :
       std::vector<std::function<double(double)>>{creep, gain}) {
    int seen = 0;
    constexpr int kDraws = kSeeds / 50;
    for (int seed = 0; seed < kDraws; ++seed) {
      Case made = MakeCase(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa), 0.0, error);
      made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
      const ResidualReport report = Assess(made);
      seen += !report.white && !report.independent_of_inputs;
    }
    EXPECT_GE(seen, kDraws * 9 / 10);
  }
}

// Half of the variance white, half a process of ρ = 0.5: the differences cannot tell the two apart.
TEST(Residual, NoiseThatRemembersInPartIsNoStructure) {
  Alarms alarms;
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  constexpr int kDraws = kSeeds / 10;
  for (int seed = 0; seed < kDraws; ++seed) {
    std::vector<double> noise = WhiteNoise(seed, t_s.size(), kSigmaPa * std::sqrt(0.5));
    const std::vector<double> slow =
        CorrelatedNoise(seed + 5000, t_s, -0.005 / std::log(0.5), kSigmaPa * std::sqrt(0.5));
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] += slow[i];
    Case made = MakeCase(t_s, noise);
    made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
    alarms.Count(Assess(made));
  }
  EXPECT_TRUE(AtMostRate(alarms.white, kDraws, 0.03)) << alarms.white;
  EXPECT_TRUE(AtMostRate(alarms.inputs, kDraws, 0.01)) << alarms.inputs;
}

// Noise is cut off at the end of the sensor's range: readings just below it are too low in the
// mean.
TEST(Residual, TheEndOfTheSensorsRangeIsNoStructure) {
  Alarms alarms;
  const std::vector<double> t_s = EvenTimes(1600, 0.005);
  constexpr int kDraws = kSeeds / 20;
  for (int seed = 0; seed < kDraws; ++seed) {
    Case made = MakeCase(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa));
    for (double& y : made.run.pressure_pa) y = std::min(y, 1.98e5);
    made.fitted.noise = EstimateNoise(ReadingsOf(made.run));
    EXPECT_EQ(made.fitted.noise.clip_high_pa, 1.98e5);
    alarms.Count(Assess(made));
  }
  EXPECT_LE(alarms.white, 1 + kDraws / 50);
  EXPECT_LE(alarms.inputs, 1 + kDraws / 50);
}

TEST(Residual, LackOfFitIsOfTheNoiseAndAllowsForItsOwnError) {
  const std::vector<double> t_s = EvenTimes(400, 0.02);
  Case made = MakeCase(t_s, WhiteNoise(1, t_s.size(), 1.3 * kSigmaPa));
  const ResidualReport sure = Assess(made);
  EXPECT_NEAR(sure.lack_of_fit, 1.69, 0.35);
  EXPECT_GT(sure.lack_of_fit, sure.lack_of_fit_limit);
  made.fitted.noise.relative_error = 0.2;
  const ResidualReport unsure = Assess(made);
  EXPECT_EQ(unsure.lack_of_fit, sure.lack_of_fit);
  EXPECT_LT(unsure.lack_of_fit, unsure.lack_of_fit_limit);
}

TEST(Residual, PhasesHaveMeanRmsAndTrend) {
  const std::vector<double> t_s = EvenTimes(800, 0.01);
  const auto error = [](double t) {
    return t >= 1.0 && t < 2.0 ? 50.0 - 300.0 * (t - 1.0) : 0.0;  // the first hold
  };
  Case made = MakeCase(t_s, std::vector<double>(t_s.size(), 0.0), 0.0, error);
  made.run.pressure_pa[150] = std::nan("");
  const ResidualReport report = Assess(made);
  ASSERT_EQ(report.phases.size(), 8u);
  const PhaseResidual& hold = report.phases[1];
  EXPECT_EQ(hold.phase, Phase::kHold);
  EXPECT_EQ(hold.cycle, 0);
  EXPECT_EQ(hold.samples, 99);
  EXPECT_NEAR(hold.trend_pa_per_s, -300.0, 1e-6);
  EXPECT_NEAR(hold.mean_pa, 50.0 - 300.0 * 0.495, 1.0);
  EXPECT_NEAR(hold.rms_pa, std::hypot(98.5, 300.0 / std::sqrt(12.0)), 2.0);
  EXPECT_EQ(report.phases[5].cycle, 1);
  EXPECT_NEAR(report.phases[5].rms_pa, 0.0, 1e-9);
}

TEST(Residual, DropsWhatTheSensorSpoilt) {
  const std::vector<double> t_s = EvenTimes(100, 0.08);
  Case made = MakeCase(t_s, std::vector<double>(t_s.size(), 5.0));
  made.fitted.run = &made.run;
  made.fitted.noise.clipped = {3};
  made.fitted.noise.outliers = {7};
  made.run.pressure_pa[9] = std::nan("");
  const std::vector<double> residual = Residual(made.fitted);
  for (std::size_t i = 0; i < residual.size(); ++i) {
    if (i == 3 || i == 7 || i == 9)
      EXPECT_TRUE(std::isnan(residual[i]));
    else
      EXPECT_NEAR(residual[i], 5.0, 1e-9);
  }
}

TEST(Residual, NoReadingsGiveNoAlarmAndNoCrash) {
  Case made = MakeCase(EvenTimes(30, 0.2), std::vector<double>(30, std::nan("")));
  const ResidualReport report = Assess(made);
  EXPECT_TRUE(report.white);
  EXPECT_TRUE(report.independent_of_inputs);
  EXPECT_EQ(AssessResiduals({}, 0).phases.size(), 0u);
}

// Stopped at the first question or at a later one: no judgement, but what is left by phase.
TEST(Residual, AStopLeavesTheTestsOut) {
  const std::vector<double> even = EvenTimes(300, 0.02);
  Case made = MakeCase(even, WhiteNoise(3, even.size(), kSigmaPa));
  made.fitted.run = &made.run;
  EXPECT_TRUE(Assess(made).tested);
  for (const int allowed : {0, 1, 2, 5}) {
    int asked = 0;
    const ResidualReport report =
        AssessResiduals({made.fitted}, 0, nullptr, [&] { return ++asked > allowed; });
    EXPECT_FALSE(report.tested) << allowed;
    EXPECT_FALSE(report.white && report.independent_of_inputs) << allowed;
    EXPECT_EQ(report.phases.size(), Assess(made).phases.size());
    EXPECT_EQ(report.phases.front().rms_pa, Assess(made).phases.front().rms_pa);
    EXPECT_GT(report.lack_of_fit, 0.5);
  }
}

TEST(Whiteness, OneRunAmongManyMayNotHide) {
  std::vector<double> even = EvenTimes(300, 0.02);
  std::vector<Case> cases;
  for (int seed = 0; seed < 12; ++seed)
    cases.push_back(MakeCase(even, WhiteNoise(seed, even.size(), kSigmaPa)));
  std::vector<FittedRun> runs;
  for (Case& made : cases) {
    made.fitted.run = &made.run;
    runs.push_back(made.fitted);
  }
  EXPECT_TRUE(AssessResiduals(runs, 0).white);
  cases[5] = MakeCase(even, CorrelatedNoise(5, even, 0.03, kSigmaPa));
  runs[5] = cases[5].fitted;
  runs[5].run = &cases[5].run;
  EXPECT_FALSE(AssessResiduals(runs, 0).white);
}

}  // namespace residual_test
}  // namespace plenum::calibration
