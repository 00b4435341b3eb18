// Answers of the search are accepted; each of many ways to tamper with them is refused, and by the
// check that is meant to see it.
#include "api/design/verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "api/json/version.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"
#include "tests/support/in_full.h"

namespace plenum::api {
namespace verification_test {

Json Listed(const std::string& example, int count) {
  Json request = Example(example);
  request["ranking"] = {{"count", count}, {"time_limit_s", 300}, {"proof", true}};
  return Answered(request);
}

const Json& Exosuit() {
  static const Json answer = Listed("exosuit", 4);
  return answer;
}

void Scale(Json& number, double factor) { number = number.get<double>() * factor; }

Json& Boxes(Json& answer, std::size_t plan = 0) {
  return answer["proof"]["record"]["plans"][plan]["boxes"];
}

// The first box of a kind in any plan.
Json& BoxOf(Json& answer, int kind) {
  for (Json& plan : answer["proof"]["record"]["plans"])
    for (Json& box : plan["boxes"])
      if (box[0] == kind) return box;
  throw std::out_of_range("no such box");
}

// Takes the first design off the list and closes its box in another way, with everything that is
// counted put right.
void Withhold(Json& answer, const Json& end) {
  answer["designs"].erase(0);
  for (std::size_t i = 0; i < answer["designs"].size(); ++i) answer["designs"][i]["rank"] = i + 1;
  answer["requirements"]["ranking"]["count"] = answer["designs"].size();
  answer["proof"]["record"]["count"] = answer["designs"].size();
  for (Json& plan : answer["proof"]["record"]["plans"])
    for (Json& box : plan["boxes"])
      if (box[0] == 4) {
        if (box[1] == 0)
          box = end;
        else
          box[1] = box[1].get<int>() - 1;
      }
  if (end[0] == 6) return;
  Json& proof = answer["proof"];
  Json& count = proof["pruned"][end[0] == 1 ? "infeasible" : "bound"];
  count = (*optimizer::BigCount::FromDecimal(count.get<std::string>()) + 1).str();
  proof["evaluated"] = proof["evaluated"].get<int>() - 1;
}

TEST(Verify, AcceptsTheAnswersOfTheSearch) {
  EXPECT_EQ(Refusals(Exosuit()), "");
  const Json verified = Verified(Exosuit());
  EXPECT_EQ(verified["schema"], "verification/1");
  EXPECT_EQ(verified["plenum"], Version());
  EXPECT_EQ(verified["accepted"], true);
  EXPECT_EQ(verified["not_rechecked"], Json::array());
  const Json gripper = Listed("gripper", 3);
  EXPECT_EQ(Refusals(gripper), "");
  EXPECT_EQ(Verified(gripper)["not_rechecked"], Json::array());
}

TEST(Verify, AcceptsAnAnswerSavedBeforeAnswersCarriedTheVersion) {
  Json answer = Exosuit();
  ASSERT_EQ(answer.erase("plenum"), 1u);
  EXPECT_EQ(Refusals(answer), "");
}

TEST(Verify, APumpsDesignStatesItsReservoir) {
  Json answer = Exosuit();
  std::size_t pumped = 0;
  while (answer["designs"].at(pumped)["configuration"] != "compressor") ++pumped;
  const std::string field = "/designs/" + std::to_string(pumped) + "/settings/reservoir_volume_ml";
  EXPECT_THAT(Refusals(Without(answer, field)),
              testing::HasSubstr("reservoir_volume_ml: is missing"));
}

TEST(Verify, EnumeratesEveryCombinationWhereThatEnds) {
  const Json gripper = Listed("gripper", 5);
  double shown = 0.0;
  const BruteForce all{verify::kBruteForceMax, [&](double share) { shown = share; }};
  const Json verified =
      std::get<Json>(VerifyAnswer(gripper, Project().parts, Project().revision, all));
  EXPECT_EQ(verified["accepted"], true);
  EXPECT_EQ(verified["brute_force"]["combinations"], gripper["proof"]["combinations"]);
  EXPECT_EQ(verified["brute_force"]["undecided"], "0");
  EXPECT_GT(shown, 0.0);

  Json withheld = gripper;
  withheld["proof"].erase("record");
  withheld["designs"].erase(1);
  for (std::size_t i = 0; i < 4; ++i) withheld["designs"][i]["rank"] = i + 1;
  withheld["requirements"]["ranking"]["count"] = 4;
  const Json refused =
      std::get<Json>(VerifyAnswer(withheld, Project().parts, Project().revision, all));
  EXPECT_EQ(refused["accepted"], false);
  for (const Json& check : refused["checks"])
    EXPECT_TRUE(check["check"] != "brute_force" || !check["ok"].get<bool>());

  const Json cancelled = std::get<Json>(VerifyAnswer(gripper, Project().parts, Project().revision,
                                                     BruteForce{}, [] { return true; }));
  EXPECT_EQ(cancelled["brute_force"]["cancelled"], true);
  EXPECT_EQ(cancelled["accepted"], false);
}

TEST(Verify, StoppedAtAnyTimeItFindsNothingWrongAndAcceptsNothing) {
  const Json crawler = Listed("crawler", 1);  // groups that meet on the source are simulated
  for (const Json* answer : {&Exosuit(), &crawler})
    for (const int looks : {0, 1, 5, 21, 85, 341}) {
      SCOPED_TRACE(looks);
      const Json verified = VerifiedWithin(*answer, looks);
      EXPECT_EQ(verified["stopped"], true);
      EXPECT_EQ(verified["accepted"], false);
      EXPECT_EQ(RefusalsIn(verified), "");
      EXPECT_FALSE(verified["not_rechecked"].empty());
    }
  EXPECT_EQ(Verified(Exosuit())["stopped"], false);
}

TEST(Verify, StoppedAtOnceItStillFindsWhatTakesNoTime) {
  Json answer = Exosuit();
  Scale(answer["designs"][0]["totals"]["mass_kg"], 1.01);
  EXPECT_THAT(RefusalsIn(VerifiedWithin(answer, 0)), testing::HasSubstr("amounts: "));
}

TEST(Verify, RefusesToEnumerateMoreThanTheLimit) {
  const auto errors = [](const Json& answer, long long most) {
    return ErrorsOf(
        VerifyAnswer(answer, Project().parts, Project().revision, BruteForce{most, {}}));
  };
  const std::string detail =
      DetailAt(errors(Exosuit(), verify::kBruteForceMax), "/proof/combinations");
  EXPECT_NE(detail.find(Exosuit()["proof"]["combinations"].get<std::string>()), std::string::npos);
  EXPECT_NE(detail.find("--combinations-max"), std::string::npos);
  const Json gripper = Listed("gripper", 3);
  EXPECT_NE(DetailAt(errors(gripper, 1000), "/proof/combinations"), "");
}

TEST(Verify, SaysWhatItDidNotRecheckWithoutARecord) {
  Json answer = Exosuit();
  answer["proof"].erase("record");
  const Json verified = Verified(answer);
  EXPECT_EQ(verified["accepted"], true);
  ASSERT_EQ(verified["not_rechecked"].size(), 1u);
  const optimizer::BigCount others =
      *optimizer::BigCount::FromDecimal(answer["proof"]["combinations"].get<std::string>()) -
      answer["designs"].size();
  EXPECT_EQ(verified["not_rechecked"][0]["combinations"], others.str());
}

// The gripper, a little faster, with room for valves that close late.
Json FrontOf(const Json& amounts, double limit_kpa = 70) {
  Json request = Example("gripper");
  for (Json& group : request["actuators"]) {
    for (const char* limit : {"rise_time_s_max", "fall_time_s_max"}) Scale(group[limit], 0.9);
    group["pressure_kpa_gauge_max"] = limit_kpa;
  }
  request["objective"] = {{"pareto", amounts}};
  return Answered(request);
}

// Three points.
const Json& WholeFront() {
  static const Json answer = FrontOf({"mass_kg", "volume_l"}, 100);
  return answer;
}

void Number(Json& answer) {
  for (const char* list : {"designs", "front"})
    for (std::size_t i = 0; i < answer[list].size(); ++i) answer[list][i]["rank"] = i + 1;
}

// The front without a point, and nothing else to be seen of it.
Json WithoutPoint(Json answer, std::size_t index) {
  for (const char* list : {"designs", "front"}) answer[list].erase(index);
  Number(answer);
  return answer;
}

TEST(Verify, AcceptsAFront) {
  ASSERT_GE(WholeFront()["front"].size(), 3u);
  EXPECT_EQ(Refusals(WholeFront()), "");
  EXPECT_EQ(Verified(WholeFront())["not_rechecked"], Json::array());
}

TEST(Verify, FindsThePointThatAFrontLacks) {
  for (std::size_t i = 0; i < WholeFront()["front"].size(); ++i)
    EXPECT_NE(Refusals(WithoutPoint(WholeFront(), i)).find("rechecked: a "), std::string::npos)
        << i;
}

TEST(Verify, LooksAtFrontsInThreeAmountsAndInEnergy) {
  for (const Json& amounts :
       {Json{"volume_l", "energy_wh"}, Json{"volume_l", "cost_eur", "mass_kg"},
        Json{"mass_kg", "volume_l", "energy_wh"}}) {
    const Json front = FrontOf(amounts);
    ASSERT_GE(front["front"].size(), 2u) << amounts;
    EXPECT_EQ(Refusals(front), "") << amounts;
    EXPECT_EQ(Verified(front)["not_rechecked"], Json::array()) << amounts;
    const std::size_t step = test::InFull() ? 1 : std::max(front["front"].size() / 3, 1ul);
    for (std::size_t i = 0; i < front["front"].size(); i += step)
      EXPECT_NE(Refusals(WithoutPoint(front, i)).find("rechecked: a "), std::string::npos)
          << amounts << i;
  }
}

TEST(Verify, RefusesAFrontThatWasTamperedWith) {
  const Json& good = WholeFront();
  const auto refused = [](const Json& answer, const std::string& check) {
    const std::string refusals = Refusals(answer);
    EXPECT_NE(refusals.find(check + ": "), std::string::npos) << check << "\n" << refusals;
  };
  Json bad = good;
  Scale(bad["front"][1]["objectives"]["mass_kg"], 0.99);
  refused(bad, "form");
  Scale(bad["designs"][1]["totals"]["mass_kg"], 0.99);
  refused(bad, "amounts");
  refused(With(good, "/front/0/rank", 2), "form");
  refused(With(good, "/front/0/objectives/volume_l", nullptr), "form");
  refused(With(good, "/requirements/objective/pareto", Json::array({"mass_kg", "energy_wh"})),
          "form");
  refused(With(good, "/front_proof/resolution", 0.5), "front");
  refused(With(good, "/front_proof/proved", 1), "status");
  refused(With(good, "/front_proof/unexplored", Json::array({Json::object()})), "status");
  refused(With(good, "/front_proof/complete", false), "form");
  refused(With(good, "/status", "feasible"), "status");
  refused(With(good, "/proof/combinations", "12345"), "combinations");
  refused(With(good, "/requirements/actuators/0/rise_time_s_max", 0.01), "supply");
  bad = good;
  std::swap(bad["designs"][0], bad["designs"][1]);
  std::swap(bad["front"][0], bad["front"][1]);
  Number(bad);
  refused(bad, "order");
  bad = good;
  bad["designs"][1] = bad["designs"][0];
  bad["front"][1] = bad["front"][0];
  Number(bad);
  refused(bad, "front");
}

TEST(Verify, RefusesWhatIsNoAnswerOfOneList) {
  const auto errors = [](const Json& json) {
    return ErrorsOf(VerifyAnswer(json, Project().parts, Project().revision));
  };
  EXPECT_NE(DetailAt(errors(Parse("{}")), "/schema"), "");
  EXPECT_NE(DetailAt(errors(Without(Exosuit(), "/requirements")), "/requirements"), "");
  EXPECT_NE(DetailAt(errors(With(Exosuit(), "/front", Json::object())), "/front"), "");
  EXPECT_NE(DetailAt(errors(With(Exosuit(), "/requirements/duty/frequency_hz", -1)),
                     "/requirements/duty/frequency_hz"),
            "");
}

TEST(Verify, RefusesTampering) {
  const std::vector<Tampering> all{
      {"ranks swapped", "order",
       [](Json& a) {
         std::swap(a["designs"][0], a["designs"][3]);
         std::swap(a["designs"][0]["rank"], a["designs"][3]["rank"]);
       }},
      {"rank renumbered", "form", [](Json& a) { a["designs"][1]["rank"] = 1; }},
      {"mass of a row", "amounts",
       [](Json& a) { Scale(a["designs"][0]["parts"][0]["mass_kg"], 0.9); }},
      {"mass of the totals and objective", "amounts",
       [](Json& a) {
         Scale(a["designs"][0]["totals"]["mass_kg"], 0.99);
         Scale(a["designs"][0]["objective"], 0.99);
       }},
      {"objective alone", "amounts", [](Json& a) { Scale(a["designs"][2]["objective"], 1.00001); }},
      {"part replaced", "parts",
       [](Json& a) { a["designs"][0]["parts"][0]["id"] = a["designs"][0]["parts"][1]["id"]; }},
      {"one piece less", "parts", [](Json& a) { a["designs"][0]["parts"][1]["quantity"] = 11; }},
      {"part left out", "parts", [](Json& a) { a["designs"][0]["parts"].erase(3); }},
      {"rise time", "strokes",
       [](Json& a) { Scale(a["designs"][0]["performance"]["groups"][0]["rise_time_s"], 0.99); }},
      {"energy", "strokes", [](Json& a) { Scale(a["designs"][0]["totals"]["energy_wh"], 0.98); }},
      {"source pressure", "strokes",
       [](Json& a) { Scale(a["designs"][0]["settings"]["source_pressure_kpa_gauge"], 1.1); }},
      {"margin", "margins",
       [](Json& a) { Scale(a["designs"][0]["margins"][0]["relative_margin"], 1.01); }},
      {"achieved and its margin", "margins",
       [](Json& a) {
         Json& margin = a["designs"][0]["margins"][0];
         margin["achieved"] = 0.9 * margin["achieved"].get<double>();
         margin["relative_margin"] =
             1.0 - margin["achieved"].get<double>() / margin["required"].get<double>();
       }},
      {"margin left out", "margins", [](Json& a) { a["designs"][0]["margins"].erase(1); }},
      {"tighter requirement", "supply",
       [](Json& a) { a["requirements"]["actuators"][0]["rise_time_s_max"] = 0.05; }},
      {"last design removed", "designs_in_tree", [](Json& a) { a["designs"].erase(3); }},
      {"bound below the list", "bound", [](Json& a) { BoxOf(a, 2)[1] = 0.1; }},
      {"box removed", "boxes", [](Json& a) { Boxes(a).erase(Boxes(a).size() - 1); }},
      {"box added", "boxes", [](Json& a) { Boxes(a).push_back({6}); }},
      {"split moved", "boxes", [](Json& a) { BoxOf(a, 0)[2] = 0; }},
      {"design's box refuted", "designs_in_tree", [](Json& a) { BoxOf(a, 4) = Json::array({6}); }},
      {"incompatible box that is not", "infeasible",
       [](Json& a) {
         BoxOf(a, 2) = Json::array({1, 1});
       }},
      // Only looking at the boxes again shows these three.
      {"design withheld", "rechecked",
       [](Json& a) {
         Withhold(a, Json::array({1, 7}));
       }},
      {"design refuted", "rechecked", [](Json& a) { Withhold(a, Json::array({6})); }},
      {"design said to be heavier", "rechecked",
       [](Json& a) {
         Withhold(a, {2, a["designs"].back()["objective"]});
       }},
      {"kind of a count", "counts",
       [](Json& a) {
         Json& pruned = a["proof"]["pruned"];
         std::swap(pruned["bound"], pruned["infeasible"]);
       }},
      {"one more evaluated", "combinations",
       [](Json& a) { a["proof"]["evaluated"] = a["proof"]["evaluated"].get<int>() + 1; }},
      {"combinations", "combinations", [](Json& a) { a["proof"]["combinations"] = "12345"; }},
      {"catalogue", "catalogue",
       [](Json& a) { a["catalogue_revision"]["hash"] = std::string(64, '0'); }},
      {"dominator that is none", "dominance",
       [](Json& a) {
         for (Json& slot : a["proof"]["record"]["plans"][0]["slots"])
           if (!slot["dominated"].empty()) {
             Json& dominators = slot["dominated"][0][2];
             dominators[0] = dominators[1];
             return;
           }
       }},
      {"dominator of another", "dominance",
       [](Json& a) {
         for (Json& plan : a["proof"]["record"]["plans"])
           for (Json& slot : plan["slots"])
             if (!slot["dominated"].empty()) {
               Json& dominators = slot["dominated"][0][2];
               for (std::size_t i = 0; i < dominators.size(); ++i)
                 dominators[i] = slot["choices"].size() - 1 - i;
             }
       }},
      {"choice left out", "choices",
       [](Json& a) {
         for (Json& slot : a["proof"]["record"]["plans"][0]["slots"])
           if (!slot["dominated"].empty()) {
             slot["dominated"].erase(0);
             return;
           }
       }},
      {"stopped search called optimal", "status", [](Json& a) { a["proof"]["complete"] = false; }},
      {"proof called infeasible", "status", [](Json& a) { a["status"] = "infeasible"; }},
      {"lower bound", "bound", [](Json& a) { Scale(a["proof"]["lower_bound"], 1.1); }},
      {"gap", "bound", [](Json& a) { a["proof"]["gap"] = 0.1; }},
      {"excluded part listed", "parts",
       [](Json& a) {
         a["requirements"]["exclude"] = Json::array({a["designs"][0]["parts"][0]["id"]});
         a["proof"].erase("record");
       }},
  };
  Json request = Example("exosuit");
  request["ranking"] = {{"count", 4}, {"proof", true}, {"list", "combinations"}};
  ExpectRefused(Answered(request), all);
}

}  // namespace verification_test
}  // namespace plenum::api
