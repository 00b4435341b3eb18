// Lists as people ask for them: of kinds or combinations, of products, by cost.
#include <gtest/gtest.h>

#include <set>

#include "optimizer/problem/proof.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace lists_test {

TEST(ListsTest, OfKindsUnlessAskedOtherwise) {
  const Json request = With(Example("gripper"), "/ranking", {{"proof", true}});
  const Json kinds = Answered(request);
  EXPECT_EQ(kinds["list"], "kinds");
  ASSERT_GE(kinds["designs"].size(), 2u);
  std::set<std::string> seen;
  for (const Json& design : kinds["designs"]) {
    EXPECT_TRUE(seen.insert(design["kind"].dump()).second) << design["kind"];
    EXPECT_TRUE(design["variants"]["complete"]);
    for (const Json& variant : design["variants"]["examples"]) {
      EXPECT_GE(variant["objective"], design["objective"]);
      EXPECT_LE(variant["objective"].get<double>(), 1.01 * design["objective"].get<double>());
      EXPECT_FALSE(variant["parts"].empty());
    }
  }
  EXPECT_EQ(Refusals(kinds), "");
  const Json all = Answered(With(request, "/ranking/list", "combinations"));
  EXPECT_EQ(all["list"], "combinations");
  EXPECT_EQ(all["designs"][0]["parts"], kinds["designs"][0]["parts"]);
  EXPECT_FALSE(all.contains("by_configuration"));
  EXPECT_EQ(Refusals(all), "");
  const auto change = [](Json& answer, int from, Json to) {  // the first box that ends so
    for (Json& box : answer["proof"]["record"]["plans"][0]["boxes"])
      if (box[0] == from) {
        box = std::move(to);
        return;
      }
  };
  const int kind = static_cast<int>(optimizer::BoxKind::kKind);
  const Tampering tamperings[] = {
      {"a box of a kind that is better than its design", "bound",
       [&](Json& answer) {
         change(answer, kind, {kind, 1e-3});
       }},
      {"one more of a source than there may be", "order",
       [](Json& answer) { answer["requirements"]["ranking"]["per_source"] = 1; }},
      {"the same twice", "order",
       [](Json& answer) {
         answer["designs"][1] = answer["designs"][0];
         answer["designs"][1]["rank"] = 2;
       }},
      {"a list of kinds sold as one of combinations", "bound",
       [](Json& answer) { answer["list"] = "combinations"; }},
  };
  ExpectRefused(kinds, tamperings);
}

// Overlapping strokes on a compressor take all the time that a list has; bottles are found at once.
TEST(ListsTest, OneThatTakesAllItsTimeKeepsSomeForEachConfiguration) {
  Json request = Example("walking_gait");
  request["supply"]["configurations"] = {"compressor", "co2"};
  request["ranking"] = {{"count", 5}, {"time_limit_s", 5}};
  const Json answer = Answered(request);
  for (const Json& best : answer["by_configuration"]) {
    const bool found = !best["design"].is_null();
    EXPECT_TRUE(found || !best["conflict"].empty()) << best["configuration"];
  }
}

TEST(ListsTest, OfProductsAlone) {
  const Json few = With(Example("exosuit"), "/ranking/count", 2);
  const Json any = Answered(few);
  const Json products = Answered(With(few, "/supply/parts", "orderable"));
  ASSERT_FALSE(products["designs"].empty());
  for (const Json& design : products["designs"])
    EXPECT_TRUE(design["data_quality"]["not_orderable"].empty()) << design["rank"];
  EXPECT_GE(products["designs"][0]["objective"], any["designs"][0]["objective"]);
  EXPECT_EQ(any["orderable"]["status"], "optimal");
  EXPECT_DOUBLE_EQ(any["orderable"]["objective"].get<double>(),
                   products["designs"][0]["objective"].get<double>());
  EXPECT_FALSE(products.contains("orderable"));
  EXPECT_TRUE(products["left_out"].contains("orderable"));
  EXPECT_FALSE(any["left_out"].contains("orderable"));
  EXPECT_EQ(Refusals(products), "");
}

TEST(ListsTest, LeftOutIsWhatCouldNotBeChosen) {
  const Json first = Answered(Example("gripper"));
  std::string valve;
  for (const Json& row : first["designs"][0]["parts"])
    if (row["family"] == "valve") valve = row["id"];
  const Json without = Answered(With(Example("gripper"), "/exclude", {valve}));
  EXPECT_EQ(without["left_out"]["exclude"], Json::array({valve}));
  const Json with = Answered(With(Example("gripper"), "/require", {{"valve", {valve}}}));
  const int valves = with["left_out"]["require"]["valve"];
  EXPECT_GT(valves, 50);
  EXPECT_FALSE(with["left_out"].contains("exclude"));
}

// An unknown price is no reason not to answer; counted as nothing it makes no list dearer.
TEST(ListsTest, ByCost) {
  Json request = With(Example("gripper"), "/objective", {{"minimize", "cost_eur"}});
  const Json known = Answered(request);
  const Json least = Answered(With(request, "/prices", "lower_bound"));
  ASSERT_FALSE(known["designs"].empty());
  ASSERT_FALSE(least["designs"].empty());
  EXPECT_EQ(least["price_basis"], "lower_bound");
  EXPECT_LE(least["designs"][0]["objective"], known["designs"][0]["objective"]);
  EXPECT_TRUE(least["unpriced"].contains("valve"));
  // Of the same price the lightest first: a kilogram counts as a tenth of a cent.
  for (const Json& design : least["designs"])
    EXPECT_NEAR(design["objective"].get<double>(),
                design["totals"]["cost_eur_min"].get<double>() +
                    1e-3 * design["totals"]["mass_kg"].get<double>(),
                1e-9);
  for (std::size_t i = 1; i < least["designs"].size(); ++i) {
    const Json &lighter = least["designs"][i - 1]["totals"], &next = least["designs"][i]["totals"];
    if (lighter["cost_eur_min"] != next["cost_eur_min"]) continue;
    EXPECT_LE(lighter["mass_kg"], next["mass_kg"]);
  }
  EXPECT_EQ(Refusals(known), "");
  EXPECT_EQ(Refusals(least), "");
}

}  // namespace lists_test
}  // namespace plenum::api
