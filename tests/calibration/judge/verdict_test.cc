#include "calibration/judge/verdict.h"

#include <gtest/gtest.h>

namespace plenum::calibration {
namespace verdict_test {

Leftover Noise() {
  Leftover leftover;
  leftover.residual.white = leftover.residual.independent_of_inputs = true;
  leftover.residual.lack_of_fit = 1.0;
  leftover.residual.lack_of_fit_limit = 1.1;
  leftover.rms_pa = leftover.noise_pa = 100.0;
  leftover.holdout_rms_pa = leftover.holdout_noise_pa = 100.0;
  return leftover;
}

Leftover Structure(double rms_pa) {
  Leftover leftover = Noise();
  leftover.residual.white = false;
  leftover.rms_pa = rms_pa;
  return leftover;
}

TEST(Verdict, OfWhatIsLeft) {
  EXPECT_EQ(Judge({false, true, 0, Structure(900), Noise()}), Verdict::kUndecided);
  EXPECT_EQ(Judge({true, false, 0, Noise(), Noise()}), Verdict::kAdequate);
  EXPECT_EQ(Judge({true, false, 0, Structure(900), Structure(900)}), Verdict::kUnexplained);
  EXPECT_EQ(Judge({true, true, 0, Structure(900), Noise()}), Verdict::kExplained);
  EXPECT_EQ(Judge({true, true, 2, Structure(900), Noise()}), Verdict::kTie);
  EXPECT_EQ(Judge({true, true, 2, Structure(900), Structure(400)}), Verdict::kUnexplained);
}

TEST(Verdict, ATieMayStandBesideSmallStructure) {
  EXPECT_TRUE(IsTieBesideStructure({true, true, 1, Structure(900), Structure(350)}));
  EXPECT_FALSE(IsTieBesideStructure({true, true, 1, Structure(900), Structure(500)}));
  EXPECT_FALSE(IsTieBesideStructure({true, true, 0, Structure(900), Structure(250)}));
  Leftover unseen_off = Structure(250);
  unseen_off.holdout_rms_pa = 200.0;
  EXPECT_FALSE(IsTieBesideStructure({true, true, 1, Structure(900), unseen_off}));
}

TEST(Verdict, ASetThatOnlyImitatesIsNotNamed) {
  Evidence evidence{true, true, 0, Structure(900), Noise()};
  evidence.imitated = true;
  EXPECT_EQ(Judge(evidence), Verdict::kUnexplained);
  evidence.imitated = false;
  evidence.after.priors_hold = false;
  EXPECT_EQ(Judge(evidence), Verdict::kUnexplained);
  Evidence tie{true, true, 1, Structure(900), Structure(250)};
  tie.after.priors_hold = false;
  EXPECT_FALSE(IsTieBesideStructure(tie));
}

// What is missing may hide in them, and leave nothing but noise.
TEST(Verdict, AModelIsNotGoodEnoughWithNumbersBeyondTheirUncertainties) {
  Leftover stretched = Noise();
  stretched.priors_hold = false;
  const Evidence evidence{true, false, 0, stretched, stretched};
  EXPECT_EQ(Judge(evidence), Verdict::kUnexplained);
  EXPECT_EQ(WhatIsOpen(evidence), "declared numbers are beyond their uncertainties");
}

TEST(Verdict, WhatATermCouldLearnIsNoNoise) {
  Leftover learnable = Noise();
  learnable.learnable_bic = 40.0;
  EXPECT_EQ(Judge({true, false, 0, learnable, learnable}), Verdict::kUnexplained);
  learnable.rms_pa = 110.0;  // of 900: not small beside the noise
  EXPECT_EQ(Judge({true, true, 0, Structure(900), learnable}), Verdict::kUnexplained);
}

TEST(Verdict, RunsNotSeenMayNotBeOff) {
  Leftover before = Structure(900), after = Noise();
  before.holdout_rms_pa = 900.0;
  after.holdout_rms_pa = 200.0;
  EXPECT_EQ(Judge({true, true, 0, before, after}), Verdict::kUnexplained);
  after.holdout_spread_pa = 60.0;  // of one number, which may be two or three deviations off
  EXPECT_EQ(Judge({true, true, 0, before, after}), Verdict::kExplained);
  before.holdout_rms_pa = 180.0;  // without the effects they are predicted better
  EXPECT_TRUE(PredictsWorse(before, after));
  EXPECT_EQ(Judge({true, true, 0, before, after}), Verdict::kUnexplained);
  EXPECT_FALSE(PredictsWorse(before, Noise()));
  before.holdout_rms_pa = 900.0;
  after.holdout_rms_pa = 300.0;
  EXPECT_EQ(Judge({true, true, 0, before, after}), Verdict::kUnexplained);
  after.holdout_rms_pa.reset();
  EXPECT_EQ(Judge({true, true, 0, before, after}), Verdict::kExplained);
}

TEST(Verdict, UnexplainedFractionIsOfTheVarianceAboveTheNoise) {
  EXPECT_EQ(UnexplainedFraction(Structure(900), Noise()), 0.0);
  EXPECT_NEAR(UnexplainedFraction(Structure(900), Structure(500)), 24.0 / 80.0, 1e-12);
  EXPECT_EQ(UnexplainedFraction(Structure(500), Structure(900)), 1.0);
}

// Noise that is the signal's own is as large as what any model leaves.
TEST(Verdict, BesideRoughNoiseASetMustExplainMostOfTheError) {
  Evidence evidence{true, true, 0, Structure(300), Noise()};
  EXPECT_EQ(Judge(evidence), Verdict::kExplained);
  evidence.after.rough_noise = true;
  EXPECT_EQ(Judge(evidence), Verdict::kExplained);  // a ninth is left
  evidence.before.rms_pa = 200.0;
  EXPECT_EQ(Judge(evidence), Verdict::kUnexplained);
}

// Gas that is 50 K off shows what is missing, though the pressure is hardly nearer.
TEST(Verdict, OtherChannelsCountAmongWhatIsLeft) {
  Leftover before = Structure(900), after = Structure(600);  // 100 of noise
  EXPECT_NEAR(UnexplainedFraction(before, after), 35.0 / 80.0, 1e-12);
  before.pressure_readings = after.pressure_readings = 20;
  before.channels_above = 20.0 * 240.0, after.channels_above = 20.0 * 5.0;
  EXPECT_NEAR(UnexplainedFraction(before, after), (35.0 + 5.0) / (80.0 + 240.0), 1e-12);
}

TEST(Verdict, OfUnseenRuns) {
  EXPECT_FALSE(PredictsBetter({}, 3.0).has_value());
  EXPECT_FALSE(PredictsBetter(3.0, {}).has_value());
  EXPECT_TRUE(PredictsBetter(3.0, 2.9).value());
  EXPECT_FALSE(PredictsBetter(3.0, 3.0).value());
}

}  // namespace verdict_test
}  // namespace plenum::calibration
