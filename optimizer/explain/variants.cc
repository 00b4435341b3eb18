#include "optimizer/explain/variants.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "optimizer/explain/conflict.h"
#include "optimizer/problem/kind.h"
#include "optimizer/search/box_search.h"
#include "optimizer/search/tree_search.h"
#include "optimizer/sizing/report.h"

namespace plenum::optimizer {
namespace {

constexpr double kNearly = 1.01;  // of the best objective
constexpr std::size_t kVariantsMost = 100;
// Steps of the searches for variants: of one kind, of a whole list, the first designs first.
constexpr long long kStepsOfKind = 10'000, kStepsOfList = 60'000;

using Clock = std::chrono::steady_clock;

// Searches within what is left of a time limit.
class TimeLeft {
 public:
  TimeLeft(const SearchOptions& options, double used_s)
      : options_(options), left_s_(options.time_limit_s - used_s) {
    options_.record = false;
    options_.progress = nullptr;
  }
  // For one of so many searches that are still to come.
  SearchOptions Options(int searches = 1) const {
    SearchOptions options = options_;
    options.time_limit_s =
        std::max(0.0, left_s_ - std::chrono::duration<double>(Clock::now() - start_).count()) /
        searches;
    return options;
  }

 private:
  SearchOptions options_;
  double left_s_;
  Clock::time_point start_ = Clock::now();
};

// The problem of the configuration and the series of a kind alone.
Problem OfKind(const Problem& problem, const DesignKinds& kinds, const Kind& kind) {
  Problem own = problem;
  own.configurations = {kind.configuration};
  own.list = ListOf::kCombinations;
  const auto keep = [&](auto& parts, Family family, const auto& wanted) {
    const std::vector<int>& series = kinds.SeriesOf(family);
    std::size_t i = 0;
    std::erase_if(parts, [&](const auto&) { return !wanted(series[i++]); });
  };
  // A tank comes before the pump that goes on filling it.
  const auto first = [&](int series) {
    return !kind.sources.empty() && series == kind.sources.front();
  };
  const auto last = [&](int series) {
    return !kind.sources.empty() && series == kind.sources.back();
  };
  keep(own.parts.compressors, Family::kCompressor, last);
  keep(own.parts.vacuum_pumps, Family::kVacuumPump, last);
  keep(own.parts.ejectors, Family::kEjector, last);
  keep(own.parts.cylinders, Family::kCylinder, first);
  keep(own.parts.co2, Family::kCo2, first);
  keep(own.parts.tanks, Family::kTank, first);
  keep(own.parts.regulators, Family::kRegulator, [&](int series) {
    return std::binary_search(kind.regulators.begin(), kind.regulators.end(), series);
  });
  keep(own.parts.valves, Family::kValve, [&](int series) {
    return std::binary_search(kind.valves.begin(), kind.valves.end(), series);
  });
  return own;
}

Variants VariantsOf(const Problem& problem, const DesignKinds& kinds, SearchOptions options,
                    const Design& best, long long& steps_left) {
  const Kind kind = kinds.Of(best.configuration, best.parts);
  Problem own = OfKind(problem, kinds, kind);
  own.count = static_cast<int>(kVariantsMost) + 2;  // the best itself, and one too many
  options.objective_max = kNearly * best.objective;
  options.steps_max = std::min(kStepsOfKind, steps_left);
  Listed listed = ListCombinations(own, options);
  steps_left -= listed.steps;
  Variants variants;
  variants.complete = listed.complete && static_cast<int>(listed.combinations.size()) < own.count;
  for (Variant& variant : listed.combinations) {
    if (variant.objective > options.objective_max || SameParts(variant.parts, best.parts)) continue;
    if (!(kinds.Of(best.configuration, variant.parts) == kind)) continue;
    if (variants.found.size() < kVariantsMost) variants.found.push_back(std::move(variant));
  }
  return variants;
}

// The best design of a problem of its own, which has some of the parts or configurations alone.
BestDesign BestOf(Problem own, const SearchOptions& options, const Answer& answer) {
  own.list = ListOf::kCombinations;
  own.count = 1;
  Answer search = SearchTrees(own, options);
  BestDesign best{.status = search.status, .lower_bound = search.proof.lower_bound};
  if (best.status == Status::kInfeasible)
    best.conflict = FindOneConflict(own, options, search.seconds);
  if (search.designs.empty()) return best;
  best.design = std::move(search.designs.front());
  best.configuration = best.design->configuration;
  best.lower_bound = std::min(best.lower_bound, best.design->objective);
  const auto listed =
      std::find_if(answer.designs.begin(), answer.designs.end(), [&](const Design& design) {
        return design.configuration == best.configuration &&
               SameParts(design.parts, best.design->parts);
      });
  if (listed != answer.designs.end())
    best.rank = static_cast<int>(listed - answer.designs.begin()) + 1;
  return best;
}

auto ListedOf(Configuration configuration, const Answer& answer) {
  return std::find_if(answer.designs.begin(), answer.designs.end(),
                      [&](const Design& design) { return design.configuration == configuration; });
}

BestDesign BestOfConfiguration(const Problem& problem, const SearchOptions& options,
                               Configuration configuration, const Answer& answer) {
  if (const auto listed = ListedOf(configuration, answer); listed != answer.designs.end())
    return {.configuration = configuration,
            .status = answer.status,
            .design = *listed,
            .rank = static_cast<int>(listed - answer.designs.begin()) + 1,
            .lower_bound = std::min(answer.proof.lower_bound, listed->objective)};
  Problem own = problem;
  own.configurations = {configuration};
  BestDesign best = BestOf(std::move(own), options, answer);
  best.configuration = configuration;
  return best;
}

}  // namespace

void AddVariants(const Problem& problem, const SearchOptions& options, double used_s,
                 Answer& answer) {
  const TimeLeft time(options, used_s);
  const DesignKinds kinds(problem.parts);
  long long steps_left = kStepsOfList;
  for (Design& design : answer.designs)
    design.variants = steps_left > 0
                          ? VariantsOf(problem, kinds, time.Options(), design, steps_left)
                          : Variants{};
}

void AddBests(const Problem& problem, const SearchOptions& options, double used_s, Answer& answer) {
  const TimeLeft time(options, used_s);
  const bool products = options.select && !problem.orderable_only;
  int searches = products;
  for (const Configuration configuration : problem.configurations)
    searches += ListedOf(configuration, answer) == answer.designs.end();
  for (const Configuration configuration : problem.configurations) {
    const bool listed = ListedOf(configuration, answer) != answer.designs.end();
    answer.by_configuration.push_back(
        BestOfConfiguration(problem, time.Options(std::max(1, searches)), configuration, answer));
    searches -= !listed;
  }
  if (!products) return;
  Problem own = problem;
  own.orderable_only = true;
  own.parts = options.select(own);
  answer.orderable = BestOf(std::move(own), time.Options(), answer);
}

}  // namespace plenum::optimizer
