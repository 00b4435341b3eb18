#include "api/design/read/actuators/gait_reader.h"

#include <algorithm>
#include <cmath>

#include "api/json/remarks.h"
#include "optimizer/problem/gait.h"

namespace plenum::api {
namespace {

const Range kPhase = {0, 1};
const Range kFraction = {0.01, 0.99};
constexpr int kStrokesMax = 100;

// Also sides of cylinders have phases, which nobody gave.
bool AnyPhaseGiven(Reader& request) {
  const Json* actuators = request.Raw("actuators");
  return actuators != nullptr && actuators->is_array() &&
         std::any_of(actuators->begin(), actuators->end(), [](const Json& actuator) {
           return actuator.is_object() && actuator.contains("phase");
         });
}

bool AnyPhase(const optimizer::Problem& problem) {
  return std::any_of(problem.groups.begin(), problem.groups.end(),
                     [](const auto& group) { return !group.gait.phases.empty(); });
}

std::vector<double> ReadPhases(Reader& actuator, int count) {
  std::vector<double> phases;
  if (!actuator.Has("phase")) return phases;
  if (actuator.Raw("phase")->is_array()) {
    phases = actuator.Numbers("phase", static_cast<std::size_t>(count), kPhase);
    if (!phases.empty() && phases.size() != static_cast<std::size_t>(count)) {
      actuator.Fail("phase", "must be one number or one for each of " + std::to_string(count) +
                                 " actuators, not " + std::to_string(phases.size()));
      return {};
    }
  } else {
    phases.push_back(actuator.Number("phase", kPhase));
  }
  for (double& phase : phases) {
    if (std::isnan(phase)) return {};
    phase = std::fmod(phase, 1.0);
  }
  return phases;
}

}  // namespace

optimizer::Gait ReadGait(Reader& actuator, int count) {
  optimizer::Gait gait;
  gait.phases = ReadPhases(actuator, count);
  const double fraction = actuator.Number("inflate_fraction", kFraction, gait.inflate_fraction);
  if (!std::isnan(fraction)) gait.inflate_fraction = fraction;
  gait.strokes_per_period = actuator.Integer("strokes_per_period", 1, kStrokesMax, 1);
  return gait;
}

void CheckGaits(Reader& request, optimizer::Problem& problem) {
  if (problem.groups.empty()) return;
  const Json* duty = request.Raw("duty");
  const bool stated = duty && duty->is_object() && duty->contains("simultaneous");
  if (AnyPhaseGiven(request) && stated)
    if (RemarkRecorder* remarks = RemarkRecorder::Current())
      remarks->Warn("/duty/simultaneous",
                    "does not count for the groups that have a phase: the phase says when they "
                    "begin");
  if (problem.pump_feed != optimizer::PumpFeed::kShared) return;  // none fills two
  const optimizer::Meeting meeting = optimizer::MeetingOf(problem);
  if (meeting != optimizer::Meeting::kTogether && meeting != optimizer::Meeting::kMixed) return;
  // What was not asked for by name is no choice.
  problem.configurations.erase(optimizer::Configuration::kDirectVacuumPump);
  problem.configurations.erase(optimizer::Configuration::kDirectEjector);
  if (!problem.configurations.contains(optimizer::Configuration::kDirectPump) &&
      !optimizer::PumpsHoldOn(problem))
    return;
  const std::string with = optimizer::PumpsHoldOn(problem) ? "with supply.hold_on"
                                                           : "with the configuration direct_pump";
  if (AnyPhase(problem))
    request.FailAt("actuators",
                   "must begin at different times " + with +
                       ", whose pumps fill one after another: two have the same phase");
  else
    request.FailAt("duty/simultaneous",
                   "must be false " + with + ", whose pumps fill one group after another");
}

std::string WhyGaitNotGuaranteed(const optimizer::Problem& problem) {
  const bool plain = std::all_of(
      problem.groups.begin(), problem.groups.end(),
      [](const optimizer::ActuatorGroup& group) { return group.gait == optimizer::Gait{}; });
  return plain ? ""
               : "is not for gaits yet: leave phase, inflate_fraction and strokes_per_period out "
                 "of /actuators";
}

}  // namespace plenum::api
