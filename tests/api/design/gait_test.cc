// Gaits, from the request to the checked answer.
#include "optimizer/problem/gait.h"

#include <gtest/gtest.h>

#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace gait_test {

// Four legs that walk: each bends in its own quarter of the period.
Json Asked() {
  Json request = Example("gripper");
  Json leg = request["actuators"][0];
  leg["name"] = "legs";
  leg["count"] = 4;
  leg["phase"] = {0, 0.25, 0.5, 0.75};
  leg["inflate_fraction"] = 0.25;
  request["actuators"] = Json::array({leg});
  request["duty"] = {{"frequency_hz", 0.2}, {"actuations", 200}};
  request["ranking"] = {{"count", 2}, {"proof", true}};
  return request;
}

TEST(GaitRequestTest, IsDesignedAndVerified) {
  const Json answer = Answered(Asked());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    const Json& groups = design["response"]["groups"];
    ASSERT_EQ(groups.size(), 4U);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      EXPECT_EQ(groups[i]["name"], "legs");
      EXPECT_EQ(groups[i]["count"], 1);
      EXPECT_DOUBLE_EQ(groups[i]["phase"].get<double>(), 0.25 * static_cast<double>(i));
      // A cycle that repeats: the last leg begins full, and is emptied first.
      const Json& pressures = groups[i]["pressure_kpa_gauge"];
      EXPECT_NEAR(pressures.front().get<double>(), pressures.back().get<double>(), 0.5) << i;
    }
    EXPECT_EQ(design["performance"]["groups"].size(), 1U);
  }
}

TEST(GaitRequestTest, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"another gait", "strokes",
       [](Json& a) { a["requirements"]["actuators"][0]["inflate_fraction"] = 0.02; }},
      {"faster", "strokes", [](Json& a) {
         Json& group = a["designs"][0]["performance"]["groups"][0];
         group["inflate_time_s"] = 0.9 * group["inflate_time_s"].get<double>();
       }}};
  ExpectRefused(Answered(Asked()), kTamperings);
}

TEST(GaitRequestTest, NamesWhatIsWrong) {
  EXPECT_EQ(Pointers(Asked()), "");
  const auto with = [](const char* field, const Json& value) {
    Json request = Asked();
    request["actuators"][0][field] = value;
    return Pointers(request);
  };
  EXPECT_EQ(with("phase", 0.3), "");
  EXPECT_EQ(with("phase", 1), "");
  EXPECT_EQ(with("phase", 1.2), "/actuators/0/phase ");
  EXPECT_EQ(with("phase", "late"), "/actuators/0/phase ");
  EXPECT_EQ(with("phase", Json::array({0.0, 0.5})), "/actuators/0/phase ");
  EXPECT_EQ(with("phase", Json::array({0.0, 0.5, -0.1, 0.2})), "/actuators/0/phase/2 ");
  EXPECT_EQ(with("phase", Json::array()), "/actuators/0/phase ");
  EXPECT_EQ(with("inflate_fraction", 0.0), "/actuators/0/inflate_fraction ");
  EXPECT_EQ(with("inflate_fraction", 1.0), "/actuators/0/inflate_fraction ");
  EXPECT_EQ(with("strokes_per_period", 0), "/actuators/0/strokes_per_period ");
  EXPECT_EQ(with("strokes_per_period", 1.5), "/actuators/0/strokes_per_period ");
}

// Pumps alone fill one after another; what is not there yet is refused by name.
TEST(GaitRequestTest, NamesWhatDoesNotGoTogether) {
  Json request = Asked();
  request["supply"] = {{"configurations", {"direct_pump"}}};
  EXPECT_EQ(Pointers(request), "");
  request["actuators"][0]["phase"] = {0, 0.25, 0.5, 0.5};  // two at once are one to the pumps
  EXPECT_EQ(Pointers(request), "");
  request["actuators"].push_back(request["actuators"][0]);
  request["actuators"][1]["name"] = "tail";
  request["actuators"][1]["phase"] = 0.5;
  EXPECT_EQ(Pointers(request), "/actuators ");
  request = Asked();
  request["ranking"] = {{"count", 1}};
  request["guarantee"] = true;
  EXPECT_EQ(Pointers(request), "/guarantee ");
}

TEST(GaitRequestTest, AWarningWhereAPhaseWins) {
  const auto warnings = [](const Json& request) {
    const auto parsed = ParseRequirements(request, Project().parts);
    return std::get<DesignRequest>(parsed).remarks.warnings;
  };
  Json request = Asked();
  EXPECT_TRUE(warnings(request).empty());
  request["duty"]["simultaneous"] = true;
  ASSERT_EQ(warnings(request).size(), 1U);
  EXPECT_EQ(warnings(request)[0]["pointer"], "/duty/simultaneous");
  request["actuators"][0].erase("phase");
  EXPECT_TRUE(warnings(request).empty());
}

// Without the words a request is as it was; phase 1 is the next period's 0.
TEST(GaitRequestTest, Defaults) {
  Json request = Asked();
  request["actuators"][0]["phase"] = 1;
  request["actuators"][0].erase("inflate_fraction");
  const auto parsed = ParseRequirements(request, Project().parts);
  const optimizer::Problem& problem = std::get<DesignRequest>(parsed).problem;
  EXPECT_EQ(problem.groups[0].gait.phases, std::vector<double>{0.0});
  EXPECT_EQ(problem.groups[0].gait.inflate_fraction, 0.5);
  EXPECT_EQ(problem.groups[0].gait.strokes_per_period, 1);
  EXPECT_EQ(optimizer::MeetingOf(problem), optimizer::Meeting::kAlone);
}

}  // namespace gait_test
}  // namespace plenum::api
