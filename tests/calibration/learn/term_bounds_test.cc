#include "calibration/learn/term_bounds.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plenum::calibration {
namespace term_bounds_test {

// A learned term whose numbers are at these shares of what is searched, 0 to 10 for each.
Fit At(const std::string& id, const std::string& law, const std::vector<double>& shares) {
  Fit fit;
  const model::EffectSpec* spec = model::FindEffect(id, law);
  fit.state.effects = {{spec, std::vector<double>(spec->parameters.size(), 0.0)}};
  fit.u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(shares.size()));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    fit.coordinates.push_back(
        {.parameter = {.kind = Parameter::Kind::kEffect, .effect = 0, .number = i}, .high = 10.0});
    fit.u[static_cast<Eigen::Index>(i)] = 10.0 * shares[i];
  }
  return fit;
}

TEST(TermBounds, ATermThatEndsWhereTheSearchDoesWasNotFound) {
  EXPECT_TRUE(IsWithin(At("learned_sensor", "drift", {0.4, 0.2, 0.1})));
  EXPECT_FALSE(IsWithin(At("learned_sensor", "drift", {0.99995, 0.2, 0.1})));
  EXPECT_FALSE(IsWithin(At("learned_sensor", "drift", {0.4, 1.0, 0.1})));
  // Strengths of 0 are absent: a drift that does not settle.
  EXPECT_TRUE(IsWithin(At("learned_sensor", "drift", {0.0, 0.2, 0.1})));
}

TEST(TermBounds, NumbersThatOnlyShapeItAndSomeKnotsMayEndThere) {
  EXPECT_TRUE(IsWithin(At("learned_leak", "store", {0.2, 0.2, 1.0})));  // the critical ratio
  EXPECT_TRUE(IsWithin(At("learned_leak", "pressure_3", {1.0, 0.3, 0.0})));
  EXPECT_FALSE(IsWithin(At("learned_leak", "pressure_3", {1.0, 1.0, 1.0})));
}

}  // namespace term_bounds_test
}  // namespace plenum::calibration
