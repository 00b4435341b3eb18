#include "api/design/read/supply/own_pumps.h"

#include <algorithm>
#include <set>

#include "api/design/read/design_reader.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::PumpFeed;

bool Says(const catalog::Part& part, const char* field, std::string_view value) {
  const auto found = part.texts.find(field);
  return found != part.texts.end() && found->second.value == value;
}

// Vacuum pumps are asked for by what they evacuate, with a reservoir and without.
void KeepDirect(Reader& supply, optimizer::Problem& problem) {
  if (optimizer::Evacuated(problem)) {
    problem.configurations.erase(Configuration::kVacuumPump);
    problem.configurations.erase(Configuration::kEjector);
    return;
  }
  for (const Configuration one : problem.configurations)
    if (!optimizer::IsDirect(one))
      return supply.Fail("pumps", "must be shared, or left out, where supply.configurations has " +
                                      Quoted(optimizer::Name(one)) +
                                      ": pumps of their own are for direct_pump alone");
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
  const bool direct = std::any_of(problem.configurations.begin(), problem.configurations.end(),
                                  [](Configuration one) { return optimizer::IsDirect(one); });
  if (!direct)
    return supply.Fail(
        "pumps", "is for the configuration direct_pump, which supply.configurations does not name");
  if (problem.pump_feed == PumpFeed::kShared) return;
  KeepDirect(supply, problem);
  CheckActuators(supply, problem);
  for (optimizer::ActuatorGroup& group : problem.groups)
    group.fed_past_valve = problem.pump_feed == PumpFeed::kPerActuator;
}

bool SuitsFeed(const optimizer::Problem& problem, const catalog::Part& part) {
  const bool each = problem.pump_feed == PumpFeed::kPerActuator;
  if (part.family == "valve") return Says(part, "function", "2/2") == each;
  if (part.family == "compressor" || part.family == "vacuum_pump")
    return !each || !Says(part, "check_valve", "no");
  return true;
}

std::string PiecesWanted(int most, int feeds) {
  if (feeds > 1)
    return std::to_string(feeds) + ", or a multiple of it up to " + std::to_string(feeds * most) +
           ", as many for each of " + std::to_string(feeds) + " feeds (supply.pumps)";
  return (most == 1 ? "" : "a whole number ≥ 1 and ≤ ") + std::to_string(most);
}

std::string WhyNotForFeed(const optimizer::Problem& problem, const catalog::Part& part) {
  if (problem.pump_feed != PumpFeed::kPerActuator)
    return " only vents (2/2): it is for a pump of each actuator, supply.pumps: \"per_actuator\"";
  return part.family == "valve"
             ? " has a way for filling, too: an actuator with a pump of its own has a 2/2 valve"
             : " lets air back while it is off (check_valve: no): an actuator with a pump of its "
               "own would not keep its pressure";
}

}  // namespace plenum::api
