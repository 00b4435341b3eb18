#include "model/simulate.h"

#include <algorithm>
#include <cmath>

#include "model/simulate_run.h"
#include "model/simulate_validate.h"

namespace plenum::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFullStrokeHorizonS = 1e6;

Response Refused(const std::string& reason) {
  Response response;
  response.status = SimulateStatus::kInvalid;
  response.detail = reason;
  return response;
}

Response RunRig(const Rig& rig, const SimulateOptions& options, RunUntil until) {
  if (options.integrator != Integrator::kCvode) {
    Run<double, ExplicitIntegrator<double>> run(rig, options, until);
    Response response = run.Execute();
    if (!run.stiff()) return response;
  }
  Response response = Run<double, CvodeIntegrator>(rig, options, until).Execute();
  response.stiff = true;
  return response;
}

// All groups obey one command from the given pressures on; time to target by group.
std::vector<double> StrokeTimes(Rig rig, const SimulateOptions& options, ValveState state) {
  for (GroupRig& group : rig.groups) {
    const bool inflate = state == ValveState::kInflate;
    group.initial_pressure_pa =
        inflate ? rig.ambient.pressure_pa : group.chamber.operating_pressure_pa;
    group.schedule.clear();
    if (!(inflate ? group.fill : group.exhaust).empty()) group.schedule = {{0.0, state}};
  }
  std::vector<double> times(rig.groups.size(), kInfinity);
  if (!WhyInvalid(rig).empty()) return times;
  const Response response = RunRig(rig, options, RunUntil::kTargets);
  for (const Stroke& stroke : response.strokes) {
    times[static_cast<std::size_t>(stroke.group)] = stroke.to_target_s;
  }
  return times;
}

}  // namespace

std::vector<ValveCommand> CycleSchedule(double frequency_hz, double inflate_fraction, int cycles,
                                        double phase) {
  std::vector<ValveCommand> schedule;
  for (int i = 0; i < cycles; ++i) {
    const double start = i + phase;
    schedule.push_back({start / frequency_hz, ValveState::kInflate});
    schedule.push_back({(start + inflate_fraction) / frequency_hz, ValveState::kDeflate});
  }
  return schedule;
}

Response Simulate(const Rig& rig, const SimulateOptions& options) {
  std::string reason = WhyInvalid(options);
  if (reason.empty()) reason = WhyInvalid(rig);
  if (!reason.empty()) return Refused(reason);
  return RunRig(rig, options, RunUntil::kEnd);
}

std::vector<FullStroke> FullStrokes(const Rig& rig, const SimulateOptions& options) {
  SimulateOptions until_reached = options;
  until_reached.end_s = kFullStrokeHorizonS;
  until_reached.sample_hz = 0.0;
  std::vector<FullStroke> strokes(rig.groups.size(), {kInfinity, kInfinity, 0.0});
  if (!WhyInvalid(until_reached).empty()) return strokes;

  Rig vented = rig;
  vented.source = NoSource{};
  const std::vector<double> rise = StrokeTimes(rig, until_reached, ValveState::kInflate);
  const std::vector<double> fall = StrokeTimes(vented, until_reached, ValveState::kDeflate);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    strokes[i] = {rise[i], fall[i], 1.0 / (rise[i] + fall[i])};
  }
  return strokes;
}

}  // namespace plenum::model
