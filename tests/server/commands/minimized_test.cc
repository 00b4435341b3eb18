// What is minimised stands first where people read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/service.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace minimized_test {

using testing::HasSubstr;

class Minimized : public testing::Test {
 protected:
  // The gripper by this objective, in words and as JSON.
  std::string InWords(const api::Json& objective) const { return Run(objective, " --top 2").out; }
  api::Json Answer(const api::Json& objective) const {
    return api::Json::parse(Run(objective, " --top 2 --json").out);
  }

 private:
  Workbench::Outcome Run(const api::Json& objective, const std::string& options) const {
    api::Json request = Example("gripper", 20.0);
    request["objective"] = objective;
    return bench_.Run("design " + bench_.Write("request.json", request.dump()).string() + options);
  }
  const Workbench bench_;
};

TEST_F(Minimized, LitresWhereVolumeIs) {
  const std::string text = InWords({{"minimize", "volume_l"}});
  EXPECT_THAT(text, testing::ContainsRegex("Best: [0-9.]+ L, [0-9.]+ kg, estimates carry"));
}

TEST_F(Minimized, EnergyAndVolumeOfAWeightedSum) {
  const std::string text = InWords({{"minimize", {{"volume_l", 1.0}, {"energy_wh", 0.1}}}});
  EXPECT_THAT(text, testing::ContainsRegex("Best: [0-9.]+ L, [0-9.]+ Wh, [0-9.]+ kg, "));
}

TEST_F(Minimized, MassAloneAsBefore) {
  const std::string text = InWords({{"minimize", "mass_kg"}});
  EXPECT_THAT(text, testing::ContainsRegex("Best: [0-9.]+ kg, estimates carry [0-9.]+ % of it"));
}

TEST_F(Minimized, APriceThatIsNotWholeSaysSo) {
  const api::Json answer = Answer({{"minimize", "cost_eur"}});
  const std::string text = InWords({{"minimize", "cost_eur"}});
  const bool whole = answer["designs"][0]["totals"]["cost_eur"].is_number();
  EXPECT_THAT(text, testing::ContainsRegex(whole ? "Best: [0-9.]+ €, [0-9.]+ kg"
                                                 : "Best: ≥ [0-9.]+ €, [0-9.]+ kg"));
  if (answer["price_basis"] == "lower_bound") {
    EXPECT_THAT(text, HasSubstr("Unknown prices count as 0"));
  }
}

}  // namespace minimized_test
}  // namespace plenum::server
