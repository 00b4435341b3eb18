// Which effects a search tries.
#include "calibration/values/effect_sets.h"

#include <gtest/gtest.h>

#include "tests/calibration/bottle.h"

namespace plenum::calibration {
namespace effect_sets_test {

// A bottle has the same volume at any pressure.
TEST(EffectSets, EffectsOnTheVolumesLawAreNotTriedOnABottle) {
  Dataset dataset = test::BottleTestOfAValve({}, 1);
  for (const char* id : {"inertia", "creep", "hysteresis", "nonlinear_compliance"}) {
    EXPECT_FALSE(HoldsId(NamedEffects(dataset.runs), id)) << id;
  }
  EXPECT_TRUE(HoldsId(NamedEffects(dataset.runs), "heat_transfer"));
  EXPECT_TRUE(HoldsId(NamedEffects(dataset.runs), "leak"));
  dataset.runs.back().chamber.expansion_ratio = 1.5;
  EXPECT_TRUE(HoldsId(NamedEffects(dataset.runs), "creep"));
  dataset.runs.back().blocked = true;
  EXPECT_FALSE(HoldsId(NamedEffects(dataset.runs), "creep"));
}

}  // namespace effect_sets_test
}  // namespace plenum::calibration
