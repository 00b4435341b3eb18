#include "optimizer/evaluate/strokes/stroke_rig.h"

#include <algorithm>
#include <cmath>

#include "model/flow/series.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

// Closer to equal pressures than the simulator's default, so that a source at the operating
// pressure fills up to it, as the closed forms say.
constexpr double kLinearRatio = 1.0 - 1e-9;

// With the vacuum that it empties into, where pumps keep one.
model::Chamber ChamberAt(const Line& line, const OperatingPoint& point) {
  model::Chamber chamber = line.chamber;
  if (chamber.low_pressure_pa > 0.0 && point.rail_pa > 0.0)
    chamber.exhaust_pressure_pa = point.rail_pa;
  return chamber;
}

}  // namespace

model::Gas GasOf(Configuration configuration) {
  return configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
}

double FlowMax(const Problem& problem, const Candidate& candidate, int group) {
  const model::Regulator& regulator = problem.parts.regulators[RegulatorOf(candidate, group).index];
  return candidate.configuration == Configuration::kMains
             ? std::min(regulator.flow_max_m3_per_s, problem.mains.flow_max_m3_per_s)
             : regulator.flow_max_m3_per_s;
}

bool HasEffects(const Problem& problem) {
  return std::any_of(problem.groups.begin(), problem.groups.end(),
                     [](const ActuatorGroup& group) { return !group.effects.empty(); });
}

std::vector<model::Effect> ActingEffects(const ActuatorGroup& group, Configuration configuration) {
  std::vector<model::Effect> acting;
  for (const model::Effect& effect : group.effects)
    if (effect.spec->place != model::EffectPlace::kSupply || !KeepsReservoir(configuration))
      acting.push_back(effect);
  return acting;
}

std::vector<Together> TogetherOf(const Problem& problem, const Candidate& candidate) {
  const int groups = static_cast<int>(problem.groups.size());
  const bool own_pumps =
      IsDirect(candidate.configuration) && problem.pump_feed != PumpFeed::kShared;
  if (!HasOwnRegulators(candidate) && !own_pumps) return {{0, groups}};
  const bool each_actuator = own_pumps && problem.pump_feed == PumpFeed::kPerActuator;
  std::vector<Together> each;
  each.reserve(problem.groups.size());
  for (int g = 0; g < groups; ++g)
    each.push_back({g, g + 1, each_actuator ? problem.groups[g].count : 1});
  return each;
}

std::vector<Squad> SquadsOf(const Problem& problem, const Together& together) {
  std::vector<Squad> squads = SquadsOf(problem);
  std::erase_if(squads, [&](const Squad& squad) { return !together.Has(squad.group); });
  return squads;
}

model::Rig MakeRig(const Problem& problem, const Candidate& candidate,
                   const OperatingPoint& point) {
  return MakeRig(problem, candidate, point, TogetherOf(problem, candidate).front());
}

model::Rig MakeRig(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                   const Together& together) {
  const int first = together.first;
  model::Rig rig;
  rig.ambient = problem.ambient;
  rig.gas = GasOf(candidate.configuration);
  const bool open_tank = IsOpenTank(candidate);
  if (open_tank) {
    model::ReservoirSource source;
    source.volume_m3 = TankVolume(problem, candidate);
    source.initial_pressure_pa = LastPeriodPa(problem, candidate, point.source_pa);
    rig.source = source;
  } else if (IsDirect(candidate.configuration)) {
    rig.source =
        model::PumpSource{ChosenPump(problem, candidate).curve, candidate.compressor.quantity};
  } else if (!KeepsReservoir(candidate.configuration)) {
    rig.source =
        model::RegulatedSource{PressureOf(point, first),
                               problem.parts.regulators[RegulatorOf(candidate, first).index].flow,
                               FlowMax(problem, candidate, first)};
  } else {
    model::ReservoirSource source;
    source.volume_m3 = point.reservoir_m3;
    source.volume_rising_m3 = point.reservoir_rising_m3;
    source.initial_pressure_pa = point.source_pa;
    source.compressor = ChosenPump(problem, candidate).curve;
    source.compressor_count = candidate.compressor.quantity;
    source.stop_pressure_pa = point.source_pa;
    rig.source = source;
  }
  const double period_s = 1.0 / problem.frequency_hz;
  const std::vector<Squad> squads = SquadsOf(problem, together);
  for (const auto& [g, count, phase] : squads) {
    const Line& line = *candidate.lines[g];
    model::GroupRig& group = rig.groups.emplace_back();
    group.name = problem.groups[g].name;
    group.count = count / together.feeds;
    group.chamber = ChamberAt(line, point);
    group.fill = line.fill;
    group.exhaust = line.exhaust;
    group.close_at_operating = line.holds;
    group.close_at_low = line.chamber.low_pressure_pa > 0.0;
    group.initial_pressure_pa = model::RestPa(line.chamber);
    group.effects = ActingEffects(problem.groups[g], candidate.configuration);
  }
  for (const auto& [at, squad] : BeginsOf(problem, squads)) {
    const double inflate_s = at * period_s;
    const double after_s = inflate_s + InflateWindow(problem, squads[squad].group);
    std::vector<model::ValveCommand>& schedule = rig.groups[squad].schedule;
    schedule.push_back({inflate_s, model::ValveState::kInflate});
    schedule.push_back(
        {open_tank ? after_s : std::fmod(after_s, period_s), model::ValveState::kDeflate});
  }
  for (model::GroupRig& group : rig.groups)
    std::sort(group.schedule.begin(), group.schedule.end(),
              [](const model::ValveCommand& a, const model::ValveCommand& b) {
                return a.time_s < b.time_s;
              });
  return rig;
}

model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point) {
  return MakePeriodicRig(problem, candidate, point, TogetherOf(problem, candidate).front());
}

model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point, const Together& together) {
  constexpr double kWithin = 0.9;  // of the window
  model::Rig rig = MakeRig(problem, candidate, point, together);
  const double factor = FlowFactor(problem, GasOf(candidate.configuration));
  const std::vector<Squad> squads = SquadsOf(problem, together);
  for (std::size_t s = 0; s < squads.size(); ++s) {
    const int g = squads[s].group;
    const Line& line = *candidate.lines[g];
    const double from_pa = line.holds ? line.chamber.operating_pressure_pa : PressureOf(point, g);
    const double empty_s =
        model::EmptyTime(model::MakeSeries(line.exhaust, factor), rig.groups[s].chamber, from_pa,
                         model::RestPa(line.chamber), problem.ambient.temperature_k);
    const double wider = std::max(1.0, empty_s / (kWithin * DeflateWindow(problem, g)));
    model::GroupRig& group = rig.groups[s];
    for (model::FlowElement& element : group.exhaust)
      element.sonic_conductance_m3_per_s_pa *= wider;
    // Full since the period before: from empty it would draw beside those whose turn it is.
    if (line.holds && !group.schedule.empty() &&
        group.schedule.back().state == model::ValveState::kInflate)
      group.initial_pressure_pa = line.chamber.operating_pressure_pa;
  }
  return rig;
}

void BeginWhereItEnded(const model::Response& ended, double period_s, model::Rig& rig) {
  for (std::size_t g = 0; g < rig.groups.size(); ++g) {
    model::GroupRig& group = rig.groups[g];
    group.initial_pressure_pa = ended.groups[g].final_pressure_pa;
    const model::ValveCommand last = group.schedule.back();
    group.schedule.insert(group.schedule.begin(), {last.time_s - period_s, last.state});
  }
  auto* reservoir = std::get_if<model::ReservoirSource>(&rig.source);
  if (reservoir && std::isfinite(reservoir->stop_pressure_pa))
    reservoir->initial_pressure_pa = ended.source_final_pressure_pa;
}

Strokes ToBeKept(const Problem& problem) {
  Strokes strokes;
  strokes.rise_s.assign(problem.groups.size(), 0.0);
  strokes.inflate_s = strokes.rise_s;
  for (const ActuatorGroup& group : problem.groups)
    strokes.filled_pa.push_back(group.chamber.operating_pressure_pa);
  return strokes;
}

bool AllReached(const Strokes& strokes) {
  return std::all_of(strokes.inflate_s.begin(), strokes.inflate_s.end(),
                     [](double s) { return std::isfinite(s); });
}

model::SimulateOptions StrokeOptions(const Problem& problem) {
  model::SimulateOptions options;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.linear_ratio = kLinearRatio;
  return options;
}

}  // namespace plenum::optimizer
