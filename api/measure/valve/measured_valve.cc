#include "api/measure/valve/measured_valve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/shared_fields.h"
#include "api/json/words.h"
#include "api/simulate/rig.h"
#include "calibration/fit/recorded/instants.h"

namespace plenum::api {
namespace {

constexpr std::size_t kUnknownMax = 100;
constexpr double kUncertaintyMaxS = 1e5;

// A number of the range or "unknown", for which it stands `unknown`.
double ReadKnown(Reader& command, const char* name, Range range, double unknown) {
  const Json* value = command.Has(name) ? command.Raw(name) : nullptr;
  if (value != nullptr && value->is_string() && value->get_ref<const std::string&>() == "unknown")
    return unknown;
  return command.Number(name, range);
}

struct Command {
  model::ValveCommand command;
  double uncertainty_s = 0.0;
};

Command ReadCommand(Reader command, double last_s) {
  Command read;
  for (const char* name : {"t_s", "uncertainty_s"})
    command.Describe(name, {{"anyOf", {NumberForm({0, kTimeMaxS}), {{"const", "unknown"}}}}});
  read.command.time_s = ReadKnown(command, "t_s", {0, kTimeMaxS}, kNaN);
  read.command.state = ReadValveState(command);
  const bool found = command.Has("t_s") && command.Raw("t_s")->is_string();
  if (command.Has("uncertainty_s"))
    read.uncertainty_s =
        ReadKnown(command, "uncertainty_s", {0, kUncertaintyMaxS}, calibration::kUnknown);
  if (found && command.Has("uncertainty_s") && read.uncertainty_s != calibration::kUnknown)
    command.Fail("uncertainty_s", "must be left out where t_s is \"unknown\"");
  if (found) read.uncertainty_s = calibration::kUnknown;
  if (read.command.time_s < last_s)
    command.Fail("t_s", "must not fall from command to command: " + Decimal(read.command.time_s) +
                            " follows " + Decimal(last_s));
  command.Finish();
  return read;
}

}  // namespace

void ReadMeasuredValve(Reader& owner, calibration::Run& run) {
  if (!owner.Has("valve") || owner.Has("cycle")) {
    if (const auto schedule = ReadSchedule(owner))
      run.valve = schedule->commands;
    else
      owner.Fail("valve", "is required, a list of commands { t_s, state }");
    return;
  }
  double last_s = 0.0;
  std::size_t unknown = 0;
  bool uncertain = false;
  for (const Element& element : owner.List("valve", 0, kCommandsMax)) {
    const Command read = ReadCommand(Reader(element, owner.errors()), last_s);
    run.valve.push_back(read.command);
    run.valve_uncertainty_s.push_back(read.uncertainty_s);
    unknown += read.uncertainty_s == calibration::kUnknown;
    uncertain |= read.uncertainty_s > 0.0;
    if (!std::isnan(read.command.time_s)) last_s = read.command.time_s;
  }
  if (!uncertain) run.valve_uncertainty_s.clear();
  if (unknown > kUnknownMax)
    owner.Fail("valve", "must hold at most " + std::to_string(kUnknownMax) +
                            " commands whose instants are not known, not " +
                            std::to_string(unknown));
}

void FindInstants(Reader& owner, calibration::Run& run) {
  const auto unknown = [](const model::ValveCommand& command) {
    return std::isnan(command.time_s);
  };
  if (std::none_of(run.valve.begin(), run.valve.end(), unknown)) return;
  const auto count = std::count_if(run.valve.begin(), run.valve.end(), unknown);
  if (static_cast<std::size_t>(count) > kUnknownMax || run.t_s.empty() ||
      run.t_s.size() != run.pressure_pa.size())
    return;  // reported
  calibration::GuessInstants(run);
  for (std::size_t k = 0; k < run.valve.size(); ++k)
    if (unknown(run.valve[k]))
      owner.FailAt("valve/" + std::to_string(k) + "/t_s",
                   "must be given: there are no readings between its neighbours to find it in");
}

}  // namespace plenum::api
