#include "bench/loop/engineer.h"

#include <algorithm>
#include <string>

#include "api/design/read/worst_parts.h"
#include "api/protocol/protocols.h"
#include "bench/loop/ranking.h"

namespace plenum::bench {
namespace {

using api::Json;

Json ObjectiveOf(const Json& answer) { return answer.at("guarantee").at("objective_guaranteed"); }

std::size_t RowOf(const std::vector<catalog::Part>& rows, const std::string& id) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& part) { return part.id == id; });
  return static_cast<std::size_t>(row - rows.begin());
}

void Make(Engineer& engineer, const TestName& test, const char* why, const Json& saving_share) {
  const std::size_t row = RowOf(engineer.known, test.part);
  Tested tested =
      TestPart(engineer.known[row], engineer.truth[row], test.protocol, engineer.random);
  engineer.known[row] = std::move(tested.part);
  engineer.made.insert(test);
  tested.told["why"] = why;
  tested.told["saving_share"] = saving_share;
  tested.told["objective_before"] = ObjectiveOf(engineer.answer);
  engineer.tests.push_back(std::move(tested.told));
}

void RankAgain(Engineer& engineer) {
  engineer.answer = Rank(engineer.requirements, engineer.known);
  for (Json& test : engineer.tests)
    if (!test.contains("objective")) test["objective"] = ObjectiveOf(engineer.answer);
}

int TestsLeft(const Engineer& engineer, const Habits& habits) {
  return habits.tests_most - static_cast<int>(engineer.tests.size());
}

struct Named {
  std::vector<TestName> tests;
  double saving_share = 0.0;
  double PerTest() const { return saving_share / static_cast<double>(tests.size()); }
};

TestName NameOf(const Json& test) { return {test.at("part"), test.at("protocol")}; }

// What the answer names: the tests of an item of measure_first, those of one of measure_together.
std::vector<Named> NamedIn(const Json& answer) {
  std::vector<Named> named;
  for (const Json& item : answer.at("measure_first")) {
    const double share =
        item.at("saving_share").is_number()
            ? item.at("saving_share").get<double>()
            : item.at("saving_interval")[0].get<double>() / ObjectiveOf(answer).get<double>();
    named.push_back({{NameOf(item)}, share});
    if (item.contains("with")) named.back().tests.push_back(NameOf(item.at("with")));
  }
  for (const Json& item : answer.at("measure_together")) {
    named.push_back({{}, item.at("saving_share").get<double>()});
    for (const Json& test : item.at("tests")) named.back().tests.push_back(NameOf(test));
  }
  return named;
}

// The most saving for each test that has to be made, of those that the engineer can still make.
Named NextOf(const Engineer& engineer, const Habits& habits) {
  Named next;
  for (Named& named : NamedIn(engineer.answer)) {
    std::erase_if(named.tests, [&](const TestName& test) { return engineer.made.contains(test); });
    const bool possible = !named.tests.empty() && named.saving_share >= habits.saving_least &&
                          static_cast<int>(named.tests.size()) <= TestsLeft(engineer, habits);
    if (possible && (next.tests.empty() || named.PerTest() > next.PerTest()))
      next = std::move(named);
  }
  return next;
}

// Tests of a design's parts that would settle anything, those made left out; of estimates only.
std::vector<TestName> TestsOf(const Engineer& engineer, const Json& design, bool estimates_only) {
  std::vector<TestName> tests;
  if (design.is_null()) return tests;
  for (const Json& listed : design.at("parts")) {
    const std::size_t row = RowOf(engineer.known, listed.at("id"));
    if (row == engineer.known.size()) continue;  // made to measure
    const catalog::Part& part = engineer.known[row];
    const auto told = [&](std::string_view field) {
      if (!(api::HalfWidth(part, field, api::Tolerance()) > 0.0)) return false;
      if (!estimates_only) return true;
      const auto number = part.numbers.find(std::string(field));
      if (number != part.numbers.end())
        return number->second.provenance == catalog::Provenance::kEstimated;
      return part.curve && (field == "free_air" ? part.curve->free_air_provenance
                                                : part.curve->current_provenance) ==
                               catalog::Provenance::kEstimated;
    };
    for (const api::Protocol& protocol : api::Protocols()) {
      const TestName test{part.id, std::string(protocol.name)};
      if (protocol.family == part.family && !engineer.made.contains(test) &&
          std::find(tests.begin(), tests.end(), test) == tests.end() &&
          std::any_of(protocol.numbers.begin(), protocol.numbers.end(), told))
        tests.push_back(test);
    }
  }
  return tests;
}

}  // namespace

void FollowLoop(Engineer& engineer, const Habits& habits) {
  while (true) {
    const Named next = NextOf(engineer, habits);
    if (next.tests.empty()) return;
    Make(engineer, next.tests.front(), "saves", next.saving_share);
    RankAgain(engineer);
  }
}

void Confirm(Engineer& engineer, const Habits& habits) {
  while (TestsLeft(engineer, habits) > 0) {
    const std::vector<TestName> open = TestsOf(engineer, FirstOf(engineer.answer), true);
    if (open.empty()) return;
    Make(engineer, open.front(), "confirms", nullptr);
    RankAgain(engineer);
  }
}

void TestAtRandom(Engineer& engineer, int count) {
  std::vector<TestName> tests = TestsOf(engineer, FirstOf(engineer.answer), false);
  for (const Json& design : engineer.answer.at("on_paper").at("designs"))
    for (const TestName& test : TestsOf(engineer, design, false))
      if (std::find(tests.begin(), tests.end(), test) == tests.end()) tests.push_back(test);
  for (; count > 0 && !tests.empty(); --count) {
    const TestName test = engineer.random.Pick(tests);
    std::erase(tests, test);
    Make(engineer, test, "random", nullptr);
  }
  RankAgain(engineer);
}

}  // namespace plenum::bench
