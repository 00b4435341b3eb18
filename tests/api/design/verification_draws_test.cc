// Lists with draws of part numbers are accepted; each of many ways to tamper with them is refused,
// and by the check that is meant to see it.
#include <gtest/gtest.h>

#include <cmath>

#include "api/design/read/requirements_reader.h"
#include "api/design/verification.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace verification_draws_test {

Json Drawn(const std::string& example, int count, int draws) {
  Json request = Example(example);
  request["ranking"] = {{"count", count}, {"time_limit_s", 300}, {"proof", true}};
  request["robust"] = {{"draws", draws}, {"time_limit_s", 300}};
  return request;
}

Json Asked(Json request, double probability_min) {
  request["ranking"]["probability_min"] = probability_min;
  return request;
}

// Four of the best five dozen or so.
const Json& Gripper() {
  static const Json answer = Answered(Asked(Drawn("gripper", 4, 40), 0.7));
  return answer;
}

std::size_t LeftOut(const Json& answer) {
  std::size_t count = 0;
  for (const Json& design : answer["robust"]["searched"]["designs"])
    count += !design.contains("listed");
  return count;
}

TEST(VerifyDraws, AcceptsAListWithItsShares) {
  const Json answer = Answered(Drawn("gripper", 5, 40));
  EXPECT_FALSE(answer["robust"].contains("searched"));
  EXPECT_EQ(Refusals(answer), "");
  EXPECT_EQ(Verified(answer)["not_rechecked"], Json::array());
}

TEST(VerifyDraws, AcceptsAFrontWithItsShares) {
  Json request = Example("gripper");
  request["objective"] = {{"pareto", {"mass_kg", "volume_l"}}};
  request["robust"] = {{"draws", 20}};
  EXPECT_EQ(Refusals(Answered(request)), "");
}

TEST(VerifyDraws, AcceptsAListThatReachesAProbability) {
  EXPECT_EQ(Gripper()["status"], "optimal");
  EXPECT_EQ(Gripper()["designs"].size(), 4u);
  EXPECT_GT(LeftOut(Gripper()), 10u);
  EXPECT_EQ(Refusals(Gripper()), "");
  EXPECT_EQ(Verified(Gripper())["not_rechecked"], Json::array());
}

#ifndef PLENUM_SANITIZED
TEST(VerifyDraws, AcceptsDesignsWithRoomToSpareWhereNoneOfTheBestReachIt) {
  Json request = Asked(Drawn("crawler", 2, 20), 0.9);
  request["supply"]["configurations"] = {"cylinder"};
  const Json answer = Answered(request);
  EXPECT_EQ(answer["status"], "feasible");
  ASSERT_EQ(answer["designs"].size(), 2u);
  EXPECT_EQ(LeftOut(answer), 500u);
  for (const Json& design : answer["designs"])
    EXPECT_GE(design["robustness"]["probability"].get<double>(), 0.9);
  const double gap = 1.0 - answer["proof"]["lower_bound"].get<double>() /
                               answer["designs"][1]["objective"].get<double>();
  EXPECT_NEAR(answer["proof"]["gap"].get<double>(), gap, 1e-9);
  EXPECT_LT(gap, 0.1);
  EXPECT_EQ(Refusals(answer), "");
}
#endif

TEST(VerifyDraws, StoppedAtAnyTimeItFindsNothingWrongAndAcceptsNothing) {
  for (const int looks : {0, 1, 30, 100, 300, 1000}) {
    SCOPED_TRACE(looks);
    const Json stopped = VerifiedWithin(Gripper(), looks);
    EXPECT_EQ(stopped["accepted"], !stopped["stopped"].get<bool>());
    EXPECT_EQ(RefusalsIn(stopped), "");
  }
}

// A list of another catalogue, or one that was tampered with.
TEST(VerifyDraws, RefusesPartsThatAreInNoDraw) {
  Json request = Example("exosuit");
  request["robust"] = {{"draws", 3}};
  request["ranking"]["count"] = 1;
  const Json answer = Answered(request);
  const Json unsized = Without(answer, "/designs/0/settings/reservoir_volume_ml");
  for (std::size_t i = 0; i < answer["designs"][0]["parts"].size(); ++i) {
    SCOPED_TRACE(i);
    const std::string part = "/designs/0/parts/" + std::to_string(i);
    EXPECT_NE(Refusals(With(answer, part + "/id", "gone")), "");
    Json fewer = answer;
    fewer["designs"][0]["parts"].erase(i);
    EXPECT_NE(Refusals(fewer), "");
    EXPECT_NE(Refusals(With(unsized, part + "/id", "custom")), "");
  }
}

TEST(VerifyDraws, AsksForTheRecordOfAListThatReachesAProbability) {
  const auto errors = ErrorsOf(VerifyAnswer(With(Gripper(), "/requirements/ranking/proof", false),
                                            Project().parts, Project().revision));
  EXPECT_NE(DetailAt(errors, "/requirements/ranking/proof"), "");
}

// Other counts of a design, with all that follows from them.
void Recount(Json& answer, std::size_t rank, int met, int first) {
  const auto parsed =
      std::get<DesignRequest>(ParseRequirements(answer["requirements"], Project().parts));
  optimizer::RobustAnswer counts;
  counts.draws = answer["robust"]["draws"];
  counts.robustness = {{met, first}};
  Json one = {{"designs", Json::array({Json::object()})}};
  AddRobustness(*parsed.robust, counts, one);
  answer["designs"][rank]["robustness"] = one["designs"][0]["robustness"];
}
int CountOf(const Json& answer, std::size_t rank, const char* share) {
  return static_cast<int>(std::lround(answer["designs"][rank]["robustness"][share].get<double>() *
                                      answer["robust"]["draws"].get<double>()));
}

// Entry of a searched design that is not listed, the first or the one before.
std::size_t FirstLeftOut(const Json& answer) {
  const Json& designs = answer["robust"]["searched"]["designs"];
  std::size_t i = 0;
  while (designs[i].contains("listed")) ++i;
  return i;
}
std::size_t PlaceOf(const Json& answer, int listed) {
  const Json& designs = answer["robust"]["searched"]["designs"];
  std::size_t i = 0;
  while (!designs[i].contains("listed") || designs[i]["listed"] != listed) ++i;
  return i;
}

// The searched design in full instead of its place, and the list without it.
void Withhold(Json& answer, int listed) {
  Json& searched = answer["robust"]["searched"]["designs"];
  const std::size_t place = PlaceOf(answer, listed);
  Json design = answer["designs"][listed - 1];
  for (const char* field : {"data_quality", "response", "robustness"}) design.erase(field);
  design["rank"] = place + 1;
  searched[place] = design;
  answer["designs"].erase(listed - 1);
  for (std::size_t i = 0; i < answer["designs"].size(); ++i) answer["designs"][i]["rank"] = i + 1;
  for (Json& entry : searched)
    if (entry.contains("listed") && entry["listed"] > listed)
      entry["listed"] = entry["listed"].get<int>() - 1;
  answer["requirements"]["ranking"]["count"] = answer["designs"].size();
  answer["robust"]["left_out"] = answer["robust"]["left_out"].get<int>() + 1;
}

// A design that was left out takes the place of a listed one.
void Slip(Json& answer) {
  Json& searched = answer["robust"]["searched"]["designs"];
  const std::size_t place = FirstLeftOut(answer);
  Json design = searched[place];
  design["rank"] = 1;
  design["robustness"] = answer["designs"][0]["robustness"];
  answer["designs"].insert(answer["designs"].begin(), design);
  for (Json& entry : searched)
    if (entry.contains("listed")) entry["listed"] = entry["listed"].get<int>() + 1;
  searched[place] = {{"rank", place + 1}, {"listed", 1}};
  for (std::size_t i = 0; i < answer["designs"].size(); ++i) answer["designs"][i]["rank"] = i + 1;
  answer["requirements"]["ranking"]["count"] = answer["designs"].size();
  answer["robust"]["left_out"] = answer["robust"]["left_out"].get<int>() - 1;
}

TEST(VerifyDraws, RefusesTampering) {
  const std::vector<Tampering> all{
      {"one draw more is met", "draws",
       [](Json& a) {
         Recount(a, 1, CountOf(a, 1, "probability") + 1, CountOf(a, 1, "share_rank_1"));
       }},
      {"one draw less is met", "draws",
       [](Json& a) {
         Recount(a, 0, CountOf(a, 0, "probability") - 1, CountOf(a, 0, "share_rank_1"));
       }},
      {"first twice more", "draws",
       [](Json& a) {
         Recount(a, 3, CountOf(a, 3, "probability"), CountOf(a, 3, "share_rank_1") + 2);
       }},
      {"interval", "form",
       [](Json& a) { a["designs"][0]["robustness"]["probability_ci95"][0] = 0.89; }},
      {"share alone", "form", [](Json& a) { a["designs"][0]["robustness"]["probability"] = 1.0; }},
      {"draws of another seed", "draws",
       [](Json& a) {
         a["requirements"]["robust"]["seed"] = 2;
         a["robust"]["seed"] = 2;
       }},
      {"seed", "form", [](Json& a) { a["robust"]["seed"] = 2; }},
      {"tolerance", "form", [](Json& a) { a["robust"]["tolerance"]["datasheet"] = 0.01; }},
      {"more draws than were asked for", "form", [](Json& a) { a["robust"]["draws"] = 41; }},
      {"another probability", "probability",
       [](Json& a) {
         a["requirements"]["ranking"]["probability_min"] = 0.99;
         a["robust"]["probability_min"] = 0.99;
       }},
      {"left out", "probability",
       [](Json& a) { a["robust"]["left_out"] = a["robust"]["left_out"].get<int>() - 1; }},
      {"design withheld", "probability", [](Json& a) { Withhold(a, 2); }},
      {"design slipped in", "probability", [](Json& a) { Slip(a); }},
      {"mass of one left out", "amounts",
       [](Json& a) {
         Json& design = a["robust"]["searched"]["designs"][FirstLeftOut(a)];
         design["totals"]["mass_kg"] = 1.01 * design["totals"]["mass_kg"].get<double>();
       }},
      {"one left out forgotten", "form",
       [](Json& a) { a["robust"]["searched"]["designs"].erase(FirstLeftOut(a)); }},
      {"the last searched forgotten", "designs_in_tree",
       [](Json& a) {
         Json& designs = a["robust"]["searched"]["designs"];
         designs.erase(designs.size() - 1);
       }},
      {"lower bound", "probability",
       [](Json& a) {
         a["proof"]["lower_bound"] = 1.1 * a["designs"].back()["objective"].get<double>();
       }},
      {"gap", "probability", [](Json& a) { a["proof"]["gap"] = 0.1; }},
      {"called feasible with a complete proof", "probability",
       [](Json& a) { a["status"] = "feasible"; }},
      {"objective", "probability",
       [](Json& a) {
         a["designs"][0]["objective"] = 0.9 * a["designs"][0]["objective"].get<double>();
       }},
      {"box removed", "boxes",
       [](Json& a) {
         Json& boxes = a["proof"]["record"]["plans"][0]["boxes"];
         boxes.erase(boxes.size() - 1);
       }},
      {"no list of the searched", "form", [](Json& a) { a["robust"].erase("searched"); }},
      {"place of another", "form",
       [](Json& a) { a["robust"]["searched"]["designs"][PlaceOf(a, 1)]["listed"] = 9; }},
  };
  ExpectRefused(Gripper(), all);
}

}  // namespace verification_draws_test
}  // namespace plenum::api
