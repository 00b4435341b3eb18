#include "api/design/savings/measure_together.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "api/design/savings/part_tests.h"
#include "api/json/json.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

using Tests = std::vector<const PartTest*>;
using Stop = std::function<bool()>;

// A design on paper, whether some tests make it a guaranteed one.
class Candidate {
 public:
  Candidate(const DesignRequest& request, const optimizer::Design& design,
            const std::vector<catalog::Part>& rows, const Stop& stop)
      : request_(request), design_(design), stop_(stop) {
    for (const catalog::Part& row : rows)
      if (std::any_of(design.parts.begin(), design.parts.end(),
                      [&](const optimizer::Choice& choice) { return choice.id == row.id; }))
        rows_.push_back(row);
    tests_ = TestsOf({&design}, rows_, request.guarantee->tolerance);
  }

  // The least certain tests are kept longest.
  std::optional<Tests> Needed() const {
    Tests needed;
    for (const PartTest& test : tests_) needed.push_back(&test);
    if (!ObjectiveWith(needed)) return {};
    for (auto test = tests_.rbegin(); test != tests_.rend(); ++test) {
      Tests fewer = needed;
      std::erase(fewer, &*test);
      if (ObjectiveWith(fewer)) needed = std::move(fewer);
    }
    return needed;
  }

  // None where the design is not guaranteed with the numbers of these tests exact.
  std::optional<double> ObjectiveWith(const Tests& tests) const {
    const optimizer::Leaf leaf = optimizer::Resize(
        GuaranteedProblem(request_.problem, *request_.guarantee, rows_, SettledBy(tests)), design_,
        stop_);
    if (leaf.status != optimizer::LeafStatus::kFeasible) return {};
    return leaf.objective;
  }

 private:
  const DesignRequest& request_;
  const optimizer::Design& design_;
  const Stop& stop_;
  std::vector<catalog::Part> rows_;  // of the design
  std::vector<PartTest> tests_;
};

Json Render(int rank, const Tests& tests, double objective, double guaranteed) {
  Json json = {{"rank", rank},
               {"tests", Json::array()},
               {"objective", Number(objective)},
               {"saving", Number(guaranteed - objective)},
               {"saving_share", Number(1.0 - objective / guaranteed)}};
  for (const PartTest* test : tests) json["tests"].push_back(RenderTest(*test));
  return json;
}

}  // namespace

void AddMeasureTogether(const DesignRequest& request, const optimizer::Answer& guaranteed,
                        const optimizer::Answer& on_paper, const optimizer::SearchOptions& options,
                        const std::vector<catalog::Part>& rows, Json& document) {
  document["measure_together"] = Json::array();
  if (guaranteed.designs.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  const Stop stop = [&] {
    const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
    return used.count() > options.time_limit_s || (options.cancelled && options.cancelled());
  };
  const double objective = guaranteed.designs.front().objective;
  std::map<std::size_t, Json> by_tests;  // how many
  for (std::size_t i = 0; i < on_paper.designs.size() && !stop(); ++i) {
    const optimizer::Design& design = on_paper.designs[i];
    if (!(design.objective < objective)) break;
    const Candidate candidate(request, design, rows, stop);
    const std::optional<Tests> tests = candidate.Needed();
    if (!tests || tests->empty()) continue;
    const double reached = candidate.ObjectiveWith(*tests).value_or(objective);
    const auto known = by_tests.find(tests->size());
    if (reached < objective &&
        (known == by_tests.end() || reached < known->second.at("objective").get<double>()))
      by_tests[tests->size()] = Render(static_cast<int>(i) + 1, *tests, reached, objective);
  }
  double best = objective;
  for (const auto& [count, item] : by_tests) {
    if (!(item.at("objective").get<double>() < best)) continue;
    best = item.at("objective").get<double>();
    document["measure_together"].insert(document["measure_together"].begin(), item);
  }
}

}  // namespace plenum::api
