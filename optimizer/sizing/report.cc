#include "optimizer/sizing/report.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/closing.h"
#include "optimizer/evaluate/packs.h"
#include "optimizer/evaluate/refilled_tank.h"
#include "optimizer/evaluate/source_options.h"
#include "optimizer/evaluate/strokes/effect_strokes.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

// The simulator's times may pass a limit by this share before a design is refused: it is the
// simulator's own error at its default tolerance, with room.
constexpr double kConfirmTolerance = 1e-5;
constexpr int kSamplesPerCycle = 400;

Choice PieceChoice(Family family, const model::PartBasics& basics, int group, double quantity) {
  return {family,
          basics.id,
          group,
          quantity,
          quantity * basics.mass_kg,
          quantity * basics.body_volume_m3,
          std::nullopt};
}

void AddChoice(const Problem& problem, Family family, const Option& option,
               std::vector<Choice>& parts) {
  if (option.index < 0) return;
  const model::PartBasics& basics = BasicsOf(problem.parts, family, option.index);
  parts.push_back(PieceChoice(family, basics, -1, option.quantity * FeedsOf(problem, family)));
  parts.back().mass_kg += option.quantity * ChargeKg(problem, family, option.index);
}

void AddLine(const Problem& problem, int g, const Line& line, std::vector<Choice>& parts) {
  const ActuatorGroup& group = problem.groups[g];
  const model::Valve& valve = problem.parts.valves[line.valve];
  const int pieces = (group.count + valve.channels - 1) / valve.channels;
  parts.push_back(PieceChoice(Family::kValve, valve.basics, g, pieces));
  if (line.fitting >= 0)
    parts.push_back(PieceChoice(Family::kFitting, problem.parts.fittings[line.fitting].basics, g,
                                group.count * group.fittings_per_line));
  parts.push_back(PieceChoice(Family::kTubing, problem.parts.tubing[line.tubing].per_metre, g,
                              group.count * group.tube_length_m));
}

Totals TotalsOf(const std::vector<Choice>& parts) {
  bool priced = true;
  Totals totals;
  for (const Choice& choice : parts) {
    totals.mass_kg += choice.mass_kg;
    totals.volume_m3 += choice.volume_m3;
    priced = priced && choice.cost_eur.has_value();
    totals.cost_known_eur += choice.cost_eur.value_or(0.0);
  }
  if (priced) totals.cost_eur = totals.cost_known_eur;
  return totals;
}

// Groups of one entry of the request (ActuatorGroup::entry) have its requirements in common: the
// one that is met least counts.
std::vector<Margin> OnePerRequirement(std::vector<Margin> margins) {
  std::vector<Margin> kept;
  for (Margin& margin : margins) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Margin& other) {
      return other.requirement == margin.requirement;
    });
    if (same == kept.end())
      kept.push_back(std::move(margin));
    else if (margin.relative_margin < same->relative_margin)
      *same = std::move(margin);
  }
  return kept;
}

Performance MakePerformance(const Problem& problem, const Evaluation& evaluation) {
  Performance performance;
  performance.groups = evaluation.groups;
  performance.frequency_sustained_hz = evaluation.frequency_sustained_hz;
  int actuations = 0;  // of all actuators in a period
  int entry = -1;      // the two chambers of one actuator are groups of one entry
  for (const ActuatorGroup& group : problem.groups) {
    if (entry < 0 || group.entry != entry)
      actuations += group.count * group.gait.strokes_per_period;
    entry = group.entry;
  }
  performance.air_per_actuation_m3 = evaluation.air_per_cycle_m3 / actuations;
  performance.air_total_m3 = evaluation.air_total_m3;
  performance.run_time_s = problem.actuations / problem.frequency_hz;
  return performance;
}

// Whether a first cycle ends otherwise than it began: strokes cross the period's end.
bool BeginsElsewhere(const model::Rig& rig, const model::Response& first) {
  constexpr double kAlike = 1e-4;  // relative
  for (std::size_t g = 0; g < rig.groups.size(); ++g)
    if (std::abs(first.groups[g].final_pressure_pa / rig.groups[g].initial_pressure_pa - 1.0) >
        kAlike)
      return true;
  return false;
}

// One cycle of the periodic state of what is simulated together, from a full reservoir and
// actuators at rest, where they are; none where the simulator fails or is told to stop.
std::optional<model::Response> CycleOf(const Problem& problem, const Candidate& candidate,
                                       const OperatingPoint& point, const Together& together) {
  model::SimulateOptions options;
  options.end_s = 1.0 / problem.frequency_hz;
  options.sample_hz = kSamplesPerCycle * problem.frequency_hz;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  if (candidate.bench != nullptr) options.cancelled = candidate.bench->stop;
  model::Rig rig = MakeRig(problem, candidate, point, together);
  model::Response response = model::Simulate(rig, options);
  if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  if (BeginsElsewhere(rig, response)) {
    BeginWhereItEnded(response, options.end_s, rig);
    response = model::Simulate(rig, options);
    if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  }
  return response;
}

// For the plots. With regulators of their own the source's pressure is the highest behind them.
Design::Trace TraceCycle(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point) {
  Design::Trace trace;
  for (const Together& together : TogetherOf(problem, candidate)) {
    std::optional<model::Response> response = CycleOf(problem, candidate, point, together);
    if (!response) return {};
    const bool first = trace.t_s.empty();
    if (first) trace.t_s = std::move(response->t_s);
    for (model::GroupResponse& group : response->groups)
      trace.pressure_pa.push_back(std::move(group.pressure_pa));
    const std::vector<double>& source_pa = response->source_pressure_pa;
    if (first) trace.source_pressure_pa = source_pa;
    for (std::size_t i = 0; i < std::min(source_pa.size(), trace.t_s.size()); ++i)
      trace.source_pressure_pa[i] = std::max(trace.source_pressure_pa[i], source_pa[i]);
  }
  return trace;
}

// Whether simulated strokes are in time, with room for the simulator's own error: of the times, and
// of the pressure that they begin at. Pumps that run all the time leave the source where air in and
// out balance, which amplifies the error, and the slower it fills the more time a pascal is worth.
bool InTime(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
            const Strokes& strokes, const Evaluation& evaluation) {
  const auto excess = [&](const std::vector<double>& rise_s, const std::vector<double>& inflate_s) {
    double most = -kUnlimited;
    for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
      most = std::max({most, rise_s[g] / problem.groups[g].rise_time_max_s - 1.0,
                       inflate_s[g] / InflateWindow(problem, g) - 1.0});
    return most;
  };
  if (excess(strokes.rise_s, strokes.inflate_s) <= kConfirmTolerance) return true;
  OperatingPoint raised = point;
  raised.tank_fill_pa = raised.pump_stop_pa = 0.0;
  raised.source_pa *= 1.0 + kConfirmTolerance;
  for (double& group_pa : raised.group_pa) group_pa *= 1.0 + kConfirmTolerance;
  const Evaluation above = Evaluate(problem, candidate, raised);
  if (!above.works) return false;
  std::vector<double> rise_s = strokes.rise_s, inflate_s = strokes.inflate_s;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    rise_s[g] -= evaluation.groups[g].rise_time_s - above.groups[g].rise_time_s;
    inflate_s[g] -= evaluation.groups[g].inflate_time_s - above.groups[g].inflate_time_s;
  }
  return excess(rise_s, inflate_s) <= kConfirmTolerance;
}

// Whether the simulator confirms the strokes and what the pumps bear at this point. Where groups
// meet its times are taken.
bool Confirm(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
             Evaluation& evaluation) {
  if (StrokeExcess(problem, evaluation) > 0.0 ||
      SupplyMargin(problem, candidate, point, evaluation) < 0.0)
    return false;
  if (HasEffects(problem)) return true;  // the evaluation was the simulator's
  const Strokes strokes = SimulateStrokes(problem, candidate, point);
  if (!strokes.works) return false;
  if (!InTime(problem, candidate, point, strokes, evaluation)) return false;
  if (!IsPumped(candidate.configuration)) {
    const Evaluation simulated =
        StrokesMeet(problem) ? EvaluateWith(strokes, problem, candidate, point) : evaluation;
    if (SmallestMargin(problem, candidate, point, simulated) >= 0.0) evaluation = simulated;
    return true;
  }
  const double duty_max = ChosenPump(problem, candidate).duty_max;
  return strokes.pump_on_s * problem.frequency_hz <= duty_max * (1.0 + kConfirmTolerance);
}

// A point near the leaf's that the simulator confirms, with its evaluation; none where there is
// none. The lowest pressure that is fast enough leaves no room for the simulator's own error, and a
// stroke that just ends within half of the period is never completed there.
std::optional<OperatingPoint> ConfirmNear(const Problem& problem, const Candidate& candidate,
                                          const Leaf& leaf, Evaluation& evaluation) {
  constexpr double kSteps[] = {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3};  // of the source pressure
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  for (const double step : kSteps) {
    if (step > 0.0 && IsDirect(candidate.configuration)) break;  // no setting
    OperatingPoint point = leaf.point;
    point.tank_fill_pa = point.pump_stop_pa = 0.0;
    point.source_pa *= 1.0 + step;
    if (step > 0.0 && point.source_pa > high_pa) break;
    for (int g = 0; g < static_cast<int>(point.group_pa.size()); ++g)
      point.group_pa[g] =
          std::min(point.group_pa[g] * (1.0 + step), GroupWindow(problem, candidate, g).high_pa);
    evaluation = Evaluate(problem, candidate, point);
    const double most = leaf.objective * (1.0 + 0.5 * TieOf(problem));
    if (evaluation.works && ObjectiveValue(problem, candidate, point, evaluation) > most) break;
    if (Confirm(problem, candidate, point, evaluation)) return point;
  }
  return std::nullopt;
}

}  // namespace

bool SameRow(const Choice& a, const Choice& b) {
  return a.family == b.family && a.group == b.group && a.id == b.id && a.quantity == b.quantity;
}

bool SameParts(const std::vector<Choice>& a, const std::vector<Choice>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), SameRow);
}

std::vector<Choice> ListParts(const Problem& problem, const Candidate& candidate,
                              const OperatingPoint& point) {
  std::vector<Choice> parts;
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g)
    AddLine(problem, g, *candidate.lines[g], parts);
  for (const Family family : SourceFamilies(problem, candidate.configuration)) {
    if (family == Family::kRegulator)
      for (const Option& own : candidate.own_regulators) {
        AddChoice(problem, family, own, parts);
        parts.back().group = static_cast<int>(&own - candidate.own_regulators.data());
      }
    AddChoice(problem, family, OptionOf(candidate, family), parts);
    if (family == Family::kTank && point.tank_fill_pa > 0.0)
      parts.back().mass_kg += ChargeBeyondLeast(problem, candidate, point.tank_fill_pa);
  }
  if (candidate.reservoir.index == kCustom) {
    const Amounts amounts = CustomReservoir(problem, point.reservoir_m3, point.source_pa);
    parts.push_back(
        {Family::kReservoir, "custom", -1, 1, amounts.mass_kg, amounts.volume_m3, std::nullopt});
  }
  for (const Joint& joint : JointsOf(problem, parts))
    parts.push_back(PieceChoice(joint.family, BasicsOf(problem.parts, joint.family, joint.part), -1,
                                joint.quantity));
  SetCosts(problem, parts);
  return parts;
}

std::optional<Design> MakeDesign(const Problem& problem, const Candidate& candidate,
                                 const Leaf& given, const std::function<bool()>& late) {
  Leaf leaf = given;
  OperatingPoint point = leaf.point;
  if (!late || !late()) {
    Workbench bench = candidate.bench ? *candidate.bench : Workbench{};
    if (late) bench.stop = late;
    Candidate settled = candidate;
    settled.bench = &bench;
    if (!leaf.lowest)
      if (const Leaf sized = SizeAtVolume(problem, settled, leaf.point.reservoir_m3);
          sized.status == LeafStatus::kFeasible)
        leaf = sized;
    point = Settle(problem, settled, leaf);
  }
  Evaluation evaluation = Evaluate(problem, candidate, point);
  if (!Confirm(problem, candidate, point, evaluation)) {
    const std::optional<OperatingPoint> near = ConfirmNear(problem, candidate, leaf, evaluation);
    if (!near) return std::nullopt;
    point = *near;
  }
  if (RefillsTank(candidate)) evaluation = EvaluateFilled(problem, candidate, point);
  if (!evaluation.works) return std::nullopt;  // told to stop meanwhile
  point.rail_pa = evaluation.rail.weakest_pa;
  Design design = Describe(problem, candidate, point, evaluation);
  design.response = TraceCycle(problem, candidate, point);
  if (design.response.t_s.empty() && candidate.stopped()) return std::nullopt;
  return design;
}

Design Describe(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                const Evaluation& evaluation) {
  const OperatingPoint filled = Filled(problem, candidate, point, evaluation);
  Design design;
  design.configuration = candidate.configuration;
  design.parts = ListParts(problem, candidate, filled);
  design.packs = PacksOf(problem, design.parts);
  design.totals = TotalsOf(design.parts);
  design.totals.energy_j = evaluation.energy_total_j;
  design.settings.source_pressure_pa = point.source_pa;
  design.settings.group_pressure_pa = point.group_pa;
  if (candidate.compressor.index != kNone) {
    design.settings.compressor_duty = evaluation.compressor_duty;
    // With tolerances halfway between what it has while it falls and while it rises.
    if (KeepsReservoir(candidate.configuration))
      design.settings.reservoir_volume_m3 = 0.5 * (point.reservoir_m3 + point.reservoir_rising_m3);
  }
  if (filled.tank_fill_pa > 0.0) {
    design.settings.reservoir_volume_m3 = point.reservoir_m3;
    design.settings.tank_fill_pa = filled.tank_fill_pa;
  }
  if (RefillsTank(candidate))
    design.settings.pump_stop_pa =
        RefillOf(problem, candidate, filled, evaluation.air_per_cycle_m3).stop_pa;
  if (const RailSource rail = RailSourceOf(problem, candidate); rail.curve)
    design.settings.rail = {evaluation.rail.weakest_pa, evaluation.rail.stop_pa,
                            evaluation.rail.duty, rail.volume_m3};
  for (std::size_t g = 0; g < evaluation.groups.size(); ++g)
    design.settings.valve_duty.push_back(problem.groups[g].gait.strokes_per_period *
                                         evaluation.groups[g].inflate_time_s *
                                         problem.frequency_hz);
  design.performance = MakePerformance(problem, evaluation);
  for (std::size_t g = 0; g < evaluation.groups.size(); ++g) {
    double& highest_pa = design.performance.groups[g].highest_pressure_pa;
    highest_pa = std::max(highest_pa, PeakOf(problem, candidate, static_cast<int>(g),
                                             PressureOf(point, static_cast<int>(g))));
  }
  design.margins = OnePerRequirement(Margins(problem, candidate, point, evaluation));
  design.objective = ObjectiveValue(problem, candidate, point, evaluation);
  return design;
}

}  // namespace plenum::optimizer
