#include "optimizer/evaluate/strokes/evaluate_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "model/simulate/periodic.h"
#include "model/strokes/reservoir_stroke.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/effect_strokes.h"
#include "optimizer/evaluate/strokes/shared_filling.h"
#include "optimizer/evaluate/strokes/turn_strokes.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

constexpr double kPeriodicTolerance = 1e-7;
constexpr double kFilledTolerance = 1e-10;  // of a pressure

// Whether the line stands open for half of the period, and its worst counts.
bool OpenAtWorst(const Problem& problem, const Candidate& candidate, const Line& line) {
  return problem.guarantee && !candidate.at_best && !line.holds;
}

// Strokes of one squad alone on the regulator, and how long it draws.
double RegulatedStroke(const Problem& problem, const Candidate& candidate, double source_pa,
                       const Squad& squad, Strokes& strokes) {
  const int g = squad.group;
  const Line& line = *candidate.lines[g];
  const ActuatorGroup& group = problem.groups[g];
  // A regulator shared by n equal lines is, for each of them, one with an n-th of its conductance.
  model::FlowElement share = problem.parts.regulators[RegulatorOf(candidate, g).index].flow;
  share.sonic_conductance_m3_per_s_pa /= squad.count;
  std::vector<model::FlowElement> elements{share};
  elements.insert(elements.end(), line.fill.begin(), line.fill.end());
  const model::Series fill =
      model::MakeSeries(elements, FlowFactor(problem, GasOf(candidate.configuration)));
  const double flow_max = FlowMax(problem, candidate, g) / squad.count;
  const auto fill_time = [&](double to_pa) {
    return model::FillTime(fill, line.chamber, source_pa, model::RestPa(line.chamber), to_pa,
                           problem.ambient.temperature_k, flow_max);
  };
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double inflate_s = fill_time(operating_pa), open_s = InflateWindow(problem, g);
  Keep(strokes.rise_s[g], fill_time(RiseTarget(problem, group)));
  Keep(strokes.inflate_s[g], inflate_s);
  if (line.holds || !(inflate_s < open_s)) return inflate_s;
  if (OpenAtWorst(problem, candidate, line)) {
    strokes.filled_pa[g] = source_pa;
    return open_s;
  }
  const auto left_s = [&](double to_pa) { return open_s - fill_time(to_pa); };
  const double full_left_s = left_s(source_pa);
  Keep(strokes.filled_pa[g], full_left_s >= 0.0
                                 ? source_pa
                                 : NarrowBracket(left_s, operating_pa, open_s - inflate_s,
                                                 source_pa, full_left_s, kFilledTolerance)
                                       .low);
  return open_s - std::max(0.0, full_left_s);
}

// What is simulated together, in its periodic state; false where the simulator did not get there.
bool SimulateTogether(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, const Together& together, Strokes& strokes) {
  const Workbench own;
  const Workbench& bench = candidate.bench != nullptr ? *candidate.bench : own;
  const model::Rig rig = MakePeriodicRig(problem, candidate, point, together);
  model::SimulateOptions options = StrokeOptions(problem);
  options.cancelled = bench.stop;
  const model::PeriodicState state =
      bench.periodic(rig, 1.0 / problem.frequency_hz, options, {.tolerance = kPeriodicTolerance});
  strokes.failed = state.status != model::PeriodicStatus::kConverged;
  if (strokes.failed) return false;
  const std::vector<Squad> squads = SquadsOf(problem, together);
  for (const model::Stroke& stroke : state.response.strokes) {
    const int g = squads[stroke.group].group;
    if (stroke.state == model::ValveState::kInflate) {
      Keep(strokes.rise_s[g], stroke.to_target_s);
      Keep(strokes.inflate_s[g], stroke.to_operating_s);
    } else if (stroke.state == model::ValveState::kDeflate && !candidate.lines[g]->holds) {
      Keep(strokes.filled_pa[g], stroke.start_pressure_pa);
    }
  }
  // Of several feeds the pumps that run longest count.
  strokes.pump_on_s = std::max(strokes.pump_on_s, state.response.compressor_on_s);
  strokes.pump_energy_j += together.feeds * state.response.compressor_energy_j;
  strokes.pump_air_m3 += together.feeds * state.response.compressor_air_m3;
  return true;
}

enum class Alone { kYes, kNo, kTooSlow };

// Pressure at which a reservoir of `volume_m3` at the stop pressure and empty chambers come to
// rest, with so much air (Pa·m³) added.
double Equalised(const model::ReservoirStrokeInput& input, double volume_m3, double added) {
  const double held = volume_m3 * input.stop_pa + added +
                      input.count * model::Content(*input.chamber, input.from_pa);
  const auto room = [&](double p) {
    return held - volume_m3 * p - input.count * model::Content(*input.chamber, p);
  };
  if (room(input.stop_pa) >= 0.0) return input.stop_pa;
  return NarrowBracket(room, input.from_pa, room(input.from_pa), input.stop_pa, room(input.stop_pa),
                       kFilledTolerance)
      .high;
}

// The same of a line that stands open and passes any more than this one does, at most. Chambers
// never hold more than at rest with the reservoir, which never falls below where it comes to rest
// without pumps. With a line that passes more, chamber and pumped air are ahead at each time (where
// contents are equal the reservoir holds no less, where the pumped air is equal it holds no more,
// and pumps deliver more into less). So pumps run no longer than for the least stroke, and then for
// the rest of the air against the stop pressure; their power is the most below it. Pumps that
// deliver more run no longer: of what they deliver more while the line is open the chamber takes a
// part at most, and the rest is the sooner pumped.
Pumped OpenPumped(const Problem& problem, const model::ReservoirStrokeInput& input,
                  const Pumped& least) {
  const model::CompressorCurve& curve = *input.compressor;
  const double unit_m3 = model::StandardVolume(1.0, input.temperature_k);
  const double lowest_pa = Equalised(input, input.volume_falling_m3, 0.0);
  const double pumped_m3 =
      input.compressors * model::FreeAirDelivery(curve, lowest_pa) * input.open_s;
  const double filled_pa =
      std::max(least.filled_pa, Equalised(input, input.volume_rising_m3, pumped_m3 / unit_m3));
  const double rest_m3 = input.count *
                         (model::Content(*input.chamber, filled_pa) -
                          model::Content(*input.chamber, least.filled_pa)) *
                         unit_m3;
  const double on_s =
      least.on_s + rest_m3 / (input.compressors * model::FreeAirDelivery(curve, input.stop_pa));
  const double power_w =
      curve.voltage_v * model::LargestCurrent(curve, problem.ambient.pressure_pa, input.stop_pa);
  return {filled_pa, on_s, on_s * input.compressors * power_w, least.air_m3 + rest_m3};
}

// Strokes of one squad alone on the full reservoir, if that is the whole story: the reservoir is
// full again before another stroke, `time_s` later. Of bursts the next one may come too early: the
// running time then exceeds the period, and the duty refuses this stop pressure; a lower one that
// is reached describes the same periodic state.
Alone ReservoirStroke(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, int g, int count, double time_s,
                      Strokes& strokes) {
  const double strokes_per_period = problem.groups[g].gait.strokes_per_period;
  const model::ReservoirStrokeInput input =
      MakeStrokeInput(problem, candidate, point, g, count, point.source_pa);
  const model::ReservoirStroke stroke = model::FillFromReservoir(input);
  if (!stroke.reached) return Alone::kTooSlow;
  Keep(strokes.rise_s[g], stroke.rise_s);
  Keep(strokes.inflate_s[g], stroke.inflate_s);
  const double refill_s =
      model::PumpUpTime(*input.compressor, input.compressors, point.reservoir_rising_m3,
                        stroke.reservoir_end_pa, point.source_pa, input.temperature_k);
  Pumped pumped = PumpedFor(input, stroke, point.source_pa, refill_s);
  double over_s = std::max(stroke.inflate_s, input.open_s) + refill_s;
  if (OpenAtWorst(problem, candidate, *candidate.lines[g])) {
    const Pumped most = OpenPumped(problem, input, pumped);
    over_s += most.on_s - pumped.on_s;
    pumped = most;
  }
  if (!IsBurst(problem) && !(over_s <= time_s)) return Alone::kNo;
  Keep(strokes.filled_pa[g], pumped.filled_pa);
  strokes.pump_on_s += strokes_per_period * pumped.on_s;
  strokes.pump_energy_j += strokes_per_period * pumped.energy_j;
  strokes.pump_air_m3 += strokes_per_period * pumped.air_m3;
  return Alone::kYes;
}

Strokes NeverFilled(const Problem& problem) {
  Strokes strokes = ToBeKept(problem);
  strokes.rise_s.assign(problem.groups.size(), model::kNever);
  strokes.inflate_s = strokes.rise_s;
  return strokes;
}

// Whether all chambers, whatever their group, fill in the same way.
bool FillAlike(const Candidate& candidate) {
  const Line& first = *candidate.lines[0];
  for (std::size_t g = 1; g < candidate.lines.size(); ++g) {
    const Line& line = *candidate.lines[g];
    if (!(line.fill == first.fill && line.chamber == first.chamber && line.holds == first.holds))
      return false;
  }
  return true;
}

// Groups whose chambers fill alike and at once are one group to the reservoir.
Strokes StrokesAlike(const Problem& problem, const Candidate& candidate,
                     const OperatingPoint& point) {
  int count = 0;
  for (const ActuatorGroup& group : problem.groups) count += group.count;
  Strokes strokes = ToBeKept(problem);
  if (ReservoirStroke(problem, candidate, point, 0, count, 1.0 / problem.frequency_hz, strokes) !=
      Alone::kYes)
    return NeverFilled(problem);
  std::fill(strokes.rise_s.begin(), strokes.rise_s.end(), strokes.rise_s[0]);
  std::fill(strokes.inflate_s.begin(), strokes.inflate_s.end(), strokes.inflate_s[0]);
  std::fill(strokes.filled_pa.begin(), strokes.filled_pa.end(), strokes.filled_pa[0]);
  strokes.from_full = true;
  strokes.works = std::isfinite(strokes.inflate_s[0]);
  return strokes;
}

// Strokes that may draw at once, each integrated with the others.
Strokes StrokesTogether(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  const bool pumped = KeepsReservoir(candidate.configuration);
  std::optional<Strokes> strokes = pumped ? StrokesAtOnce(problem, candidate, point)
                                          : FillTogether(problem, candidate, point.source_pa);
  if (strokes && (!strokes->failed || candidate.stopped())) return *std::move(strokes);
  return SimulateStrokes(problem, candidate, point);
}

// Strokes that do not all find the reservoir full.
Strokes StrokesPartlyFull(const Problem& problem, const Candidate& candidate,
                          const OperatingPoint& point) {
  std::optional<Strokes> strokes = StrokesInTurns(problem, candidate, point);
  return strokes ? *std::move(strokes) : SimulateStrokes(problem, candidate, point);
}

Strokes StrokesOfOwn(const Problem& problem, const Candidate& candidate,
                     const OperatingPoint& point) {
  Strokes strokes = ToBeKept(problem);
  strokes.from_full = true;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (!StrokesOfGroup(problem, candidate, point, g, strokes)) return strokes;
  strokes.works = AllReached(strokes);
  return strokes;
}

// One squad after another, straight from the pumps; none works that is not full before its turn is
// over.
Strokes DirectStrokes(const Problem& problem, const Candidate& candidate) {
  Strokes strokes = ToBeKept(problem);
  strokes.works = true;
  std::vector<double> on_s(problem.groups.size(), 0.0);  // of each feed of its own pumps
  for (const FedSquad& fed : FedSquadsOf(problem)) {
    const int g = fed.squad.group;
    const double strokes_per_period = problem.groups[g].gait.strokes_per_period;
    const model::PumpStroke stroke = DirectStroke(problem, candidate, g, fed.count);
    if (!stroke.reached) return NeverFilled(problem);
    Keep(strokes.rise_s[g], stroke.rise_s);
    Keep(strokes.inflate_s[g], stroke.inflate_s);
    const double filling_s = strokes_per_period * stroke.inflate_s;
    on_s[fed.feed] += fed.Seconds(PumpsHoldOn(problem), filling_s);
    strokes.pump_energy_j += fed.feeds * (strokes_per_period * stroke.pump_energy_j +
                                          HoldingEnergy(problem, candidate, fed, filling_s));
    strokes.pump_air_m3 += strokes_per_period * fed.squad.count / problem.groups[g].count *
                           LeastAirPerStroke(problem, g, *candidate.lines[g]);
    strokes.works = strokes.works && stroke.inflate_s <= fed.turn_s;
  }
  strokes.pump_on_s = *std::max_element(on_s.begin(), on_s.end());
  return strokes;
}

// The last period of a mission out of a tank without a regulator: one quadrature a group where no
// two draw at once, else one simulation.
Strokes OpenTankStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  const int groups = static_cast<int>(problem.groups.size());
  const bool alike = MeetingOf(problem) == Meeting::kTogether && FillAlike(candidate);
  const bool plain =
      std::all_of(problem.groups.begin(), problem.groups.end(), [](const ActuatorGroup& group) {
        return group.gait.phases.empty() && group.gait.strokes_per_period == 1;
      });
  if ((StrokesMeet(problem) && !alike) || !plain) return SimulateStrokes(problem, candidate, point);
  int together = 0;
  for (const ActuatorGroup& group : problem.groups) together += group.count;
  double tank_pa = LastPeriodPa(problem, candidate, point.source_pa);
  Strokes strokes = NeverFilled(problem);
  const double factor = FlowFactor(problem, model::Gas::kAir);
  const double turn_s = 1.0 / problem.frequency_hz / groups;
  for (int g = 0; g < groups; ++g) {
    const Line& line = *candidate.lines[g];
    const model::Series fill = model::MakeSeries(line.fill, factor);
    const auto seconds = [&](double to_pa) {
      return model::FillTimeFromReservoir(
          fill, line.chamber, alike ? together : problem.groups[g].count, point.reservoir_m3,
          tank_pa, problem.ambient.pressure_pa, to_pa, problem.ambient.temperature_k);
    };
    strokes.rise_s[g] = seconds(RiseTarget(problem, problem.groups[g]));
    strokes.inflate_s[g] = seconds(line.chamber.operating_pressure_pa);
    if (alike) continue;
    if (g + 1 < groups && !(strokes.inflate_s[g] <= turn_s))
      return SimulateStrokes(problem, candidate, point);
    tank_pa -= TankFallPa(problem, candidate, LeastAirPerStroke(problem, g, line));
  }
  strokes.works = AllReached(strokes);
  return strokes;
}

// The same by the simulator.
Strokes SimulateOpenTank(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point, const std::function<bool()>& stop) {
  Strokes strokes = ToBeKept(problem);
  model::SimulateOptions options = StrokeOptions(problem);
  options.end_s = 2.0 / problem.frequency_hz;  // the latest command is to deflate, before that
  options.cancelled = stop;
  const model::Response response = model::Simulate(MakeRig(problem, candidate, point), options);
  strokes.failed = response.status != model::SimulateStatus::kDone;
  if (strokes.failed) return strokes;
  const std::vector<Squad> squads = SquadsOf(problem);
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.state != model::ValveState::kInflate) continue;
    const int g = squads[stroke.group].group;
    Keep(strokes.rise_s[g], stroke.to_target_s);
    Keep(strokes.inflate_s[g], stroke.to_operating_s);
  }
  strokes.works = AllReached(strokes);
  return strokes;
}

}  // namespace

bool StrokesOfGroup(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    int group, Strokes& strokes) {
  const Together alone{group, group + 1};
  const std::vector<Squad> squads = SquadsOf(problem, alone);
  const std::vector<double> turns_s = TurnSeconds(problem, squads);
  for (std::size_t s = 0; s < squads.size(); ++s) {
    const double draw_s =
        RegulatedStroke(problem, candidate, PressureOf(point, group), squads[s], strokes);
    if (squads.size() > 1 && !(draw_s <= turns_s[s]))
      return SimulateTogether(problem, candidate, point, alone, strokes);
  }
  return true;
}

bool WorstIsEnclosed(const Problem& problem, const Candidate& candidate) {
  return problem.guarantee && !AllHold(candidate);
}

double AloneStrokeExcess(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point) {
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const model::ReservoirStroke stroke = model::FillFromReservoir(
        MakeStrokeInput(problem, candidate, point, g, FilledAtOnce(problem, g), point.source_pa));
    if (!stroke.reached) return kUnlimited;
    excess = std::max({excess, stroke.rise_s / RiseWindow(problem, g) - 1.0,
                       stroke.inflate_s / InflateWindow(problem, g) - 1.0});
  }
  return excess;
}

Strokes EvaluateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  if (IsOpenTank(candidate)) return OpenTankStrokes(problem, candidate, point);
  if (IsDirect(candidate.configuration)) return DirectStrokes(problem, candidate);
  if (HasEffects(problem)) return SimulateStrokes(problem, candidate, point);
  if (HasOwnRegulators(candidate)) return StrokesOfOwn(problem, candidate, point);
  const bool pumped = KeepsReservoir(candidate.configuration);
  if (pumped && MeetingOf(problem) == Meeting::kTogether && FillAlike(candidate))
    return StrokesAlike(problem, candidate, point);
  if (StrokesMeet(problem)) return StrokesTogether(problem, candidate, point);

  Strokes strokes = ToBeKept(problem);
  const std::vector<Squad> squads = SquadsOf(problem);
  const std::vector<double> turns_s = TurnSeconds(problem, squads);
  for (std::size_t s = 0; s < squads.size(); ++s) {
    if (!pumped) {
      const double draw_s =
          RegulatedStroke(problem, candidate, point.source_pa, squads[s], strokes);
      if (squads.size() > 1 && !(draw_s <= turns_s[s]))
        return StrokesTogether(problem, candidate, point);
    } else {
      const Alone outcome = ReservoirStroke(problem, candidate, point, squads[s].group,
                                            squads[s].count, turns_s[s], strokes);
      if (outcome == Alone::kTooSlow) return NeverFilled(problem);
      if (outcome == Alone::kNo) return StrokesPartlyFull(problem, candidate, point);
    }
  }
  strokes.from_full = true;
  strokes.works = AllReached(strokes);
  return strokes;
}

Strokes SimulateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point) {
  if (HasEffects(problem)) return SimulateWithEffects(problem, candidate, point);
  const Workbench own;
  const Workbench& bench = candidate.bench != nullptr ? *candidate.bench : own;
  if (IsOpenTank(candidate)) return SimulateOpenTank(problem, candidate, point, bench.stop);
  Strokes strokes = ToBeKept(problem);
  for (const Together& together : TogetherOf(problem, candidate))
    if (!SimulateTogether(problem, candidate, point, together, strokes)) return strokes;
  strokes.works = AllReached(strokes);
  return strokes;
}

}  // namespace plenum::optimizer
