// Declared numbers that are wrong, on data of the independent simulator.
#include "calibration/names/wrong_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calibration/diagnose.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace wrong_numbers_test {

using test::EffectRig;
using testing::Contains;
using testing::ElementsAre;
using testing::UnorderedElementsAre;
using Set = std::vector<std::string>;

// All of a bench's declared numbers are exact, or those that a bench usually states are not.
Dataset Measured(const test::Change& change, bool exact) {
  Dataset dataset = test::MeasuredBench(change, 31);
  if (exact) dataset.relative_uncertainty.fill(0.0);
  return dataset;
}

// The declared source is 15 % above the true one.
void WeakSource(EffectRig& rig) { rig.source_pa = 1e5 + (rig.source_pa - 1e5) / 1.15; }

void ExpectOnlyNumber(const Diagnosis& d, Declared number, double factor, double sigma) {
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  EXPECT_TRUE(d.effects.empty());
  ASSERT_EQ(d.numbers.size(), 1u) << d.sentence;
  EXPECT_EQ(d.numbers[0].number, number);
  EXPECT_NEAR(d.numbers[0].factor, factor, 0.01 * factor);
  ASSERT_TRUE(d.numbers[0].deviation_sigma.has_value());
  EXPECT_NEAR(*d.numbers[0].deviation_sigma, (factor - 1.0) / sigma, 0.01 * factor / sigma);
  EXPECT_LT(d.after.rms_pa, 1.1 * test::kBenchNoisePa);
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
  EXPECT_EQ(d.models.after.state.factor[static_cast<std::size_t>(number)], d.numbers[0].factor);
  const std::string title = "number:" + std::string(Name(number));
  ASSERT_FALSE(d.candidates.empty());
  EXPECT_EQ(d.candidates.front().effects, Set{title});
  EXPECT_TRUE(std::all_of(d.stability.begin(), d.stability.end(),
                          [](const StabilityChange& change) { return change.holds; }));
  EXPECT_THAT(d.sentence, testing::HasSubstr(std::string(Name(number))));
}

TEST(WrongNumbers, ASourceThatIsLowerThanDeclaredIsNamedAndNoEffect) {
  const Diagnosis d = Diagnose(Measured(WeakSource, true), {});
  ExpectOnlyNumber(d, Declared::kSourcePressure, 1.0 / 1.15, kExactUncertainty);
  EXPECT_FALSE(d.numbers[0].instead_of.empty());
  for (const std::string& id : d.numbers[0].instead_of) EXPECT_FALSE(id.starts_with("number:"));
}

TEST(WrongNumbers, AnExpansionRatioIsNamedWithTheTrueOne) {
  const Diagnosis d =
      Diagnose(Measured([](EffectRig& rig) { rig.expansion_ratio = 1.3; }, false), {});
  ExpectOnlyNumber(d, Declared::kExpansionRatio, 1.3 / 2.0, kExactUncertainty);
}

// Six and a half standard deviations: fits do not stretch it so far, and no effect is named.
TEST(WrongNumbers, AnUncertainNumberMayLeaveItsUncertaintyAtAPrice) {
  Dataset dataset = Measured(WeakSource, false);
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSourcePressure)] = 0.02;
  ExpectOnlyNumber(Diagnose(dataset, {}), Declared::kSourcePressure, 1.0 / 1.15, 0.02);
}

// C/V is all that the pressure of an isothermal chamber shows of either: a flow would tell them
// apart.
TEST(WrongNumbers, ConductanceAndVolumeAreATie) {
  Dataset dataset = Measured([](EffectRig& rig) { rig.rest_volume_m3 *= 1.2; }, true);
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kTie) << d.sentence;
  EXPECT_THAT(d.tied,
              UnorderedElementsAre(Set{"number:rest_volume"}, Set{"number:sonic_conductance"}));
  EXPECT_TRUE(d.numbers.empty());
  ASSERT_TRUE(d.next_experiment.has_value());
  EXPECT_FALSE(d.next_experiment->measure.empty());
  EXPECT_THAT(d.sentence, testing::HasSubstr("another rest_volume"));
}

// The same where the volumes are declared as a table: it is too small throughout.
TEST(WrongNumbers, ATableOfVolumesMayBeWrongLikeARestVolume) {
  Dataset dataset = Measured([](EffectRig& rig) { rig.rest_volume_m3 *= 1.2; }, true);
  for (auto& run : dataset.runs) {
    run.chamber.expansion_ratio = 1.0;
    run.chamber.volume_curve = model::MonotoneCurve({1e5, 2e5, 5e5}, {50e-6, 100e-6, 250e-6});
  }
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kTie) << d.sentence;
  EXPECT_THAT(d.tied,
              UnorderedElementsAre(Set{"number:rest_volume"}, Set{"number:sonic_conductance"}));
}

// With little noise the numbers that are not freed must not keep what the freed one is to take up:
// fits crawl along the bent valley of equal C/V.
TEST(WrongNumbers, UncertainConductanceAndVolumeAreATieInQuietReadings) {
  const auto change = [](EffectRig& rig) {
    rig.rest_volume_m3 *= 1.27;
    rig.expansion_ratio *= 0.99;
    rig.fill[0].conductance *= 1.03, rig.exhaust[0].conductance *= 1.03;
  };
  Dataset dataset = test::MeasuredBench(change, 33, 25.0);
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.01;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kExpansionRatio)] = 0.01;
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kTie) << d.sentence;
  EXPECT_THAT(d.tied,
              UnorderedElementsAre(Set{"number:rest_volume"}, Set{"number:sonic_conductance"}));
}

TEST(WrongNumbers, OneMayStandBesideAnEffect) {
  const Diagnosis d = Diagnose(Measured(
                                   [](EffectRig& rig) {
                                     WeakSource(rig);
                                     rig.leak = test::OrificeLeak{6e-12, 0.3};
                                   },
                                   false),
                               {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
  ASSERT_EQ(d.numbers.size(), 1u);
  EXPECT_EQ(d.numbers[0].number, Declared::kSourcePressure);
  EXPECT_NEAR(d.numbers[0].factor, 1.0 / 1.15, 0.01);
}

TEST(WrongNumbers, NoneWhereEveryNumberIsWithinItsUncertainty) {
  const Diagnosis d = Diagnose(Measured(
                                   [](EffectRig& rig) {
                                     rig.rest_volume_m3 *= 0.97;
                                     rig.leak = test::OrificeLeak{6e-12, 0.3};
                                   },
                                   false),
                               {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  EXPECT_EQ(d.effects.size(), 1u);
  EXPECT_TRUE(d.numbers.empty()) << d.sentence;
}

// The operating pressure is where the expansion ratio holds; a ratio of 0 times anything is 0; what
// is unknown is fitted freely without a name.
TEST(WrongNumbers, OnlyThoseThatReadingsCanTellMayBeWrong) {
  Dataset dataset = test::MeasuredBench({}, 32);
  const auto names = [&] {
    Set ids;
    for (const model::EffectSpec* spec : NumbersThatMayBeWrong(dataset)) ids.emplace_back(spec->id);
    return ids;
  };
  EXPECT_THAT(names(), ElementsAre("number:rest_volume", "number:expansion_ratio",
                                   "number:source_pressure", "number:sonic_conductance",
                                   "number:critical_ratio", "number:ambient_pressure"));
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSourcePressure)] = kUnknown;
  for (calibration::Run& run : dataset.runs)
    run.line[0].fill.critical_ratio = run.line[0].exhaust.critical_ratio = 0.0;
  EXPECT_THAT(names(), ElementsAre("number:rest_volume", "number:expansion_ratio",
                                   "number:sonic_conductance", "number:ambient_pressure"));
  for (calibration::Run& run : dataset.runs) run.blocked = true, run.valve.clear();
  EXPECT_THAT(names(), ElementsAre("number:rest_volume", "number:ambient_pressure"));
}

TEST(WrongNumbers, NumbersAtAnEndOrFarOffAreSaid) {
  Fit fit;
  const auto add = [&](Declared number, double u, bool prior) {
    Coordinate coordinate{.parameter = {.kind = Parameter::Kind::kDeclared, .declared = number},
                          .low = -10.0,
                          .high = 20.0,
                          .prior = prior};
    fit.coordinates.push_back(coordinate);
    fit.u.conservativeResize(static_cast<Eigen::Index>(fit.coordinates.size()));
    fit.u[fit.u.size() - 1] = u;
  };
  add(Declared::kRestVolume, 2.9, true);
  add(Declared::kSonicConductance, -3.4, true);
  add(Declared::kSourcePressure, 20.0, false);
  add(Declared::kExpansionRatio, 15.0, false);
  const std::vector<std::string> said = FarNumbers(Dataset{}, fit);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_THAT(said, Contains(testing::HasSubstr("sonic_conductance was fitted 3.4")));
  EXPECT_THAT(said, Contains(testing::HasSubstr("source_pressure ended at an end")));
}

// A critical ratio of 0 is no absence: it shapes what the leak does. A strength of 0 is one.
TEST(WrongNumbers, OnlyAStrengthOfZeroIsAnAbsence) {
  Fit fit;
  fit.state.effects = {{model::FindEffect("leak", "orifice"), {0.0, 0.0}}};
  for (const std::size_t number : {0u, 1u})
    fit.coordinates.push_back(
        {.parameter = {.kind = Parameter::Kind::kEffect, .effect = 0, .number = number},
         .low = 0.0,
         .high = 20.0});
  fit.u = Eigen::VectorXd::Zero(2);
  const std::vector<std::string> said = FarNumbers(Dataset{}, fit);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_THAT(said.front(), testing::HasSubstr("critical_ratio ended at an end"));
}

// The laboratory lies at 1,700 m, and the rig is declared at sea level: gauges show the same.
TEST(WrongNumbers, AnAmbientPressureThatIsLowerThanDeclaredIsNamed) {
  constexpr double kTruePa = 82e3;
  Dataset dataset = Measured(
      [](EffectRig& rig) {
        const double lower_pa = 1e5 - kTruePa;
        rig.ambient_pa = kTruePa;
        rig.source_pa -= lower_pa;
        rig.initial_pa -= lower_pa;
        rig.operating_pa -= lower_pa;
      },
      true);
  for (calibration::Run& run : dataset.runs)
    for (double& pa : run.pressure_pa) pa += 1e5 - kTruePa;
  ExpectOnlyNumber(Diagnose(dataset, {}), Declared::kAmbientPressure, kTruePa / 1e5,
                   kExactUncertainty);
}

TEST(WrongNumbers, FactorsStayWhereTheRigMakesSense) {
  Dataset dataset = test::MeasuredBench(nullptr, 31);  // ε 2, b 0.3, 100 kPa
  EXPECT_DOUBLE_EQ(FactorRange(dataset, Declared::kExpansionRatio).first, 0.5);
  EXPECT_DOUBLE_EQ(FactorRange(dataset, Declared::kCriticalRatio).second, 0.95 / 0.3);
  EXPECT_DOUBLE_EQ(FactorRange(dataset, Declared::kAmbientPressure).first, 0.5);
  EXPECT_DOUBLE_EQ(FactorRange(dataset, Declared::kAmbientPressure).second, 1.1);
  EXPECT_TRUE(std::isinf(FactorRange(dataset, Declared::kRestVolume).second));
}

// A wall that is stiffer than any: the freed expansion ratio comes to 1 and takes up what it can.
TEST(WrongNumbers, ANumberAtAnEndIsNoCause) {
  Contender contender;
  contender.fit.state.freed[static_cast<std::size_t>(Declared::kExpansionRatio)] = true;
  contender.fit.coordinates.push_back(
      {.parameter = {.kind = Parameter::Kind::kDeclared, .declared = Declared::kExpansionRatio},
       .low = -50.0,
       .high = 1900.0});
  contender.fit.u = Eigen::VectorXd::Constant(1, -30.0);
  EXPECT_TRUE(MayBeNamed(contender));
  contender.fit.u[0] = -50.0;
  EXPECT_FALSE(MayBeNamed(contender));
  contender.fit.state.freed = {};
  EXPECT_TRUE(MayBeNamed(contender));
}

// Commands that are off by a sample are no delay of the valve.
TEST(WrongNumbers, NorIsADelayWithinASampleOfAFewAStroke) {
  const model::EffectSpec& delay = *model::FindEffect("valve_delay");
  for (const double interval_s : {0.01, 0.3}) {
    Contender contender{.effects = {&delay}, .fit = {}};
    contender.fit.coordinates =
        EffectCoordinates(delay, 0, {.interval_s = interval_s, .stroke_s = 1.0});
    contender.fit.u = Eigen::VectorXd::Constant(1, 0.2);  // 0.2 s
    EXPECT_EQ(MayBeNamed(contender), interval_s < 0.2);
    contender.fit.u[0] = 0.4;
    EXPECT_TRUE(MayBeNamed(contender));
  }
}

}  // namespace wrong_numbers_test
}  // namespace plenum::calibration
