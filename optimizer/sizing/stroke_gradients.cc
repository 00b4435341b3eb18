#include "optimizer/sizing/stroke_gradients.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "model/simulate/sensitivity.h"

namespace plenum::optimizer {
namespace {

using model::Dual;

constexpr double kFull = 1.0 - 1e-9;  // of the stop pressure
constexpr double kRoom = 1.01;        // of a time, so that its end is seen

StrokesOf<Dual> Lifted(const Strokes& strokes) {
  StrokesOf<Dual> lifted;
  lifted.works = strokes.works;
  lifted.from_full = strokes.from_full;
  for (double seconds : strokes.rise_s) lifted.rise_s.emplace_back(seconds);
  for (double seconds : strokes.inflate_s) lifted.inflate_s.emplace_back(seconds);
  for (double pressure_pa : strokes.filled_pa) lifted.filled_pa.emplace_back(pressure_pa);
  lifted.pump_on_s = Dual(strokes.pump_on_s);
  lifted.pump_energy_j = Dual(strokes.pump_energy_j);
  lifted.pump_air_m3 = Dual(strokes.pump_air_m3);
  return lifted;
}

model::ReservoirSource& Reservoir(model::Rig& rig) {
  model::ReservoirSource& source = std::get<model::ReservoirSource>(rig.source);
  source.volume_rising_m3 = 0.0;  // the same volume
  return source;
}

// Dual numbers stay with explicit steps: at a tolerance that keeps the derivatives of stiff ends of
// strokes, and not so close to equal pressures that rounding takes them over.
model::SimulateOptions DualOptions(const Problem& problem, const Candidate& candidate) {
  model::SimulateOptions options = StrokeOptions(problem);
  options.relative_tolerance = 1e-9;
  options.linear_ratio = 1.0 - 1e-6;
  options.cancelled = [&] { return candidate.stopped(); };
  return options;
}

// What the pumps do, so many times what they do in a run.
void AddPumps(const model::Response& derivative, double times, double weight, int direction,
              StrokesOf<Dual>& strokes) {
  const double factor = times * weight;
  strokes.pump_on_s.v[direction] += factor * derivative.compressor_on_s;
  strokes.pump_energy_j.v[direction] += factor * derivative.compressor_energy_j;
  strokes.pump_air_m3.v[direction] += factor * derivative.compressor_air_m3;
}

// A squad alone on the full reservoir, until it is full again.
bool AddAlone(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
              int squad, const Strokes& values, StrokesOf<Dual>& strokes) {
  model::Rig rig = MakeRig(problem, candidate, point);
  rig.groups = {rig.groups[squad]};
  const int g = SquadsOf(problem)[squad].group;
  const double strokes_per_period = problem.groups[g].gait.strokes_per_period;
  const bool slowest = rig.groups[0].count == FilledAtOnce(problem, g);
  const bool holds = candidate.lines[g]->holds;
  const double open_s = holds ? values.inflate_s[g] : InflateWindow(problem, g);
  rig.groups[0].schedule = {{0.0, model::ValveState::kInflate}};
  if (!holds) rig.groups[0].schedule.push_back({open_s, model::ValveState::kDeflate});
  model::ReservoirSource& source = Reservoir(rig);
  model::SimulateOptions options = DualOptions(problem, candidate);
  options.end_s = kRoom * (open_s + values.pump_on_s);
  const std::vector<model::Direction> directions{
      {{&source.initial_pressure_pa, 1.0}, {&source.stop_pressure_pa, 1.0}},
      {{&source.volume_m3, 1.0}}};
  const model::SensitivityResponse run = SimulateAlongDirections(rig, options, directions);
  if (run.response.status != model::SimulateStatus::kDone) return false;
  for (int j : {kAlongPressure, kAlongVolume}) {
    const model::Stroke& stroke = run.derivatives[j].strokes.front();
    if (slowest) {
      strokes.rise_s[g].v[j] = stroke.to_target_s;
      strokes.inflate_s[g].v[j] = stroke.to_operating_s;
    }
    AddPumps(run.derivatives[j], strokes_per_period, 1.0, j, strokes);
  }
  return true;
}

// Two periods from the periodic state, valves as the period before left them.
std::optional<model::Rig> RigInPeriodicState(const Problem& problem, const Candidate& candidate,
                                             const OperatingPoint& point) {
  const double period_s = 1.0 / problem.frequency_hz;
  model::Rig rig = MakePeriodicRig(problem, candidate, point);
  model::SimulateOptions options = StrokeOptions(problem);
  const Workbench own;
  const Workbench& bench = candidate.bench != nullptr ? *candidate.bench : own;
  options.cancelled = bench.stop;
  const model::PeriodicState state = bench.periodic(rig, period_s, options, {});
  if (state.status != model::PeriodicStatus::kConverged) return std::nullopt;
  std::vector<std::vector<model::ValveCommand>> periods;
  periods.reserve(rig.groups.size());
  for (const model::GroupRig& group : rig.groups) periods.push_back(group.schedule);
  BeginWhereItEnded(state.response, period_s, rig);
  for (std::size_t g = 0; g < rig.groups.size(); ++g)
    for (const model::ValveCommand& command : periods[g])
      rig.groups[g].schedule.push_back({command.time_s + period_s, command.state});
  return rig;
}

bool AddTogether(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                 StrokesOf<Dual>& strokes) {
  std::optional<model::Rig> rig = RigInPeriodicState(problem, candidate, point);
  if (!rig) return false;
  model::ReservoirSource& source = Reservoir(*rig);
  const bool full = source.initial_pressure_pa >= kFull * source.stop_pressure_pa;
  std::vector<model::Direction> directions{{{&source.stop_pressure_pa, 1.0}},
                                           {{&source.volume_m3, 1.0}}};
  if (full) directions[kAlongPressure].push_back({&source.initial_pressure_pa, 1.0});
  for (const model::GroupRig& group : rig->groups)
    directions.push_back({{&group.initial_pressure_pa, 1.0}});
  if (!full) directions.push_back({{&source.initial_pressure_pa, 1.0}});

  const double period_s = 1.0 / problem.frequency_hz;
  model::SimulateOptions options = DualOptions(problem, candidate);
  options.end_s = 2.0 * period_s;
  const model::SensitivityResponse run = SimulateAlongDirections(*rig, options, directions);
  if (run.response.status != model::SimulateStatus::kDone) return false;

  // How the state at the start moves with the two parameters.
  const int groups = static_cast<int>(rig->groups.size());
  const int states = static_cast<int>(directions.size()) - 2;
  Eigen::MatrixXd after(states, directions.size());
  for (std::size_t j = 0; j < directions.size(); ++j)
    for (int i = 0; i < states; ++i)
      after(i, static_cast<int>(j)) = i < groups ? run.derivatives[j].groups[i].final_pressure_pa
                                                 : run.derivatives[j].source_final_pressure_pa;
  const Eigen::MatrixXd moved =
      (Eigen::MatrixXd::Identity(states, states) - after.rightCols(states))
          .partialPivLu()
          .solve(after.leftCols(2));
  if (!moved.allFinite()) return false;
  for (int j : {kAlongPressure, kAlongVolume}) {
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double weight =
          k < 2 ? (static_cast<int>(k) == j ? 1.0 : 0.0) : moved(static_cast<int>(k) - 2, j);
      const model::Response& derivative = run.derivatives[k];
      AddPumps(derivative, 0.5, weight, j, strokes);
      for (std::size_t s = 0; s < derivative.strokes.size(); ++s) {
        const model::Stroke& stroke = run.response.strokes[s];
        if (stroke.state != model::ValveState::kInflate || !(stroke.command_s < period_s)) continue;
        strokes.rise_s[stroke.group].v[j] += weight * derivative.strokes[s].to_target_s;
        strokes.inflate_s[stroke.group].v[j] += weight * derivative.strokes[s].to_operating_s;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<StrokesOf<Dual>> DifferentiateStrokes(const Problem& problem,
                                                    const Candidate& candidate,
                                                    const OperatingPoint& point,
                                                    const Strokes& strokes) {
  StrokesOf<Dual> lifted = Lifted(strokes);
  if (StrokesMeet(problem) || !strokes.from_full) {
    // A group's slowest stroke is then that of any squad.
    if (SquadsOf(problem).size() > problem.groups.size() ||
        std::any_of(problem.groups.begin(), problem.groups.end(),
                    [](const ActuatorGroup& group) { return group.gait.strokes_per_period > 1; }))
      return std::nullopt;
    if (!AddTogether(problem, candidate, point, lifted)) return std::nullopt;
    return lifted;
  }
  for (int s = 0; s < static_cast<int>(SquadsOf(problem).size()); ++s)
    if (!AddAlone(problem, candidate, point, s, strokes, lifted)) return std::nullopt;
  return lifted;
}

}  // namespace plenum::optimizer
