#include "api/design/read/supply/own_pumps.h"

#include <algorithm>
#include <set>

#include "api/design/read/design_reader.h"
#include "api/json/remarks.h"
#include "api/json/words.h"
#include "optimizer/problem/gait.h"
#include "optimizer/problem/joints.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::PumpFeed;

bool Says(const catalog::Part& part, const char* field, std::string_view value) {
  const auto found = part.texts.find(field);
  return found != part.texts.end() && found->second.value == value;
}

// Vacuum pumps are asked for by what they evacuate, with a reservoir and without. `plain`: what the
// field must be beside others; `what`: pumps it asks for.
void KeepDirect(Reader& supply, const char* field, const std::string& plain,
                const std::string& what, optimizer::Problem& problem) {
  problem.configurations.erase(Configuration::kVacuumPump);
  problem.configurations.erase(Configuration::kEjector);
  const bool vacuum = optimizer::Evacuated(problem);
  const auto other = std::find_if_not(problem.configurations.begin(), problem.configurations.end(),
                                      [](Configuration one) { return optimizer::IsDirect(one); });
  if (other == problem.configurations.end()) return;
  std::string told = "must be " + plain + ", or left out, where supply.";
  told += vacuum ? "vacuum.configurations has " : "configurations has ";
  told += Quoted(optimizer::Name(*other)) + ": " + what + " are for ";
  told += vacuum ? "pumps and ejectors alone" : "direct_pump alone";
  supply.Fail(field, told);
}

// Whether some configuration is one of pumps without a reservoir; else the field fails.
bool AsksForDirect(Reader& supply, const char* field, const optimizer::Problem& problem) {
  const bool direct = std::any_of(problem.configurations.begin(), problem.configurations.end(),
                                  [](Configuration one) { return optimizer::IsDirect(one); });
  if (!direct)
    supply.Fail(field,
                "is for the configuration direct_pump, which supply.configurations does not name");
  return direct;
}

void CheckActuators(Reader& supply, const optimizer::Problem& problem) {
  std::set<int> entries;
  for (const optimizer::ActuatorGroup& group : problem.groups) {
    if (group.entry >= 0 && !entries.insert(group.entry).second)
      return supply.Fail("pumps",
                         "must be shared for a double-acting cylinder, whose two sides "
                         "have one pump");
    if (problem.pump_feed == PumpFeed::kPerActuator && group.gait.phases.size() > 1)
      return supply.Fail("pumps",
                         "must not be per_actuator where a group has a phase for each "
                         "actuator, as " +
                             group.name + " has: make each of them a group of its own");
  }
}

}  // namespace

void ReadPumps(Reader& supply, optimizer::Problem& problem) {
  if (!supply.Has("pumps")) return;
  problem.pump_feed = ReadEnum<PumpFeed>(
      supply, "pumps", {PumpFeed::kShared, PumpFeed::kPerGroup, PumpFeed::kPerActuator});
  if (!AsksForDirect(supply, "pumps", problem) || problem.pump_feed == PumpFeed::kShared) return;
  KeepDirect(supply, "pumps", "shared", "pumps of their own", problem);
  CheckActuators(supply, problem);
  for (optimizer::ActuatorGroup& group : problem.groups)
    group.fed_past_valve = problem.pump_feed == PumpFeed::kPerActuator;
}

void ReadHoldOn(Reader& supply, optimizer::Problem& problem) {
  optimizer::SetPumpsHoldOn(supply.Bool("hold_on", false), problem);
  if (!optimizer::PumpsHoldOn(problem) || !AsksForDirect(supply, "hold_on", problem)) return;
  KeepDirect(supply, "hold_on", "false", "pumps that run on", problem);
}

void WarnOfTurns(const optimizer::Problem& problem) {
  constexpr double kRounding = 1.0 - 1e-9;
  RemarkRecorder* remarks = RemarkRecorder::Current();
  if (!optimizer::PumpsHoldOn(problem) || remarks == nullptr) return;
  for (const optimizer::FedSquad& fed : optimizer::FedSquadsOf(problem)) {
    const int g = fed.squad.group;
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const double window_s = group.gait.strokes_per_period * optimizer::InflateWindow(problem, g);
    if (fed.run_s < kRounding * window_s)
      return remarks->Warn("/supply/hold_on",
                           "the pumps hold " + group.name +
                               " only until they fill the next actuators: from then on its valves "
                               "keep it");
  }
}

bool SuitsFeed(const optimizer::Problem& problem, const catalog::Part& part) {
  const bool each = problem.pump_feed == PumpFeed::kPerActuator;
  return part.family != "valve" || Says(part, "function", "2/2") == each;
}

bool LacksCheckValve(const optimizer::Problem& problem, const catalog::Part& part) {
  return problem.pump_feed == PumpFeed::kPerActuator && Says(part, "check_valve", "no") &&
         optimizer::CheckValveOf(problem, problem.parts) < 0;
}

std::string WhyNoPumps(const optimizer::Problem& problem) {
  const bool any =
      std::any_of(problem.configurations.begin(), problem.configurations.end(),
                  [&](Configuration one) { return !optimizer::PumpsOf(problem, one).empty(); });
  if (any || problem.pump_feed != PumpFeed::kPerActuator) return "";
  return "must not be per_actuator: each pump that may be chosen lets air back while it is off "
         "(check_valve: no), and no check valve that may be chosen stands the operating pressure "
         "and passes enough";
}

std::string PiecesWanted(int most, int feeds) {
  if (feeds > 1)
    return std::to_string(feeds) + ", or a multiple of it up to " + std::to_string(feeds * most) +
           ", as many for each of " + std::to_string(feeds) + " feeds (supply.pumps)";
  return (most == 1 ? "" : "a whole number ≥ 1 and ≤ ") + std::to_string(most);
}

std::string WhyNotForFeed(const optimizer::Problem& problem) {
  if (problem.pump_feed != PumpFeed::kPerActuator)
    return " only vents (2/2): it is for a pump of each actuator, supply.pumps: \"per_actuator\"";
  return " has a way for filling, too: an actuator with a pump of its own has a 2/2 valve";
}

}  // namespace plenum::api
