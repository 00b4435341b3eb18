#include "model/simulate/periodic.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "model/integrate/anderson.h"
#include "model/simulate/simulate_run.h"
#include "model/simulate/simulate_validate.h"

namespace plenum::model {
namespace {

// A jump after which the residual is this much larger is undone.
constexpr double kGrowth = 2.0;
// Periods of commands before the start that a valve's delay may reach back to.
constexpr double kHistoryMax = 1e4;
// Nearer than this to the pumps' limit, a reservoir is at it.
constexpr double kAtLimit = 1e-12;
// The simulator's own error, as a share of the tolerance.
constexpr double kSimulated = 0.1;

// Where a period begins or ends.
struct Standing {
  Eigen::VectorXd state;
  std::vector<ValveProgress<double>> valves;  // empty: as the commands before 0 leave them
  std::vector<Stroke> strokes;                // under way
};

struct Cycle {
  Response response;
  Standing end;  // on the clock of the next period
};

// Largest |value|/size.
double LargestShare(const Eigen::VectorXd& value, const Eigen::VectorXd& size) {
  return value.cwiseQuotient(size).lpNorm<Eigen::Infinity>();
}

// The rig with its commands repeated before 0, and one period of it at a time.
class CycleMap {
 public:
  CycleMap(const Rig& rig, double period_s, const SimulateOptions& options)
      : rig_(rig), period_s_(period_s), options_(options) {
    options_.end_s = period_s;
    System<double> system(rig, {.linear_ratio = options.linear_ratio}, Lift(), false);
    const std::vector<double> initial = system.InitialState();
    initial_ = Eigen::Map<const Eigen::VectorXd>(initial.data(),
                                                 static_cast<Eigen::Index>(system.dynamic_size()));
    sizes_ = Eigen::Map<const Eigen::VectorXd>(system.sizes().data(), initial_.size());
    if (const auto source = system.source_state()) {
      source_ = static_cast<Eigen::Index>(*source);
      limit_pa_ = system.pump_limit_pa();
    }
    for (std::size_t i = 0; i < rig.groups.size(); ++i) {
      Repeat(rig_.groups[i].schedule, system.valve_delay_s(i));
      if (rig.groups[i].close_at_operating)
        CloseWhatEnded(ValveState::kInflate, rig_.groups[i].schedule);
      if (rig.groups[i].close_at_low) CloseWhatEnded(ValveState::kDeflate, rig_.groups[i].schedule);
      commands_.push_back(rig.groups[i].schedule.size());
    }
  }

  Standing Start() const { return {initial_, {}, {}}; }

  // Sizes of the states: of a pressure, itself.
  Eigen::VectorXd Sizes(const Eigen::VectorXd& state) const {
    return (sizes_.array() > 0.0).select(sizes_, state.cwiseAbs());
  }

  // One period from there on.
  Cycle operator()(const Standing& start, double sample_hz) {
    options_.sample_hz = sample_hz;
    Cycle cycle;
    if (!stiff_ && options_.integrator != Integrator::kCvode) {
      stiff_ = Take<ExplicitIntegrator<double>>(start, cycle);
      if (!stiff_) return cycle;
    }
    Take<CvodeIntegrator>(start, cycle);
    cycle.response.stiff = true;
    return cycle;
  }

  // Makes a jump from `image` physical where it hardly is not. False where it goes astray: a
  // pressure more than doubled or halved.
  bool Confine(const Eigen::VectorXd& image, Eigen::VectorXd& state) const {
    if (!state.allFinite()) return false;
    for (Eigen::Index i = 0; i < state.size(); ++i) {
      if (sizes_[i] == 0.0 && !(state[i] >= 0.5 * image[i] && state[i] <= 2.0 * image[i])) {
        return false;
      }
    }
    if (source_ >= 0 && image[source_] <= limit_pa_ &&
        state[source_] > limit_pa_ * (1.0 - kAtLimit)) {
      state[source_] = limit_pa_;
    }
    return true;
  }

 private:
  void Repeat(std::vector<ValveCommand>& schedule, double delay_s) const {
    const std::vector<ValveCommand> once = schedule;
    schedule.clear();
    for (double back = 1.0 + std::floor(delay_s / period_s_); back >= 0.0; back -= 1.0) {
      for (const ValveCommand& command : once) {
        schedule.push_back({command.time_s - back * period_s_, command.state});
      }
    }
  }

  // A valve that was told to inflate before 0 has closed since, as it will in later periods: open
  // it would fill its chamber beyond the operating pressure in the first. Or to deflate, below the
  // low pressure.
  void CloseWhatEnded(ValveState state, std::vector<ValveCommand>& schedule) const {
    constexpr double kJustBefore = -1e-12;  // of the period
    const auto now =
        std::find_if(schedule.begin(), schedule.end(),
                     [](const ValveCommand& command) { return command.time_s >= 0.0; });
    if (now != schedule.begin() && std::prev(now)->state == state)
      schedule.insert(now, {kJustBefore * period_s_, ValveState::kHold});
  }

  // Whether the integrator gave up because the equations are stiff.
  template <class Stepper>
  bool Take(const Standing& start, Cycle& cycle) const {
    Run<double, Stepper> run(rig_, options_, RunUntil::kEnd);
    if (!start.valves.empty()) run.Resume(start.valves, start.strokes);
    cycle.response =
        run.Execute({start.state.data(), static_cast<std::size_t>(start.state.size())});
    cycle.end.state = Eigen::Map<const Eigen::VectorXd>(run.final_state().data(), initial_.size());
    cycle.end.valves = run.final_valves();
    cycle.end.strokes.clear();
    for (std::size_t i = 0; i < cycle.end.valves.size(); ++i) {
      ValveProgress<double>& valve = cycle.end.valves[i];
      valve.next_command -= commands_[i];
      valve.next_move -= commands_[i];
      if (valve.close_at_s) *valve.close_at_s -= period_s_;
      valve.filling.since_s -= period_s_;
      valve.venting.since_s -= period_s_;
      if (valve.stroke < 0) continue;
      cycle.end.strokes.push_back(cycle.response.strokes[static_cast<std::size_t>(valve.stroke)]);
      cycle.end.strokes.back().command_s -= period_s_;
      valve.stroke = static_cast<int>(cycle.end.strokes.size()) - 1;
    }
    return run.stiff();
  }

  Rig rig_;
  double period_s_;
  SimulateOptions options_;
  Eigen::VectorXd initial_, sizes_;
  Eigen::Index source_ = -1;
  double limit_pa_ = 0.0;
  std::vector<std::size_t> commands_;  // per group and period
  bool stiff_ = false;
};

// How far the valves are from repeating: difference of opening and of closing time over the period;
// +∞ where they do different things.
double Apart(const Standing& a, const Standing& b, double period_s) {
  constexpr double kApart = std::numeric_limits<double>::infinity();
  if (a.valves.size() != b.valves.size()) return kApart;
  double apart = 0.0;
  for (std::size_t i = 0; i < a.valves.size(); ++i) {
    const ValveProgress<double>&v = a.valves[i], &w = b.valves[i];
    if (v.state != w.state || v.next_move != w.next_move ||
        v.operating_pending != w.operating_pending || v.filling.end != w.filling.end ||
        v.venting.end != w.venting.end || v.close_at_s.has_value() != w.close_at_s.has_value()) {
      return kApart;
    }
    apart = std::max({apart, std::abs(v.filling.At(0.0) - w.filling.At(0.0)),
                      std::abs(v.venting.At(0.0) - w.venting.At(0.0))});
    if (v.close_at_s) apart = std::max(apart, std::abs(*v.close_at_s - *w.close_at_s) / period_s);
  }
  return apart;
}

void KeepWorst(const Stroke& stroke, WorstStrokes& worst) {
  auto& kept = stroke.state == ValveState::kInflate ? worst.rise : worst.fall;
  if (kept && kept->to_target_s >= stroke.to_target_s) return;
  kept = {stroke.to_target_s, stroke.group, stroke.command_s};
}

// The period as it is, its last strokes completed from the one after it.
void Describe(Cycle cycle, const Response& next, double period_s, PeriodicState& result) {
  const std::size_t groups = cycle.response.groups.size();
  std::vector<Stroke>& strokes = cycle.response.strokes;
  std::erase_if(strokes, [](const Stroke& stroke) { return stroke.command_s < 0.0; });
  for (const Stroke& late : next.strokes) {
    if (late.command_s >= 0.0) continue;
    const auto begun = std::find_if(strokes.rbegin(), strokes.rend(),
                                    [&](const Stroke& s) { return s.group == late.group; });
    if (begun == strokes.rend()) continue;
    const double command_s = begun->command_s;
    *begun = late;
    begun->command_s = command_s;
  }
  result.groups.resize(groups);
  for (const Stroke& stroke : strokes) {
    KeepWorst(stroke, result.groups[static_cast<std::size_t>(stroke.group)]);
    KeepWorst(stroke, result.all);
  }
  for (const GroupResponse& group : cycle.response.groups) {
    result.air_drawn_m3 += group.air_drawn_m3;
  }
  result.compressor_duty = cycle.response.compressor_on_s / period_s;
  result.compressor_air_m3 = cycle.response.compressor_air_m3;
  result.compressor_energy_j = cycle.response.compressor_energy_j;
  result.source_lowest_pressure_pa = cycle.response.source_lowest_pressure_pa;
  result.response = std::move(cycle.response);
}

std::string WhyInvalid(const Rig& rig, double period_s, const SimulateOptions& simulate,
                       const PeriodicOptions& options) {
  std::ostringstream why;
  why.precision(12);
  if (!(period_s > 0.0) || !std::isfinite(period_s)) {
    why << "period_s is " << period_s << ", must be above 0 and finite";
  } else if (!(options.tolerance > 0.0)) {
    why << "tolerance is " << options.tolerance << ", must be above 0";
  } else if (options.cycles_max < 1 || options.depth < 0) {
    why << "cycles_max and depth are " << options.cycles_max << " and " << options.depth
        << ", must be at least 1 and 0";
  }
  if (!why.str().empty()) return why.str();
  SimulateOptions one_period = simulate;
  one_period.end_s = period_s;
  std::string reason = WhyInvalid(one_period);
  if (reason.empty()) reason = WhyInvalid(rig);
  if (!reason.empty()) return reason;
  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    for (const ValveCommand& command : rig.groups[i].schedule) {
      if (command.time_s < period_s) continue;
      why << "groups[" << i << "].schedule has a command at " << command.time_s
          << " s, must be below the period of " << period_s << " s";
      return why.str();
    }
    for (const Effect& effect : rig.groups[i].effects) {
      if (effect.spec->id != "valve_delay" || effect.parameters[0] <= kHistoryMax * period_s) {
        continue;
      }
      why << "groups[" << i << "] has a valve_delay of " << effect.parameters[0]
          << " s, must be at most " << kHistoryMax << " periods";
      return why.str();
    }
  }
  return {};
}

PeriodicStatus StatusOf(const Response& response) {
  return response.status == SimulateStatus::kCancelled ? PeriodicStatus::kCancelled
                                                       : PeriodicStatus::kFailed;
}

}  // namespace

PeriodicState FindPeriodicState(const Rig& rig, double period_s, const SimulateOptions& simulate,
                                const PeriodicOptions& options) {
  PeriodicState result;
  result.detail = WhyInvalid(rig, period_s, simulate, options);
  if (!result.detail.empty()) {
    result.status = PeriodicStatus::kInvalid;
    return result;
  }
  Rig one_period = rig;
  for (GroupRig& group : one_period.groups) {
    std::erase_if(group.schedule, [](const ValveCommand& c) { return c.time_s < 0.0; });
  }
  SimulateOptions accurate = simulate;
  accurate.relative_tolerance =
      std::min(simulate.relative_tolerance, kSimulated * options.tolerance);
  CycleMap map(one_period, period_s, accurate);
  Anderson anderson(static_cast<std::size_t>(options.depth));
  const auto finish = [&](PeriodicStatus status, std::string detail) {
    result.status = status;
    result.detail = std::move(detail);
    return std::move(result);
  };

  Standing x = map.Start(), best;  // best: the end of the period with the smallest residual
  double best_residual = std::numeric_limits<double>::infinity();
  bool jumped = false;
  while (result.cycles < options.cycles_max) {
    if (simulate.cancelled && simulate.cancelled()) {
      return finish(PeriodicStatus::kCancelled, "cancelled");
    }
    Cycle cycle = map(x, 0.0);
    ++result.cycles;
    const bool done = cycle.response.status == SimulateStatus::kDone;
    if (!done && (!jumped || cycle.response.status == SimulateStatus::kCancelled)) {
      return finish(StatusOf(cycle.response), cycle.response.detail);
    }
    const Eigen::VectorXd& image = cycle.end.state;
    const Eigen::VectorXd sizes = map.Sizes(image);
    const double residual = LargestShare(image - x.state, sizes);
    if (jumped && !(done && residual <= kGrowth * best_residual)) {
      anderson.Clear();
      x = best;
      jumped = false;
      continue;
    }
    Eigen::VectorXd next = anderson.Next(x.state, image, sizes);
    if (!map.Confine(image, next)) anderson.Clear(), next = image;

    result.residual = std::max(residual, Apart(x, cycle.end, period_s));
    result.error_estimate = LargestShare(next - x.state, sizes);
    const bool converged =
        result.residual <= options.tolerance && result.error_estimate <= options.tolerance;
    // A period that repeats within the simulator's own error is as good as the next, and what it
    // begins with is what comes after it.
    if (std::max(result.residual, result.error_estimate) <= kSimulated * options.tolerance &&
        simulate.sample_hz == 0.0) {
      result.state.assign(x.state.begin(), x.state.end());
      const Response after = cycle.response;
      Describe(std::move(cycle), after, period_s, result);
      return finish(PeriodicStatus::kConverged, "");
    }
    if (!jumped || residual <= best_residual) best = cycle.end, best_residual = residual;
    jumped = next != image;
    x = std::move(cycle.end);
    x.state = next;
    if (!converged) continue;

    Cycle shown = map(x, simulate.sample_hz);
    const Cycle after = map(shown.end, 0.0);
    result.cycles += 2;
    for (const Cycle* last : {&std::as_const(shown), &after}) {
      if (last->response.status != SimulateStatus::kDone) {
        return finish(StatusOf(last->response), last->response.detail);
      }
    }
    result.state.assign(x.state.begin(), x.state.end());
    result.residual = LargestShare(shown.end.state - x.state, sizes);
    Describe(std::move(shown), after.response, period_s, result);
    return finish(PeriodicStatus::kConverged, "");
  }
  result.state.assign(x.state.begin(), x.state.end());
  std::ostringstream detail;
  detail << "residual " << result.residual << " and error estimate " << result.error_estimate
         << " after " << result.cycles << " cycles, must be at most " << options.tolerance;
  return finish(PeriodicStatus::kNotConverged, detail.str());
}

}  // namespace plenum::model
