#include "optimizer/evaluate_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/reservoir_stroke.h"
#include "model/stroke.h"
#include "optimizer/effect_strokes.h"
#include "optimizer/pump_bounds.h"
#include "optimizer/pump_march.h"

namespace plenum::optimizer {
namespace {

// The reservoir repeats from cycle to cycle when its pressure agrees to this.
constexpr double kPeriodicTolerance = 1e-7;
constexpr int kCyclesMax = 300;
// Closer to equal pressures than the simulator's default, so that a source at the operating
// pressure fills up to it, as the closed forms say.
constexpr double kLinearRatio = 1.0 - 1e-5;

bool Regulated(Configuration configuration) { return configuration != Configuration::kCompressor; }

double FlowMax(const Problem& problem, const Candidate& candidate) {
  const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
  return candidate.configuration == Configuration::kMains
             ? std::min(regulator.flow_max_m3_per_s, problem.mains_flow_max_m3_per_s)
             : regulator.flow_max_m3_per_s;
}

// Strokes of one group alone on the regulator.
void RegulatedStroke(const Problem& problem, const Candidate& candidate, double source_pa, int g,
                     Strokes& strokes) {
  const Line& line = *candidate.lines[g];
  const ActuatorGroup& group = problem.groups[g];
  // A regulator shared by n equal lines is, for each of them, one with an n-th of its conductance.
  model::FlowElement share = problem.parts.regulators[candidate.regulator.index].flow;
  share.sonic_conductance_m3_per_s_pa /= group.count;
  std::vector<model::FlowElement> elements{share};
  elements.insert(elements.end(), line.fill.begin(), line.fill.end());
  const model::Series fill =
      model::MakeSeries(elements, FlowFactor(problem, GasOf(candidate.configuration)));
  const double flow_max = FlowMax(problem, candidate) / group.count;
  const auto fill_time = [&](double to_pa) {
    return model::FillTime(fill, line.chamber, source_pa, problem.ambient.pressure_pa, to_pa,
                           problem.ambient.temperature_k, flow_max);
  };
  strokes.rise_s[g] = fill_time(RiseTarget(problem, group));
  strokes.inflate_s[g] = fill_time(group.chamber.operating_pressure_pa);
}

model::ReservoirStrokeInput MakeStrokeInput(const Problem& problem, const Candidate& candidate,
                                            const OperatingPoint& point, int g) {
  model::ReservoirStrokeInput input;
  input.fill = &candidate.lines[g]->fill_table;
  input.chamber = &candidate.lines[g]->chamber;
  input.count = problem.groups[g].count;
  input.compressor = &problem.parts.compressors[candidate.compressor.index].curve;
  input.compressors = candidate.compressor.quantity;
  input.stop_pa = point.source_pa;
  input.volume_falling_m3 = point.reservoir_m3;
  input.volume_rising_m3 = point.reservoir_rising_m3;
  input.from_pa = problem.ambient.pressure_pa;
  input.target_pa = RiseTarget(problem, problem.groups[g]);
  input.operating_pa = problem.groups[g].chamber.operating_pressure_pa;
  input.temperature_k = problem.ambient.temperature_k;
  return input;
}

double RiseLimit(const Problem& problem, int g) {
  return std::min(problem.groups[g].rise_time_max_s, HalfPeriod(problem));
}

// Rise time out of a closed reservoir that holds from the start all that the pumps could add within
// the limit, `delivery_m3_per_s(pressure)` at most: no more than the real one if that is within the
// limit, since the real reservoir is then at every instant no fuller.
template <typename Delivery>
double RiseWithHeadStart(const Problem& problem, int g, const Line& line,
                         const OperatingPoint& point, Delivery&& delivery_m3_per_s) {
  const int count = problem.groups[g].count;
  const double ambient_pa = problem.ambient.pressure_pa;
  const double target_pa = RiseTarget(problem, problem.groups[g]);
  const double temperature_k = problem.ambient.temperature_k;
  const double content_per_volume =
      model::kReferencePressurePa * temperature_k / model::kReferenceTemperatureK;
  const double pumped_m3 = MostPumped(
      problem, point.source_pa, point.reservoir_rising_m3,
      [&](double p) { return MostDrawn(problem, g, line, p, target_pa); }, delivery_m3_per_s,
      RiseLimit(problem, g));
  const double head_start_pa = content_per_volume * pumped_m3 / point.reservoir_rising_m3;
  return model::FillTimeFromReservoir(line.fill_series, line.chamber, count, point.reservoir_m3,
                                      point.source_pa + head_start_pa, ambient_pa, target_pa,
                                      temperature_k);
}

enum class Alone { kYes, kNo, kTooSlow };

// Delivery just below the pressure at which a pump stops.
double LastDelivery(const model::CompressorCurve& curve, double stop_pa) {
  return std::max(0.0, curve.free_air_m3_per_s(std::min(stop_pa, model::HighestPressure(curve))));
}

// A valve that cannot hold leaves its actuators on the source, which fills them from p_op up to the
// stop pressure. Counted as pumped at the stop pressure, the most that it can take.
void AddHeldAir(const Problem& problem, const Candidate& candidate, double stop_pa, int g,
                Strokes& strokes) {
  const model::CompressorCurve& curve = problem.parts.compressors[candidate.compressor.index].curve;
  const model::Chamber& chamber = candidate.lines[g]->chamber;
  const double content =
      model::Content(chamber, stop_pa) - model::Content(chamber, chamber.operating_pressure_pa);
  const double air_m3 =
      problem.groups[g].count * model::StandardVolume(content, problem.ambient.temperature_k);
  const double seconds = air_m3 / (candidate.compressor.quantity * LastDelivery(curve, stop_pa));
  strokes.pump_on_s += seconds;
  strokes.pump_energy_j +=
      seconds * candidate.compressor.quantity * model::ElectricalPower(curve, stop_pa);
}

// Stroke of one group alone on the full reservoir, if that is the whole story: the reservoir is
// full again before another group's stroke, `time_s` later. A single group's own next stroke may
// come too early: the running time then exceeds the period, and the duty refuses this stop
// pressure; a lower one that is reached describes the same periodic state.
Alone ReservoirStroke(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, int g, double time_s, Strokes& strokes) {
  const model::ReservoirStrokeInput input = MakeStrokeInput(problem, candidate, point, g);
  const double limit_s = RiseLimit(problem, g);
  const auto delivery = [&](double pressure_pa) {
    return input.compressors * model::FreeAirDelivery(*input.compressor, pressure_pa);
  };
  if (RiseWithHeadStart(problem, g, *candidate.lines[g], point, delivery) > limit_s)
    return Alone::kTooSlow;
  const model::ReservoirStroke stroke = model::FillFromReservoir(input);
  if (!stroke.reached) return Alone::kTooSlow;
  strokes.rise_s[g] = stroke.rise_s;
  strokes.inflate_s[g] = stroke.inflate_s;
  const double refill_s =
      model::PumpUpTime(*input.compressor, input.compressors, point.reservoir_rising_m3,
                        stroke.reservoir_end_pa, point.source_pa, input.temperature_k);
  const bool last_word = problem.groups.size() == 1;
  if (!last_word && !(stroke.inflate_s + refill_s <= time_s)) return Alone::kNo;
  strokes.pump_on_s += stroke.pump_on_s + refill_s;
  strokes.pump_energy_j +=
      stroke.pump_energy_j + model::EnergyToFill(*input.compressor, point.reservoir_rising_m3,
                                                 stroke.reservoir_end_pa, point.source_pa,
                                                 input.temperature_k);
  if (!candidate.lines[g]->holds) AddHeldAir(problem, candidate, point.source_pa, g, strokes);
  return Alone::kYes;
}

// Where three pressures at the starts of successive cycles lead, if they approach it geometrically
// (Aitken); the last of them where that makes no sense.
double Extrapolate(double first_pa, double second_pa, double third_pa, double stop_pa) {
  const double bend = third_pa - 2.0 * second_pa + first_pa;
  if (bend == 0.0) return third_pa;
  const double limit_pa = first_pa - (second_pa - first_pa) * (second_pa - first_pa) / bend;
  return limit_pa > 0.5 * third_pa && limit_pa <= stop_pa ? limit_pa : third_pa;
}

Strokes EmptyStrokes(const Problem& problem) {
  Strokes strokes;
  strokes.rise_s.assign(problem.groups.size(), model::kNever);
  strokes.inflate_s.assign(problem.groups.size(), model::kNever);
  return strokes;
}

}  // namespace

model::Gas GasOf(Configuration configuration) {
  return configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
}

double AloneExcess(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
                   const OperatingPoint& point) {
  const auto delivery = [&](double pressure_pa) {
    return 1.0 / pumps.seconds_per_m3.At(pressure_pa);
  };
  return RiseWithHeadStart(problem, g, line, point, delivery) / RiseLimit(problem, g) - 1.0;
}

double AloneExcess(const Problem& problem, const std::vector<const Line*>& lines,
                   const PumpFacts& pumps, const OperatingPoint& point) {
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    excess = std::max(excess, AloneExcess(problem, g, *lines[g], pumps, point));
  return excess;
}

double AloneStrokeExcess(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point) {
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const model::ReservoirStroke stroke =
        model::FillFromReservoir(MakeStrokeInput(problem, candidate, point, g));
    if (!stroke.reached) return kUnlimited;
    excess = std::max({excess, stroke.rise_s / RiseLimit(problem, g) - 1.0,
                       stroke.inflate_s / HalfPeriod(problem) - 1.0});
  }
  return excess;
}

Strokes EvaluateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  const int groups = static_cast<int>(problem.groups.size());
  const bool alone = groups == 1 || !problem.simultaneous;
  if (!alone || HasEffects(problem)) return SimulateStrokes(problem, candidate, point);

  Strokes strokes = EmptyStrokes(problem);
  const double time_s = 1.0 / problem.frequency_hz / groups;  // until the next group's command
  for (int g = 0; g < groups; ++g) {
    if (Regulated(candidate.configuration)) {
      RegulatedStroke(problem, candidate, point.source_pa, g, strokes);
      if (groups > 1 && !(strokes.inflate_s[g] <= time_s))
        return SimulateStrokes(problem, candidate, point);
    } else {
      const Alone outcome = ReservoirStroke(problem, candidate, point, g, time_s, strokes);
      if (outcome == Alone::kTooSlow) return EmptyStrokes(problem);
      if (outcome == Alone::kNo) return SimulateStrokes(problem, candidate, point);
    }
  }
  strokes.works = std::all_of(strokes.inflate_s.begin(), strokes.inflate_s.end(),
                              [](double s) { return std::isfinite(s); });
  return strokes;
}

model::Rig MakeRig(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                   double reservoir_pa, const std::vector<double>& pressures_pa, int cycles) {
  model::Rig rig;
  rig.ambient = problem.ambient;
  rig.gas = GasOf(candidate.configuration);
  if (Regulated(candidate.configuration)) {
    rig.source = model::RegulatedSource{point.source_pa,
                                        problem.parts.regulators[candidate.regulator.index].flow,
                                        FlowMax(problem, candidate)};
  } else {
    model::ReservoirSource source;
    source.volume_m3 = point.reservoir_m3;
    source.volume_rising_m3 = point.reservoir_rising_m3;
    source.initial_pressure_pa = reservoir_pa;
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
    group.initial_pressure_pa = pressures_pa[g];
    group.effects = ActingEffects(problem.groups[g], candidate.configuration);
    const double phase = problem.simultaneous ? 0.0 : static_cast<double>(g) / groups;
    // A staggered stroke that began before this cycle is still held at its start.
    if (phase >= 0.5) {
      group.schedule.push_back(
          {0.0, line.holds ? model::ValveState::kHold : model::ValveState::kInflate});
      group.schedule.push_back({(phase - 0.5) * period_s, model::ValveState::kDeflate});
    }
    for (int cycle = 0; cycle < cycles; ++cycle) {
      group.schedule.push_back({(cycle + phase) * period_s, model::ValveState::kInflate});
      group.schedule.push_back({(cycle + phase + 0.5) * period_s, model::ValveState::kDeflate});
    }
    rig.groups.push_back(std::move(group));
  }
  return rig;
}

Strokes SimulateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  if (HasEffects(problem)) return SimulateWithEffects(problem, candidate, point);
  Strokes strokes = EmptyStrokes(problem);
  const double period_s = 1.0 / problem.frequency_hz;
  const std::size_t groups = problem.groups.size();
  std::vector<double> pressures(groups, problem.ambient.pressure_pa);
  double reservoir_pa = point.source_pa;
  model::SimulateOptions options;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.linear_ratio = kLinearRatio;

  // Warm up cycle by cycle until the reservoir repeats; a regulated source has no memory.
  if (!Regulated(candidate.configuration)) {
    options.end_s = period_s;
    std::vector<double> starts;  // of the last cycles, since the last extrapolation
    for (int cycle = 0;; ++cycle) {
      const model::Response response =
          model::Simulate(MakeRig(problem, candidate, point, reservoir_pa, pressures, 1), options);
      if (response.status != model::SimulateStatus::kDone || cycle == kCyclesMax) return strokes;
      starts.push_back(reservoir_pa);
      reservoir_pa = response.source_final_pressure_pa;
      for (std::size_t g = 0; g < groups; ++g) pressures[g] = response.groups[g].final_pressure_pa;
      if (cycle > 0 && std::abs(reservoir_pa - starts.back()) <= kPeriodicTolerance * reservoir_pa)
        break;
      if (starts.size() == 3) {
        reservoir_pa = Extrapolate(starts[1], starts[2], reservoir_pa, point.source_pa);
        starts.clear();
      }
    }
  }
  // Two cycles, so that a stroke that starts late in the first can end in the second.
  options.end_s = 2.0 * period_s;
  const model::Response response =
      model::Simulate(MakeRig(problem, candidate, point, reservoir_pa, pressures, 2), options);
  if (response.status != model::SimulateStatus::kDone) return strokes;
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.state != model::ValveState::kInflate || stroke.command_s >= period_s) continue;
    if (stroke.command_s == 0.0 && !problem.simultaneous && stroke.group > 0) continue;
    strokes.rise_s[stroke.group] = stroke.to_target_s;
    strokes.inflate_s[stroke.group] = stroke.to_operating_s;
  }
  strokes.pump_on_s = 0.5 * response.compressor_on_s;
  strokes.pump_energy_j = 0.5 * response.compressor_energy_j;
  strokes.works = std::all_of(strokes.inflate_s.begin(), strokes.inflate_s.end(),
                              [](double s) { return std::isfinite(s); });
  return strokes;
}

}  // namespace plenum::optimizer
