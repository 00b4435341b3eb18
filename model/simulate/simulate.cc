#include "model/simulate/simulate.h"

#include <algorithm>
#include <cmath>

#include "model/simulate/simulate_run.h"
#include "model/simulate/simulate_validate.h"

namespace plenum::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Response Refused(const std::string& reason) {
  Response response;
  response.status = SimulateStatus::kInvalid;
  response.detail = reason;
  return response;
}

Response RunRig(const Rig& rig, const SimulateOptions& options, RunUntil until) {
  const bool implicit = options.integrator == Integrator::kImplicit;
  if (options.integrator != Integrator::kCvode && !implicit) {
    Run<double, ExplicitIntegrator<double>> run(rig, options, until);
    Response response = run.Execute();
    if (!run.stiff()) return response;
  }
  if (implicit || options.integrator == Integrator::kDamped) {
    const SimulateOptions damped = DampedOptions(options);
    Response response = Run<double, ImplicitIntegrator<double>>(rig, damped, until).Execute();
    response.stiff = true;
    return response;
  }
  Response response = Run<double, CvodeIntegrator>(rig, options, until).Execute();
  response.stiff = true;
  return response;
}

// The rig and the options of a full stroke (simulate.h): all groups obey one command at time 0,
// from where they rest when they inflate and from the operating pressure when they deflate.
Rig StrokeRig(Rig rig, ValveState state) {
  const bool inflate = state == ValveState::kInflate;
  if (!inflate) rig.source = NoSource{};
  for (GroupRig& group : rig.groups) {
    group.initial_pressure_pa =
        inflate ? RestPa(group.chamber) : group.chamber.operating_pressure_pa;
    group.schedule.clear();
    if (!(inflate ? group.fill : group.exhaust).empty()) group.schedule = {{0.0, state}};
  }
  return rig;
}

SimulateOptions StrokeOptions(SimulateOptions options) {
  options.end_s = kFullStrokeHorizonS;
  options.sample_hz = 0.0;
  options.record = Record::kAll;
  return options;
}

struct StrokeTimes {
  std::vector<double> to_target_s;  // by group
  SimulateStatus status;
};

StrokeTimes RunStrokes(const Rig& rig, const SimulateOptions& options, ValveState state) {
  StrokeTimes times = {std::vector<double>(rig.groups.size(), kInfinity), SimulateStatus::kInvalid};
  const Rig stroke_rig = StrokeRig(rig, state);
  if (!WhyInvalid(stroke_rig).empty()) return times;
  const Response response = RunRig(stroke_rig, options, RunUntil::kTargets);
  for (const Stroke& stroke : response.strokes) {
    times.to_target_s[static_cast<std::size_t>(stroke.group)] = stroke.to_target_s;
  }
  times.status = response.status;
  return times;
}

}  // namespace

Response Simulate(const Rig& rig, const SimulateOptions& options) {
  std::string reason = WhyInvalid(options);
  if (reason.empty()) reason = WhyInvalid(rig);
  if (!reason.empty()) return Refused(reason);
  return RunRig(rig, options, RunUntil::kEnd);
}

std::vector<FullStroke> FullStrokes(const Rig& rig, const SimulateOptions& options) {
  const SimulateOptions until_reached = StrokeOptions(options);
  std::vector<FullStroke> strokes(rig.groups.size(),
                                  {kInfinity, kInfinity, 0.0, SimulateStatus::kInvalid});
  if (!WhyInvalid(until_reached).empty()) return strokes;

  const StrokeTimes rise = RunStrokes(rig, until_reached, ValveState::kInflate);
  const StrokeTimes fall = RunStrokes(rig, until_reached, ValveState::kDeflate);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const double rise_s = rise.to_target_s[i];
    const double fall_s = fall.to_target_s[i];
    strokes[i] = {rise_s, fall_s, 1.0 / (rise_s + fall_s),
                  rise.status == SimulateStatus::kDone ? fall.status : rise.status};
  }
  return strokes;
}

}  // namespace plenum::model
