#include <algorithm>

#include "bench/search/rival.h"
#include "optimizer/search/tree_search.h"

namespace plenum::bench {
namespace {

constexpr int kRuns = 5;  // of milliseconds; the middle one counts

int IndexOf(const std::string& id) { return std::stoi(id.substr(id.find('-') + 1)); }

}  // namespace

Rival Plenum() {
  const auto solve = [](const BaseInstance& base, std::uint64_t, double time_limit_s) {
    optimizer::SearchOptions options;
    options.time_limit_s = time_limit_s;
    optimizer::Answer answer;
    std::vector<double> seconds;
    for (int run = 0; run < kRuns; ++run) {
      const ProcessorClock::time_point start = ProcessorClock::now();
      answer = optimizer::SearchTrees(base.problem, options);
      seconds.push_back(std::chrono::duration<double>(ProcessorClock::now() - start).count());
    }
    std::sort(seconds.begin(), seconds.end());
    Outcome outcome;
    outcome.total_s = outcome.find_s = seconds[kRuns / 2];
    outcome.claimed = answer.status == optimizer::Status::kOptimal;
    if (answer.designs.empty()) return outcome;
    outcome.found = true;
    for (const optimizer::Choice& choice : answer.designs.front().parts) {
      const int i = choice.family == optimizer::Family::kBattery ? 0 : IndexOf(choice.id);
      if (choice.family == optimizer::Family::kValve) outcome.best[kValves] = i;
      if (choice.family == optimizer::Family::kFitting) outcome.best[kFittings] = i;
      if (choice.family == optimizer::Family::kTubing) outcome.best[kTubes] = i;
      if (choice.family == optimizer::Family::kRegulator) outcome.best[kRegulators] = i;
      if (choice.family == optimizer::Family::kCylinder) outcome.best[kCylinders] = i;
    }
    return outcome;
  };
  return {"plenum", "best-first over boxes, exact march at their corners; trees of parts made anew",
          "count 1; the middle one of five runs", solve};
}

}  // namespace plenum::bench
