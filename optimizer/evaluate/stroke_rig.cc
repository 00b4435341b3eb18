#include "optimizer/evaluate/stroke_rig.h"

#include <algorithm>
#include <cmath>

#include "model/flow/series.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {
namespace {

// Closer to equal pressures than the simulator's default, so that a source at the operating
// pressure fills up to it, as the closed forms say.
constexpr double kLinearRatio = 1.0 - 1e-9;

}  // namespace

model::Gas GasOf(Configuration configuration) {
  return configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
}

double FlowMax(const Problem& problem, const Candidate& candidate) {
  const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
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
    if (effect.spec->place != model::EffectPlace::kSupply ||
        configuration != Configuration::kCompressor)
      acting.push_back(effect);
  return acting;
}

model::Rig MakeRig(const Problem& problem, const Candidate& candidate,
                   const OperatingPoint& point) {
  model::Rig rig;
  rig.ambient = problem.ambient;
  rig.gas = GasOf(candidate.configuration);
  const bool open_tank = IsOpenTank(candidate);
  if (open_tank) {
    model::ReservoirSource source;
    source.volume_m3 = TankVolume(problem, candidate);
    source.initial_pressure_pa = LastPeriodPa(problem, candidate, point.source_pa);
    rig.source = source;
  } else if (candidate.configuration == Configuration::kDirectPump) {
    rig.source = model::PumpSource{problem.parts.compressors[candidate.compressor.index].curve,
                                   candidate.compressor.quantity};
  } else if (candidate.configuration != Configuration::kCompressor) {
    rig.source = model::RegulatedSource{point.source_pa,
                                        problem.parts.regulators[candidate.regulator.index].flow,
                                        FlowMax(problem, candidate)};
  } else {
    model::ReservoirSource source;
    source.volume_m3 = point.reservoir_m3;
    source.volume_rising_m3 = point.reservoir_rising_m3;
    source.initial_pressure_pa = point.source_pa;
    source.compressor = problem.parts.compressors[candidate.compressor.index].curve;
    source.compressor_count = candidate.compressor.quantity;
    source.stop_pressure_pa = point.source_pa;
    rig.source = source;
  }
  const int groups = static_cast<int>(problem.groups.size());
  const double period_s = 1.0 / problem.frequency_hz;
  for (int g = 0; g < groups; ++g) {
    const Line& line = *candidate.lines[g];
    model::GroupRig group;
    group.name = problem.groups[g].name;
    group.count = problem.groups[g].count;
    group.chamber = line.chamber;
    group.fill = line.fill;
    group.exhaust = line.exhaust;
    group.close_at_operating = line.holds;
    group.initial_pressure_pa = problem.ambient.pressure_pa;
    group.effects = ActingEffects(problem.groups[g], candidate.configuration);
    const double inflate_s = problem.simultaneous ? 0.0 : period_s * g / groups;
    const double after_s = inflate_s + 0.5 * period_s;
    const double deflate_s = open_tank ? after_s : std::fmod(after_s, period_s);
    group.schedule = {{inflate_s, model::ValveState::kInflate},
                      {deflate_s, model::ValveState::kDeflate}};
    if (deflate_s < inflate_s) std::swap(group.schedule[0], group.schedule[1]);
    rig.groups.push_back(std::move(group));
  }
  return rig;
}

model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point) {
  constexpr double kWithin = 0.9;  // of half of the period
  model::Rig rig = MakeRig(problem, candidate, point);
  const double factor = FlowFactor(problem, GasOf(candidate.configuration));
  for (std::size_t g = 0; g < rig.groups.size(); ++g) {
    const Line& line = *candidate.lines[g];
    const double from_pa = line.holds ? line.chamber.operating_pressure_pa : point.source_pa;
    const double empty_s =
        model::EmptyTime(model::MakeSeries(line.exhaust, factor), line.chamber, from_pa,
                         problem.ambient.pressure_pa, problem.ambient.temperature_k);
    const double wider = std::max(1.0, empty_s / (kWithin * HalfPeriod(problem)));
    for (model::FlowElement& element : rig.groups[g].exhaust)
      element.sonic_conductance_m3_per_s_pa *= wider;
  }
  return rig;
}

model::SimulateOptions StrokeOptions(const Problem& problem) {
  model::SimulateOptions options;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.linear_ratio = kLinearRatio;
  return options;
}

}  // namespace plenum::optimizer
