#include "optimizer/evaluate/strokes/effect_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/simulate/periodic.h"
#include "model/strokes/stroke.h"

namespace plenum::optimizer {
namespace {

constexpr double kPeriodicTolerance = 1e-5;
constexpr int kSearchedCycles = 60;  // for the periodic state
constexpr int kPlainCycles = 40;     // without one
constexpr double kSamplesPerCycle = 200.0;

Strokes NoStrokes(std::size_t groups) {
  Strokes strokes;
  strokes.rise_s = strokes.inflate_s = strokes.fall_s = std::vector<double>(groups, model::kNever);
  strokes.highest_pa.assign(groups, 0.0);
  return strokes;
}

// Worst of the strokes commanded from `from_s` on, before `until_s`.
void TakeWorst(const model::Response& response, const std::vector<Squad>& squads, double from_s,
               double until_s, Strokes& strokes) {
  const std::size_t groups = strokes.rise_s.size();
  std::vector<bool> rises(groups, false), falls(groups, false);
  const auto take = [](std::vector<bool>& seen, int g, double& worst, double time_s) {
    worst = seen[g] ? std::max(worst, time_s) : time_s;
  };
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.command_s < from_s || !(stroke.command_s < until_s)) continue;
    const int g = squads[stroke.group].group;
    if (stroke.state == model::ValveState::kInflate) {
      take(rises, g, strokes.rise_s[g], stroke.to_target_s);
      take(rises, g, strokes.inflate_s[g], stroke.to_operating_s);
      rises[g] = true;
    } else if (stroke.state == model::ValveState::kDeflate) {
      take(falls, g, strokes.fall_s[g], stroke.to_target_s);
      falls[g] = true;
    }
  }
}

void TakeHighest(const model::Response& response, const std::vector<Squad>& squads, double from_s,
                 Strokes& strokes) {
  for (std::size_t s = 0; s < squads.size(); ++s) {
    double& highest_pa = strokes.highest_pa[squads[s].group];
    for (std::size_t i = 0; i < response.t_s.size(); ++i)
      if (response.t_s[i] >= from_s)
        highest_pa = std::max(highest_pa, response.groups[s].pressure_pa[i]);
  }
}

// The commands of one period, `cycles` times.
void Repeat(model::Rig& rig, double period_s, int cycles) {
  for (model::GroupRig& group : rig.groups) {
    const std::vector<model::ValveCommand> once = group.schedule;
    for (int cycle = 1; cycle < cycles; ++cycle)
      for (const model::ValveCommand& command : once)
        group.schedule.push_back({command.time_s + cycle * period_s, command.state});
  }
}

bool AllFinite(const std::vector<double>& times) {
  return std::all_of(times.begin(), times.end(), [](double s) { return std::isfinite(s); });
}

}  // namespace

Strokes SimulateWithEffects(const Problem& problem, const Candidate& candidate,
                            const OperatingPoint& point) {
  const std::size_t groups = problem.groups.size();
  const double period_s = 1.0 / problem.frequency_hz;
  model::Rig rig = MakeRig(problem, candidate, point);
  model::SimulateOptions options;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.relative_tolerance = 0.1 * kPeriodicTolerance;
  options.sample_hz = kSamplesPerCycle * problem.frequency_hz;
  if (candidate.bench != nullptr) options.cancelled = candidate.bench->stop;

  const std::vector<Squad> squads = SquadsOf(problem);
  Strokes strokes = NoStrokes(groups);
  const model::PeriodicState periodic = model::FindPeriodicState(
      rig, period_s, options, {.tolerance = kPeriodicTolerance, .cycles_max = kSearchedCycles});
  if (periodic.status == model::PeriodicStatus::kConverged) {
    TakeWorst(periodic.response, squads, 0.0, period_s, strokes);
    TakeHighest(periodic.response, squads, 0.0, strokes);
    strokes.pump_on_s = periodic.compressor_duty * period_s;
    strokes.pump_energy_j = periodic.compressor_energy_j;
    strokes.air_m3 = periodic.air_drawn_m3;
  } else {
    options.end_s = (kPlainCycles + 1) * period_s;  // one more, so that the last strokes can end
    Repeat(rig, period_s, kPlainCycles + 1);
    const model::Response response = model::Simulate(rig, options);
    strokes.failed = response.status != model::SimulateStatus::kDone;
    if (strokes.failed) return strokes;
    const double cycles = kPlainCycles + 1.0;
    TakeWorst(response, squads, 0.5 * kPlainCycles * period_s, kPlainCycles * period_s, strokes);
    TakeHighest(response, squads, 0.5 * kPlainCycles * period_s, strokes);
    strokes.pump_on_s = response.compressor_on_s / cycles;
    strokes.pump_energy_j = response.compressor_energy_j / cycles;
    for (const model::GroupResponse& group : response.groups)
      strokes.air_m3 += group.air_drawn_m3 / cycles;
  }
  strokes.works = AllFinite(strokes.inflate_s) && AllFinite(strokes.fall_s);
  return strokes;
}

}  // namespace plenum::optimizer
