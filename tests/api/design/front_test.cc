#include "api/design/front.h"

#include <gtest/gtest.h>

#include "tests/api/support.h"

namespace plenum::api {
namespace front_test {

TEST(AddFront, NamesPointsAndWhatWasNotSearched) {
  optimizer::Front front;
  front.amounts = {optimizer::Amount::kMass, optimizer::Amount::kEnergy};
  front.resolution = 1e-6;
  front.searches = 3;
  front.proved = 2;
  front.answer.designs.resize(2);
  front.answer.designs[0].totals = {1.5, 2e-3, std::nullopt, 7200.0};
  front.answer.designs[1].totals = {2.5, 1e-3, std::nullopt, 3600.0};
  front.unexplored = {{{2.4, optimizer::kUnlimited}, optimizer::Amount::kEnergy, 0.5}};
  Json document = Json::object();
  AddFront(front, document);
  EXPECT_EQ(document, Parse(R"({
    "front": [ { "objectives": { "mass_kg": 1.5, "energy_wh": 2.0 }, "rank": 1 },
               { "objectives": { "mass_kg": 2.5, "energy_wh": 1.0 }, "rank": 2 } ],
    "front_proof": { "complete": false, "resolution": 1e-6, "searches": 3, "proved": 2,
      "unexplored": [ { "limits": { "mass_kg_max": 2.4 }, "energy_wh_min": 0.5 } ] } })"));
}

}  // namespace front_test
}  // namespace plenum::api
