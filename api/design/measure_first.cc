#include "api/design/measure_first.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "api/json/json.h"
#include "api/protocol/protocols.h"
#include "optimizer/search/tree_search.h"

namespace plenum::api {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kDesignsOnPaper = 3;  // whose parts are looked at
constexpr std::size_t kTold = 3;
constexpr double kNothing = 1e-6;  // share of the objective that is no saving

// A test of one part, with the numbers that it would settle.
struct Test {
  const catalog::Part* part;
  std::string protocol;
  std::vector<std::string> numbers;
  double width = 0.0;  // half-width of the least certain of them
};

struct Saving {
  std::vector<const Test*> tests;
  double least = 0.0, most = 0.0;  // equal where the search was proved
};

// Tests of the parts of these designs that would settle anything, the least certain first.
std::vector<Test> TestsOf(const std::vector<const optimizer::Design*>& designs,
                          const std::vector<catalog::Part>& rows, const Tolerance& tolerance) {
  std::map<std::string, const catalog::Part*> by_id;
  for (const catalog::Part& row : rows) by_id[row.id] = &row;
  std::vector<Test> tests;
  std::set<std::string> seen;
  for (const optimizer::Design* design : designs)
    for (const optimizer::Choice& choice : design->parts) {
      const auto row = by_id.find(choice.id);
      if (row == by_id.end() || !seen.insert(choice.id).second) continue;
      for (const Protocol& protocol : Protocols()) {
        if (protocol.family != row->second->family) continue;
        Test test{row->second, std::string(protocol.name), {}};
        for (const std::string_view number : protocol.numbers) {
          const double width = HalfWidth(*row->second, number, tolerance);
          if (width > 0.0) test.numbers.emplace_back(number);
          test.width = std::max(test.width, width);
        }
        if (!test.numbers.empty()) tests.push_back(std::move(test));
      }
    }
  std::stable_sort(tests.begin(), tests.end(),
                   [](const Test& a, const Test& b) { return a.width > b.width; });
  return tests;
}

// Searches for the best guaranteed design with some numbers settled.
class Retrial {
 public:
  Retrial(const DesignRequest& request, const std::vector<catalog::Part>& rows, double objective,
          const optimizer::SearchOptions& options)
      : request_(request), rows_(rows), objective_(objective), options_(options) {
    problem_ = request.problem;
    problem_.count = 1;
    problem_.list = optimizer::ListOf::kCombinations;
    options_.record = false;
    options_.progress = nullptr;
    options_.select = nullptr;
  }

  bool OutOfTime() const {
    return SecondsLeft() <= 0.0 || (options_.cancelled && options_.cancelled());
  }

  Saving With(std::vector<const Test*> tests) const {
    const Settled settled = [&tests](const catalog::Part& row, std::string_view field) {
      return std::any_of(tests.begin(), tests.end(), [&](const Test* test) {
        return test->part->id == row.id &&
               std::find(test->numbers.begin(), test->numbers.end(), field) != test->numbers.end();
      });
    };
    optimizer::SearchOptions options = options_;
    options.time_limit_s = SecondsLeft();
    options.objective_max = objective_;
    const optimizer::Answer answer = optimizer::SearchTrees(
        GuaranteedProblem(problem_, *request_.guarantee, rows_, settled), options);
    Saving saving{std::move(tests)};
    // The best design of today is still guaranteed, so that nothing else found means no saving.
    if (!answer.designs.empty())
      saving.least = std::max(0.0, objective_ - answer.designs.front().objective);
    saving.most = std::max(saving.least, objective_ - answer.proof.lower_bound);
    const bool proved = answer.status == optimizer::Status::kOptimal ||
                        answer.status == optimizer::Status::kInfeasible;
    if (proved) saving.most = saving.least;
    return saving;
  }

  // Those that save, most first.
  std::vector<Saving> Told(std::vector<Saving> savings) const {
    std::erase_if(savings,
                  [&](const Saving& saving) { return !(saving.least > kNothing * objective_); });
    std::stable_sort(savings.begin(), savings.end(),
                     [](const Saving& a, const Saving& b) { return a.least > b.least; });
    if (savings.size() > kTold) savings.resize(kTold);
    return savings;
  }

 private:
  double SecondsLeft() const {
    return options_.time_limit_s - std::chrono::duration<double>(Clock::now() - start_).count();
  }

  const DesignRequest& request_;
  const std::vector<catalog::Part>& rows_;
  double objective_;
  optimizer::SearchOptions options_;
  optimizer::Problem problem_;
  Clock::time_point start_ = Clock::now();
};

Json RenderTest(const Test& test) {
  return {{"part", test.part->id},
          {"family", test.part->family},
          {"protocol", test.protocol},
          {"numbers", test.numbers}};
}

Json RenderSaving(const Saving& saving, double objective) {
  Json json = RenderTest(*saving.tests.front());
  const bool proved = saving.least == saving.most;
  json["saving"] = proved ? Number(saving.least) : Json(nullptr);
  json["saving_share"] = proved ? Number(saving.least / objective) : Json(nullptr);
  if (!proved) json["saving_interval"] = {Number(saving.least), Number(saving.most)};
  if (saving.tests.size() > 1) json["with"] = RenderTest(*saving.tests.back());
  return json;
}

}  // namespace

void AddMeasureFirst(const DesignRequest& request, const optimizer::Answer& guaranteed,
                     const optimizer::Answer& on_paper, const optimizer::SearchOptions& options,
                     const std::vector<catalog::Part>& rows, Json& document) {
  document["measure_first"] = Json::array();
  document["measure_first_complete"] = !guaranteed.designs.empty();
  if (guaranteed.designs.empty()) return;
  const double objective = guaranteed.designs.front().objective;
  std::vector<const optimizer::Design*> designs{&guaranteed.designs.front()};
  for (const optimizer::Design& design : on_paper.designs)
    if (design.objective < objective && designs.size() <= kDesignsOnPaper)
      designs.push_back(&design);
  const std::vector<Test> tests = TestsOf(designs, rows, request.guarantee->tolerance);
  const Retrial retrial(request, rows, objective, options);
  std::vector<Saving> savings;
  bool complete = true;
  const auto look = [&](std::vector<const Test*> at) {
    complete = complete && !retrial.OutOfTime();
    if (complete) savings.push_back(retrial.With(std::move(at)));
  };
  for (const Test& test : tests) look({&test});
  savings = retrial.Told(std::move(savings));
  if (savings.empty()) {
    for (std::size_t i = 0; i < tests.size(); ++i)
      for (std::size_t j = i + 1; j < tests.size(); ++j) look({&tests[i], &tests[j]});
    savings = retrial.Told(std::move(savings));
  }
  for (const Saving& saving : savings)
    document["measure_first"].push_back(RenderSaving(saving, objective));
  document["measure_first_complete"] = complete;
}

}  // namespace plenum::api
