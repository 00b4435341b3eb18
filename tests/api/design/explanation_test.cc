#include "api/design/explanation.h"

#include <gtest/gtest.h>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace explanation_test {

TEST(RenderPrice, SaysWhatIsSavedOrThatItIsNotKnown) {
  optimizer::Price price{"/duty/actuations", 1000.0, 900.0, optimizer::Status::kOptimal, 1.5, 1.5};
  EXPECT_EQ(RenderPrice(price, 2.0), Parse(R"({"requirement": "/duty/actuations",
      "required": 1000.0, "loosened": 900.0, "status": "optimal", "objective": 1.5,
      "lower_bound": 1.5, "saving": 0.5, "saving_share": 0.25})"));
  price.status = optimizer::Status::kCancelled;
  price.objective.reset();
  EXPECT_EQ(RenderPrice(price, 2.0), Parse(R"({"requirement": "/duty/actuations",
      "required": 1000.0, "loosened": 900.0, "status": "cancelled", "objective": null,
      "lower_bound": null, "saving": null, "saving_share": null})"));
}

TEST(RenderFlip, NamesPartsAndRequirements) {
  optimizer::Flip flip;
  flip.rank = 2;
  flip.objective_gap = 0.1;
  flip.parts = {{optimizer::Family::kBattery, "pack", 0.2, true}};
  flip.requirements = {{"/duty/actuations", 1000.0, 1100.0, false}};
  EXPECT_EQ(RenderFlip(flip), Parse(R"({"objective_gap": 0.1,
      "parts": [{"family": "battery", "id": "pack", "reduction_share": 0.2, "confirmed": true}],
      "requirements": [{"requirement": "/duty/actuations", "required": 1000.0,
                        "tightened": 1100.0, "confirmed": false}],
      "complete": false})"));
}

// A whole answer: everything that was asked for at once.
TEST(AnswerRequest, ExplainsAndDrawsWhatIsAskedFor) {
  Json requirements = Requirements();
  requirements["supply"]["configurations"] = {"mains"};
  requirements["supply"]["mains"]["pressure_kpa_gauge"] = 800;
  for (const char* limit : {"rise_time_s_max", "fall_time_s_max"})
    requirements["actuators"][0][limit] = 4.0;
  requirements["explain"] = Parse(R"({"prices": true, "ranks": 2})");
  requirements["robust"] = Parse(R"({"draws": 5})");
  const auto rows = SmallCatalogue();
  auto parsed = ParseRequirements(requirements, rows);
  const DesignRequest& request = std::get<DesignRequest>(parsed);
  const Json answer = AnswerRequest(request, {}, rows);
  ASSERT_FALSE(answer["designs"].empty()) << answer.dump();
  EXPECT_EQ(answer["robust"]["draws"], 5);
  EXPECT_FALSE(answer["prices"].empty());
  const double probability = answer["designs"][0]["robustness"]["probability"];
  EXPECT_GE(probability, 0.0);
  EXPECT_LE(probability, 1.0);
  EXPECT_FALSE(answer["designs"][0].contains("to_be_first"));
  if (answer["designs"].size() > 1) {
    EXPECT_TRUE(answer["designs"][1].contains("to_be_first"));
  }
  // Same request, same draws.
  EXPECT_EQ(AnswerRequest(request, {}, rows)["designs"][0]["robustness"],
            answer["designs"][0]["robustness"]);
}

}  // namespace explanation_test
}  // namespace plenum::api
