// Terms learned from data of the independent simulator, whose truth no effect describes.
#include "calibration/learn/discrepancy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/calibration/bench.h"
#include "tests/support/bench/bench_case.h"
#include "tests/support/bench/bench_dataset.h"

namespace plenum::calibration {
namespace discrepancy_test {

struct Learning {
  explicit Learning(Dataset data_set)
      : dataset(std::move(data_set)), forward(dataset), observed(Observe(dataset)) {
    data.forward = &forward;
    data.observed = &observed;
    data.sizes = SizesOf(dataset);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
      const bool held =
          std::count(dataset.holdout.begin(), dataset.holdout.end(), dataset.runs[i].id) > 0;
      (held ? holdout : data.runs).push_back(i);
    }
    established = FitModel(data, forward.Declared(), options);
  }
  LearnedModel Learn() const { return LearnDiscrepancy(data, established, holdout, options); }

  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  FitData data;
  std::vector<std::size_t> holdout;
  FitOptions options;
  Fit established;
};

// A regulated supply and few samples: quick to fit.
Learning Of(const std::string& effect) {
  return Learning(test::ToDataset(test::DrawCase(2, test::CaseKind::kOutside, effect)));
}

TEST(Discrepancy, ASeamThatGapesIsLearnedAsALeakThatOpens) {
  const Learning learning = Of("gaping_seam");
  const LearnedModel learned = learning.Learn();
  const Discrepancy& d = learned.discrepancy;
  ASSERT_TRUE(d.learned);
  EXPECT_EQ(d.learned->effect.spec->id, "learned_leak");
  EXPECT_EQ(d.equation, model::EffectPlace::kChamber);
  EXPECT_EQ(d.learned->parameters.size(), d.learned->effect.parameters.size());
  ASSERT_TRUE(d.holdout_before_pa && d.holdout_after_pa);
  EXPECT_LT(*d.holdout_after_pa, 0.5 * *d.holdout_before_pa);
  EXPECT_LT(d.rms_after_pa, 1.3 * learning.observed[0].noise.sigma_pa);
  ASSERT_FALSE(d.places.empty());
  for (const Discrepancy::Place& place : d.places) {
    EXPECT_GT(place.share, 0.0) << place.axis;
    EXPECT_LE(place.share, 1.0) << place.axis;
    EXPECT_FALSE(place.where.empty()) << place.axis;
  }
  // The term is part of the model: predicting with it gives the error that is reported.
  EXPECT_NEAR(UnseenRms(learning.data, learned.fit.state, learning.holdout, learning.options),
              *d.holdout_after_pa, 1e-9);
}

TEST(Discrepancy, WithoutHeldOutRunsTheErrorsAreThoseOfRunsLeftOutInTurn) {
#ifdef PLENUM_SANITIZED
  GTEST_SKIP() << "takes minutes; the test above goes the same way";
#endif
  Learning learning = Of("gaping_seam");
  learning.holdout.clear();
  const LearnedModel learned = learning.Learn();
  const Discrepancy& d = learned.discrepancy;
  ASSERT_TRUE(d.holdout_before_pa && d.holdout_after_pa);
  EXPECT_GT(*d.holdout_before_pa, d.rms_before_pa);
  EXPECT_LT(*d.holdout_after_pa, 0.5 * *d.holdout_before_pa);
}

TEST(Discrepancy, ASnapOfTheWallIsLearnedInTheVolumeLaw) {
#ifdef PLENUM_SANITIZED
  GTEST_SKIP() << "takes minutes; the test above goes the same way";
#endif
  const LearnedModel learned = Of("snap_through").Learn();
  ASSERT_TRUE(learned.discrepancy.learned);
  EXPECT_EQ(learned.discrepancy.learned->effect.spec->id, "learned_volume");
  EXPECT_LT(*learned.discrepancy.holdout_after_pa, 0.5 * *learned.discrepancy.holdout_before_pa);
}

// What differs from run to run is one number of each run; what they share predicts another run.
void ExpectLearned(const std::string& effect, const std::string& id, model::EffectPlace equation) {
  const LearnedModel learned = Of(effect).Learn();
  const Discrepancy& d = learned.discrepancy;
  ASSERT_TRUE(d.learned) << effect;
  EXPECT_EQ(d.learned->effect.spec->id, id) << effect;
  EXPECT_EQ(d.equation, equation) << effect;
  EXPECT_EQ(d.learned->parameters.size(), d.learned->effect.parameters.size()) << effect;
  EXPECT_LT(*d.holdout_after_pa, 0.5 * *d.holdout_before_pa) << effect;
}

TEST(Discrepancy, ASwingingRegulatorIsLearnedInTheSupply) {
  const test::BenchCase bench = test::DrawCase(3, test::CaseKind::kOutside, "swinging_regulator");
  const LearnedModel learned = Learning(test::ToDataset(bench)).Learn();
  ASSERT_TRUE(learned.discrepancy.learned);
  const model::Effect& effect = learned.discrepancy.learned->effect;
  ASSERT_EQ(effect.spec->id, "learned_supply");
  const test::TrueEffect& truth = bench.effects.front();
  EXPECT_NEAR(effect.parameters[0], truth["amplitude"], 0.1 * truth["amplitude"]);
  EXPECT_NEAR(effect.parameters[1], truth["frequency_hz"], 0.01 * truth["frequency_hz"]);
  EXPECT_LT(*learned.discrepancy.holdout_after_pa, 0.5 * *learned.discrepancy.holdout_before_pa);
}

TEST(Discrepancy, ADriftingSensorIsLearnedInTheSensor) {
  ExpectLearned("drifting_sensor", "learned_sensor", model::EffectPlace::kSensor);
}

TEST(Discrepancy, AStickingValveIsLearnedAsLateStrokes) {
  ExpectLearned("sticking_valve", "learned_valve", model::EffectPlace::kValve);
}

// With these effects, from these parameters.
Fit Named(const Learning& learning, const std::vector<model::Effect>& effects) {
  ModelState state = learning.established.state;
  state.effects = effects;
  return FitModel(learning.data, state, learning.options);
}

TEST(Discrepancy, OneTermRivalsWhatOnlyImitatesAndNotWhatIsTrue) {
  const Learning seam = Of("gaping_seam");
  std::vector<model::Effect> imitating;
  for (const auto& [id, law] : {std::pair{"creep", ""}, std::pair{"leak", "laminar"}})
    imitating.push_back(EffectStarts(*model::FindEffect(id, law), seam.data.sizes).front());
  const Fit imitation = Named(seam, imitating);
  ASSERT_TRUE(imitation.Usable());
  ASSERT_LT(imitation.bic, seam.established.bic);
  EXPECT_TRUE(RivalOf(seam.data, seam.established, imitation, seam.options).instead);

  const test::BenchCase pair = test::DrawCase(2, test::CaseKind::kPair);
  const Learning two(test::ToDataset(pair));
  const Fit truth = Named(two, test::ListedOf(pair));
  ASSERT_TRUE(truth.Usable());
  EXPECT_FALSE(RivalOf(two.data, two.established, truth, two.options).instead);
}

// Both are in every curve of the sensor.
TEST(Discrepancy, ACurveOfTheSensorIsNoRivalOfItsGainAndItsOffset) {
  const Learning learning(test::MeasuredBench(
      [](test::EffectRig& rig) {
        rig.sensor_gain = 1.03;
        rig.sensor_offset_pa = 2e3;
      },
      9));
  const Fit truth = Named(learning, {{model::FindEffect("sensor_gain"), {1.01}},
                                     {model::FindEffect("sensor_offset"), {500.0}}});
  ASSERT_TRUE(truth.Usable());
  const Rival rival = RivalOf(learning.data, learning.established, truth, learning.options);
  EXPECT_FALSE(rival.instead);
  EXPECT_EQ(rival.as_good, nullptr);
}

TEST(Discrepancy, NothingIsLearnedFromNoise) {
  const Learning learning(test::ToDataset(test::DrawCase(2, test::CaseKind::kClean)));
  const LearnedModel learned = learning.Learn();
  EXPECT_FALSE(learned.discrepancy.learned);
  EXPECT_EQ(learned.fit.state.effects.size(), 0u);
  EXPECT_EQ(*learned.discrepancy.holdout_after_pa, *learned.discrepancy.holdout_before_pa);
}

}  // namespace discrepancy_test
}  // namespace plenum::calibration
