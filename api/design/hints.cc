#include "api/design/hints.h"

#include <cmath>
#include <string>

#include "api/design/read/selection.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/search/tree_search.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::Problem;

constexpr double kTenthLess = 0.9;
constexpr long long kSteps = 5'000;  // of each search

bool NamesConfigurations(const Json& request) {
  const auto supply = request.find("supply");
  return supply != request.end() && supply->is_object() && supply->contains("configurations");
}

bool MayBeAsked(const Problem& problem, Configuration configuration) {
  if (HasVacuumRail(problem) && !GoesWithVacuumRail(configuration)) return false;
  if (configuration == Configuration::kMains) return problem.mains.pressure_pa > 0.0;
  return !optimizer::IsDirect(configuration) || !optimizer::StrokesMeet(problem);
}

// The same with one other configuration, and one design.
Problem With(const Problem& problem, Configuration configuration,
             const std::vector<catalog::Part>& parts) {
  Problem other = problem;
  other.configurations = {configuration};
  other.pump_feed = optimizer::PumpFeed::kShared;
  optimizer::SetPumpsHoldOn(false, other);
  for (optimizer::ActuatorGroup& group : other.groups) group.fed_past_valve = false;
  other.list = optimizer::ListOf::kCombinations;
  other.count = 1;
  other.parts = AllowedModelParts(parts, other);
  return other;
}

std::string HintWords(Configuration configuration, double objective, const double* best) {
  const std::string name = optimizer::Name(configuration);
  if (best == nullptr)
    return "the configuration " + name +
           ", which supply.configurations does not name, has a design";
  return "the configuration " + name +
         ", which supply.configurations does not name, would do with " +
         std::to_string(std::lround(100.0 * (1.0 - objective / *best))) + " % less";
}

}  // namespace

void AddHints(const DesignRequest& request, const optimizer::Answer& answer,
              const optimizer::SearchOptions& options, const std::vector<catalog::Part>& parts,
              Json& document) {
  const Problem& problem = request.problem;
  const bool known = answer.status == optimizer::Status::kInfeasible || !answer.designs.empty();
  if (!known || !NamesConfigurations(request.request) || optimizer::Evacuated(problem)) return;
  const double* best = answer.designs.empty() ? nullptr : &answer.designs.front().objective;
  double used_s = answer.seconds;
  Json hints = Json::array();
  for (const Configuration configuration : optimizer::kPressureConfigurations) {
    if (problem.configurations.contains(configuration) || !MayBeAsked(problem, configuration))
      continue;
    optimizer::SearchOptions own = options;
    own.record = false;
    own.progress = nullptr;
    own.steps_max = kSteps;
    own.time_limit_s = options.time_limit_s - used_s;
    if (own.time_limit_s <= 0.0) break;
    if (best != nullptr) own.objective_max = kTenthLess * *best;
    const optimizer::Answer other =
        optimizer::SearchTrees(With(problem, configuration, parts), own);
    used_s += other.seconds;
    if (other.designs.empty() || other.designs.front().objective > own.objective_max) continue;
    const double objective = other.designs.front().objective;
    hints.push_back({{"configuration", optimizer::Name(configuration)},
                     {"objective", Number(objective)},
                     {"words", HintWords(configuration, objective, best)}});
  }
  if (!hints.empty()) document["hints"] = std::move(hints);
}

}  // namespace plenum::api
