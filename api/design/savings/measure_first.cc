#include "api/design/savings/measure_first.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "api/design/savings/part_tests.h"
#include "api/json/json.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/search/tree_search.h"

namespace plenum::api {
namespace {

using Clock = std::chrono::steady_clock;
using Tests = std::vector<const PartTest*>;

constexpr std::size_t kDesignsOnPaper = 3;  // whose parts are looked at
constexpr std::size_t kTold = 3;
constexpr double kNoSaving = 1e-6;   // share of the objective that is no saving
constexpr double kOfTheRest = 0.25;  // of the time: a search that does not end leaves some

struct Saving {
  Tests tests;
  double least = 0.0, most = 0.0;  // equal where the search was proved
};

// The problem without designs that lack the part: they are guaranteed today or never. Where several
// lines may have different parts of the family, or several regulators, it stays as it is.
void Require(const catalog::Part& part, optimizer::Problem& problem) {
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    if (part.family != spec.name || optimizer::CatalogueFamily(spec.family) != spec.family)
      continue;
    const bool one_kind =
        spec.in_line ? problem.groups.size() == 1
                     : !spec.joins && (spec.family != optimizer::Family::kRegulator ||
                                       problem.regulation == optimizer::Regulation::kShared);
    if (!one_kind) return;
    problem.require[spec.family] = {part.id};
    if (!spec.in_line)
      std::erase_if(problem.configurations,
                    [&](optimizer::Configuration one) { return !spec.InSourceOf(one); });
  }
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

  // All was looked at, and whatever is not told saves nothing.
  bool complete() const { return complete_ && decided_; }

  // Whether it was looked at: time is left. What saves is kept.
  bool Look(Tests tests) {
    complete_ = complete_ && !OutOfTime();
    if (!complete_) return false;
    Saving saving = With(std::move(tests));
    if (!Saves(saving)) return true;
    decided_ = decided_ && (saving.least > 0.0 || saving.least == saving.most);
    savings_.push_back(std::move(saving));
    return true;
  }

  // All tests of one part: what they do not save together none of them does.
  void LookAtPart(const Tests& tests) {
    const std::size_t before = savings_.size();
    if (!Look(tests) || tests.size() < 2 || savings_.size() == before) return;
    const Saving all = savings_.back();
    savings_.pop_back();
    double most = 0.0;
    for (const PartTest* test : tests) {
      const std::size_t count = savings_.size();
      if (Look({test}) && savings_.size() > count) most = std::max(most, savings_.back().least);
    }
    if (all.least > kPairs * most || all.least < all.most) savings_.push_back(all);
  }

  // Those that save, most first.
  std::vector<Saving> Told() const {
    std::vector<Saving> told = savings_;
    std::erase_if(told, [](const Saving& saving) { return !(saving.least > 0.0); });
    std::stable_sort(told.begin(), told.end(),
                     [](const Saving& a, const Saving& b) { return a.least > b.least; });
    if (told.size() > kTold) told.resize(kTold);
    return told;
  }

 private:
  bool OutOfTime() const {
    return SecondsLeft() <= 0.0 || (options_.cancelled && options_.cancelled());
  }

  double SecondsLeft() const {
    return options_.time_limit_s - std::chrono::duration<double>(Clock::now() - start_).count();
  }

  bool Saves(const Saving& saving) const { return saving.most > kNoSaving * objective_; }

  Saving With(Tests tests) const {
    optimizer::Problem problem = problem_;
    for (const PartTest* test : tests) Require(*test->part, problem);
    optimizer::SearchOptions options = options_;
    options.time_limit_s = kOfTheRest * SecondsLeft();
    options.objective_max = objective_;
    const optimizer::Answer answer = optimizer::SearchTrees(
        GuaranteedProblem(problem, *request_.guarantee, rows_, SettledBy(tests)), options);
    Saving saving{std::move(tests)};
    // The best design of today is still guaranteed, so that nothing else found means no saving.
    if (!answer.designs.empty())
      saving.least = std::max(0.0, objective_ - answer.designs.front().objective);
    saving.most = std::max(saving.least, objective_ - answer.proof.lower_bound);
    const bool proved = answer.status == optimizer::Status::kOptimal ||
                        answer.status == optimizer::Status::kInfeasible;
    if (proved) saving.most = saving.least;
    if (saving.least <= kNoSaving * objective_) saving.least = 0.0;
    return saving;
  }

  const DesignRequest& request_;
  const std::vector<catalog::Part>& rows_;
  double objective_;
  optimizer::SearchOptions options_;
  optimizer::Problem problem_;
  Clock::time_point start_ = Clock::now();
  std::vector<Saving> savings_;
  bool complete_ = true, decided_ = true;
};

Json RenderSaving(const Saving& saving, double objective) {
  Json json = RenderTest(*saving.tests.front());
  const bool proved = saving.least == saving.most;
  json["saving"] = proved ? Number(saving.least) : Json(nullptr);
  json["saving_share"] = proved ? Number(saving.least / objective) : Json(nullptr);
  if (!proved) json["saving_interval"] = {Number(saving.least), Number(saving.most)};
  if (saving.tests.size() > 1) json["with"] = RenderTest(*saving.tests.back());
  return json;
}

// The tests by part, the least certain part first.
std::vector<Tests> ByPart(const std::vector<PartTest>& tests) {
  std::vector<Tests> parts;
  for (const PartTest& test : tests) {
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const Tests& of) { return of.front()->part == test.part; });
    if (part == parts.end())
      parts.push_back({&test});
    else
      part->push_back(&test);
  }
  return parts;
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
  const std::vector<PartTest> tests = TestsOf(designs, rows, request.guarantee->tolerance);
  Retrial retrial(request, rows, objective, options);
  for (const Tests& part : ByPart(tests)) retrial.LookAtPart(part);
  if (retrial.Told().empty())
    for (std::size_t i = 0; i < tests.size(); ++i)
      for (std::size_t j = i + 1; j < tests.size(); ++j)
        if (tests[i].part != tests[j].part) retrial.Look({&tests[i], &tests[j]});
  for (const Saving& saving : retrial.Told())
    document["measure_first"].push_back(RenderSaving(saving, objective));
  document["measure_first_complete"] = retrial.complete();
}

}  // namespace plenum::api
