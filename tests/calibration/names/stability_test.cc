// Names under changed readings, on data of the independent simulator.
#include "calibration/names/stability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "calibration/judge/evidence.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace stability_test {

using testing::ElementsAre;

// Three runs of a bench that leaks, and fits of sets that are given.
struct Leaking {
  explicit Leaking(const test::Change& change =
                       [](test::EffectRig& rig) {
                         rig.leak = test::OrificeLeak{6e-12, 0.3};
                       })
      : dataset(test::MeasuredBench(change, 41)),
        forward(dataset),
        observed(Observe(dataset)),
        bench{dataset, forward, observed, {}, {3}, OriginalsOf(dataset), {}} {
    bench.data.forward = &forward;
    bench.data.observed = &observed;
    bench.data.sizes = SizesOf(dataset);
    bench.data.runs = {0, 1, 2};
    bench.tight.function_tolerance = 1e-9;
  }

  Contender With(const std::vector<const model::EffectSpec*>& effects) const {
    ModelState start = forward.Declared();
    for (const model::EffectSpec* spec : effects)
      start.effects.push_back(EffectStarts(*spec, bench.data.sizes).front());
    Contender contender{.effects = effects, .fit = FitModel(bench.data, start, bench.tight)};
    Narrow(bench.data, bench.tight, contender.fit);
    return contender;
  }

  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  Bench bench;
};

const model::EffectSpec* const kLeak = model::FindEffect("leak", "orifice");
const model::EffectSpec* const kCreep = model::FindEffect("creep");
const model::EffectSpec* const kOffset = model::FindEffect("sensor_offset");

std::vector<std::string> ChangesIn(const Stability& stability) {
  std::vector<std::string> changes;
  for (const StabilityChange& change : stability.changes) changes.push_back(change.change);
  return changes;
}

TEST(Stability, TheTrueNameHoldsUnderEveryChange) {
  const Leaking leaking;
  const std::vector<Contender> contenders = {leaking.With({}), leaking.With({kLeak}),
                                             leaking.With({kOffset})};
  const Stability found = StabilityOf(leaking.bench, contenders, {&contenders[1]}, 1.0);
  EXPECT_TRUE(found.Holds());
  EXPECT_TRUE(found.beaten_by.empty());
  EXPECT_THAT(
      ChangesIn(found),
      ElementsAre("even readings", "odd readings", "without low", "without high", "without blocked",
                  "a shift of 0.1 % of the range", "noise of its own size"));
  const double all =
      BicWith(contenders[2].fit, 1.0) - BicWith(contenders[1].fit, 1.0);  // of all readings
  ASSERT_GT(all, 100.0);
  for (const StabilityChange& change : found.changes) ASSERT_TRUE(change.delta_bic.has_value());
  // Half of the readings tell about half, and noise makes them tell less.
  EXPECT_NEAR(*found.changes[0].delta_bic + *found.changes[1].delta_bic, all, 0.25 * all);
  EXPECT_LT(*found.changes[6].delta_bic, 0.9 * all);
}

TEST(Stability, AFalseNameFailsToTheTrueOne) {
  const Leaking leaking;
  const std::vector<Contender> contenders = {leaking.With({}), leaking.With({kLeak}),
                                             leaking.With({kOffset})};
  const Stability found = StabilityOf(leaking.bench, contenders, {&contenders[2]}, 1.0);
  EXPECT_FALSE(found.Holds());
  for (const StabilityChange& change : found.changes) EXPECT_FALSE(change.holds) << change.change;
  for (const Contender* other : found.beaten_by) EXPECT_EQ(other, &contenders[1]);
  EXPECT_EQ(found.beaten_by.size(), found.changes.size());
}

// A set that holds the name, or a part of it, speaks for it.
TEST(Stability, PartsAndLargerSetsAreNoRivals) {
  const Leaking leaking;
  const std::vector<Contender> contenders = {leaking.With({}), leaking.With({kLeak}),
                                             leaking.With({kCreep, kLeak})};
  const Stability found = StabilityOf(leaking.bench, contenders, {&contenders[1]}, 1.0);
  EXPECT_TRUE(found.Holds());
  for (const StabilityChange& change : found.changes) EXPECT_FALSE(change.delta_bic.has_value());
}

// Without the free run nothing is left of a creeping wall: in the blocked one it does nothing, and
// a rival of fewer numbers is the better, as the base model is. That is no failure of the name.
TEST(Stability, ANameMayLoseItsSignificance) {
  Leaking creeping([](test::EffectRig& rig) { rig.creep = test::Creep{0.15, 2.0}; });
  creeping.bench.data.runs = {1, 2};
  const std::vector<Contender> contenders = {creeping.With({}), creeping.With({kCreep}),
                                             creeping.With({kOffset})};
  const Stability found = StabilityOf(creeping.bench, contenders, {&contenders[1]}, 1.0);
  EXPECT_TRUE(found.Holds());
  const auto without =
      std::find_if(found.changes.begin(), found.changes.end(),
                   [](const StabilityChange& change) { return change.change == "without high"; });
  ASSERT_NE(without, found.changes.end());
  ASSERT_TRUE(without->delta_bic.has_value());
  EXPECT_GT(*without->delta_bic, 0.0);  // creep itself is worse than the offset by a number
}

TEST(Stability, ATieHoldsWhereOneOfItsSetsDoes) {
  const Leaking leaking;
  const std::vector<Contender> contenders = {leaking.With({}), leaking.With({kLeak}),
                                             leaking.With({kOffset}), leaking.With({kCreep})};
  const Stability found =
      StabilityOf(leaking.bench, contenders, {&contenders[2], &contenders[1]}, 1.0);
  EXPECT_TRUE(found.Holds());
}

TEST(Stability, OneRunIsNotLeftOut) {
  Leaking leaking;
  leaking.bench.data.runs = {1};
  const std::vector<Contender> contenders = {leaking.With({}), leaking.With({kLeak})};
  const Stability found = StabilityOf(leaking.bench, contenders, {&contenders[1]}, 1.0);
  EXPECT_THAT(ChangesIn(found),
              ElementsAre("even readings", "odd readings", "a shift of 0.1 % of the range",
                          "noise of its own size"));
}

// Both halves together are all readings, and the whitening is that of the times that are left.
TEST(Stability, EverySecondReadingLeavesTheOthers) {
  const Leaking leaking;
  const auto even = EverySecond(leaking.dataset, leaking.observed, 0);
  const auto odd = EverySecond(leaking.dataset, leaking.observed, 1);
  for (std::size_t run = 0; run < leaking.observed.size(); ++run) {
    const std::vector<std::size_t>& all = leaking.observed[run].signals.front().samples;
    std::vector<std::size_t> both = even[run].signals.front().samples;
    const std::vector<std::size_t>& others = odd[run].signals.front().samples;
    EXPECT_EQ(both.size(), even[run].rows());
    both.insert(both.end(), others.begin(), others.end());
    EXPECT_THAT(both, testing::UnorderedElementsAreArray(all));
    EXPECT_EQ(even[run].signals.front().steps.size(), even[run].rows());
  }
}

}  // namespace stability_test
}  // namespace plenum::calibration
