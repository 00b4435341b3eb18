#include "optimizer/sizing/resize.h"

#include <algorithm>
#include <set>

#include "model/physics/storage.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/choices/plant/part_numbers.h"
#include "optimizer/evaluate/packs.h"
#include "optimizer/evaluate/relaxation.h"
#include "optimizer/evaluate/source_options.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"
#include "optimizer/problem/pump_feed.h"
#include "optimizer/sizing/effect_sizing.h"
#include "optimizer/sizing/report.h"

namespace plenum::optimizer {
namespace {

template <typename Part>
const std::string& IdOf(const Part& part) {
  if constexpr (requires { part.per_metre; })
    return part.per_metre.id;
  else
    return part.basics.id;
}

template <typename Part>
std::vector<Part> Kept(const std::vector<Part>& parts, const std::set<std::string>& ids) {
  std::vector<Part> kept;
  for (const Part& part : parts)
    if (ids.contains(IdOf(part))) kept.push_back(part);
  return kept;
}

const Choice* ChoiceOf(const Design& design, Family family, int group) {
  const auto found = std::find_if(
      design.parts.begin(), design.parts.end(),
      [&](const Choice& choice) { return choice.family == family && choice.group == group; });
  return found == design.parts.end() ? nullptr : &*found;
}

int PartOf(const model::Parts& parts, Family family, const Choice* choice) {
  return choice == nullptr ? -1 : FindPart(parts, family, choice->id);
}

// False: a part is missing, or no source makes the line meet its limits.
bool SetLine(const Problem& problem, const Design& design, int g, Line& line) {
  const model::Parts& parts = problem.parts;
  const Choice* fitting_choice = ChoiceOf(design, Family::kFitting, g);
  const int tube = PartOf(parts, Family::kTubing, ChoiceOf(design, Family::kTubing, g));
  const int fitting = PartOf(parts, Family::kFitting, fitting_choice);
  const int valve = PartOf(parts, Family::kValve, ChoiceOf(design, Family::kValve, g));
  if (tube < 0 || valve < 0 || (fitting_choice != nullptr && fitting < 0)) return false;
  const ActuatorGroup& group = problem.groups[g];
  const int channels = parts.valves[valve].channels;
  const int pieces = (group.count + channels - 1) / channels;
  constexpr Kinds kMate = 1;  // they do
  const auto set = [&](Family family, int part, double bought, auto& corner) {
    SetNumbers(PartNumbers{parts, part, static_cast<double>(group.count)}, corner);
    corner.amounts = Counted(bought, BasicsOf(parts, family, part), SharesPacks(problem, g));
  };
  TubeCorner tube_corner;
  set(Family::kTubing, tube, group.count * group.tube_length_m, tube_corner);
  tube_corner.amounts += LineJointShare(problem, g, HasOwnRegulators(design.parts));
  tube_corner.diameters = kMate;
  FittingCorner fitting_corner;
  fitting_corner.pressure_max_pa = kUnlimited;
  if (fitting >= 0)
    set(Family::kFitting, fitting, group.count * group.fittings_per_line, fitting_corner);
  fitting_corner.diameters = fitting_corner.threads = kMate;
  ValveCorner valve_corner;
  set(Family::kValve, valve, pieces, valve_corner);
  valve_corner.threads = kMate;
  if (IsDirect(design.configuration)) valve_corner.late_s = 0.0;
  const model::Gas gas = GasOf(design.configuration);
  const Constraint missed =
      MakeLine(problem, g, gas, {tube_corner, fitting_corner, valve_corner}, true, true, line);
  line.tubing = tube;
  line.fitting = fitting;
  line.valve = valve;
  return missed == Constraint::kNone;
}

// False: a group has none, or one that the problem does not have.
bool SetOwnRegulators(const Problem& problem, const Design& design, Candidate& candidate) {
  if (!HasOwnRegulators(design.parts)) return true;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const int part =
        PartOf(problem.parts, Family::kRegulator, ChoiceOf(design, Family::kRegulator, g));
    if (part < 0) return false;
    Option& own = candidate.own_regulators.emplace_back();
    own.index = part;
    own.quantity = 1;
    own.amounts = Counted(1.0, problem.parts.regulators[part].basics, SharesPacks(problem, g));
    own.amounts += OwnRegulatorJointAtMains(problem, design.configuration, g);
    own.objective = ObjectiveOf(problem.objective, own.amounts);
  }
  return true;
}

// False: the design has a part that the problem does not.
bool SetOptions(const Problem& problem, const Design& design, Candidate& candidate) {
  for (const FamilySpec& spec : Families()) {
    const bool chosen = !spec.in_line && !spec.joins;
    const Choice* choice = chosen ? ChoiceOf(design, spec.family, -1) : nullptr;
    if (choice == nullptr) continue;
    Option& option = OptionOf(candidate, spec.family);
    option.index = FindPart(problem.parts, spec.family, choice->id);
    option.quantity = static_cast<int>(choice->quantity) / FeedsOf(problem, spec.family);
    if (option.index < 0) {
      if (!spec.made_to_measure || choice->id != "custom") return false;
      option.index = kCustom;
      option.quantity = 1;
      continue;
    }
    option.amounts = Bought(choice->quantity, BasicsOf(problem.parts, spec.family, option.index));
    option.amounts.mass_kg += choice->quantity * ChargeKg(problem, spec.family, option.index);
    option.amounts += SourceJoint(problem, spec.family, option.index, option.quantity,
                                  HasOwnRegulators(candidate));
    option.objective = ObjectiveOf(problem.objective, option.amounts);
  }
  return true;
}

// A candidate with lines of its own.
struct Rebuilt {
  std::vector<Line> lines;
  Candidate candidate;
};

// The design's parts out of `problem`; what its lines can do at best is taken from `relaxed`.
bool Rebuild(const Problem& problem, const Problem& relaxed, const Design& design,
             Rebuilt& rebuilt) {
  rebuilt.candidate.configuration = design.configuration;
  rebuilt.lines.resize(problem.groups.size());
  for (int g = 0; g < static_cast<int>(rebuilt.lines.size()); ++g) {
    Line& line = rebuilt.lines[g];
    if (!SetLine(relaxed, design, g, line)) return false;
    const double bore_m3 = line.chamber.dead_volume_m3 - relaxed.groups[g].chamber.dead_volume_m3;
    line.chamber = problem.groups[g].chamber;
    line.chamber.dead_volume_m3 += bore_m3;
    rebuilt.candidate.lines.push_back(&line);
  }
  rebuilt.candidate.pack_surplus_eur = PackSurplus(problem, design.parts);
  return SetOwnRegulators(problem, design, rebuilt.candidate) &&
         SetOptions(problem, design, rebuilt.candidate);
}

// Of pumps without a reservoir the pressure is no setting.
OperatingPoint PointOf(const Problem& problem, const Candidate& candidate, const Design& design) {
  if (IsDirect(design.configuration)) return DirectPoint(problem, candidate);
  const double reservoir_m3 = design.settings.reservoir_volume_m3.value_or(0.0);
  OperatingPoint point{design.settings.source_pressure_pa, reservoir_m3, reservoir_m3,
                       design.settings.tank_fill_pa.value_or(0.0)};
  point.pump_stop_pa = design.settings.pump_stop_pa.value_or(0.0);
  if (HasOwnRegulators(candidate)) point.group_pa = design.settings.group_pressure_pa;
  if (design.settings.rail) point.rail_pa = design.settings.rail->pressure_pa;
  return point;
}

bool StandsSettings(const Problem& problem, const Candidate& candidate, const Window& source,
                    const OperatingPoint& point) {
  if (!HasOwnRegulators(candidate))
    return source.low_pa <= point.source_pa && point.source_pa <= source.high_pa;
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g) {
    const Window window = GroupWindow(problem, candidate, g);
    const double group_pa = PressureOf(point, g);
    if (group_pa < window.low_pa || group_pa > window.high_pa) return false;
  }
  return true;
}

Leaf SizeRebuilt(const Problem& problem, const Workbench& bench, Rebuilt& rebuilt) {
  rebuilt.candidate.bench = &bench;
  if (rebuilt.candidate.reservoir.index != kCustom)
    return SizeAtVolume(problem, rebuilt.candidate, ReservoirVolume(problem, rebuilt.candidate));
  CustomSizing sizing(problem, rebuilt.candidate);
  while (!bench.stopped() && !sizing.Refine()) {
  }
  return sizing.leaf();
}

// Strokes as slow as the period allows are looked at, too, and peaks as high as the source.
Problem WithoutStrokeLimits(Problem problem) {
  for (ActuatorGroup& group : problem.groups)
    group.rise_time_max_s = group.fall_time_max_s = kUnlimited;
  for (model::Valve& valve : problem.parts.valves) valve.closing_scatter_s = 0.0;
  return problem;
}

}  // namespace

Problem WithPartsOf(const Problem& problem, const Design& design) {
  std::set<std::string> ids;
  for (const Choice& choice : design.parts) ids.insert(choice.id);
  Problem own = problem;
  const model::Parts& all = problem.parts;
  own.parts = {.tubing = Kept(all.tubing, ids),
               .fittings = Kept(all.fittings, ids),
               .valves = Kept(all.valves, ids),
               .compressors = Kept(all.compressors, ids),
               .batteries = Kept(all.batteries, ids),
               .cylinders = Kept(all.cylinders, ids),
               .co2 = Kept(all.co2, ids),
               .regulators = Kept(all.regulators, ids),
               .reservoirs = Kept(all.reservoirs, ids),
               .tanks = Kept(all.tanks, ids),
               .vacuum_pumps = Kept(all.vacuum_pumps, ids),
               .manifolds = Kept(all.manifolds, ids),
               .ejectors = Kept(all.ejectors, ids),
               .check_valves = Kept(all.check_valves, ids)};
  FitCheckValves(own, own.parts);
  return own;
}

Leaf Resize(const Problem& problem, const Design& design, const std::function<bool()>& stop) {
  Rebuilt rebuilt;
  if (!Rebuild(problem, problem, design, rebuilt)) {
    Leaf infeasible;
    infeasible.status = LeafStatus::kInfeasible;
    return infeasible;
  }
  const Workbench bench{.stop = stop};
  return SizeRebuilt(problem, bench, rebuilt);
}

Remade AtBestSettings(const Problem& problem, const Design& design,
                      const std::function<bool()>& stop) {
  if (HasEffects(problem)) return Remake(problem, Relaxed(problem), design, stop);
  Rebuilt rebuilt;
  if (!Rebuild(problem, problem, design, rebuilt)) return {LeafStatus::kInfeasible, {}};
  const Workbench bench{.stop = stop};
  const Leaf leaf = SizeRebuilt(problem, bench, rebuilt);
  Remade made{leaf.status, {}};
  if (leaf.status != LeafStatus::kFeasible) return made;
  made.design = MakeDesign(problem, rebuilt.candidate, leaf);
  if (!made.design) made.status = LeafStatus::kUndecided;
  return made;
}

std::optional<Design> WithSettingsAnew(const Problem& problem, const Design& design,
                                       const std::function<bool()>& stop) {
  Rebuilt rebuilt;
  if (!Rebuild(problem, problem, design, rebuilt)) return std::nullopt;
  const Workbench bench{.stop = stop};
  rebuilt.candidate.bench = &bench;
  const Leaf leaf =
      SizeAtVolume(problem, rebuilt.candidate, design.settings.reservoir_volume_m3.value_or(0.0));
  if (leaf.status != LeafStatus::kFeasible) return std::nullopt;
  return MakeDesign(problem, rebuilt.candidate, leaf);
}

Remade Remake(const Problem& problem, const Problem& relaxed, const Design& design,
              const std::function<bool()>& stop) {
  Rebuilt rebuilt;
  if (!Rebuild(problem, relaxed, design, rebuilt)) return {LeafStatus::kInfeasible, {}};
  const Workbench bench{.stop = stop};
  rebuilt.candidate.bench = &bench;
  const Leaf leaf = SizeWithEffects(problem, rebuilt.candidate,
                                    design.settings.reservoir_volume_m3.value_or(0.0), stop);
  Remade remade{leaf.status, {}};
  if (leaf.status != LeafStatus::kFeasible) return remade;
  remade.design = MakeDesign(problem, rebuilt.candidate, leaf);
  if (!remade.design) remade.status = LeafStatus::kUndecided;
  return remade;
}

std::optional<std::vector<Margin>> MarginsOf(const Problem& problem, const Problem& relaxed,
                                             const Design& design,
                                             const std::function<bool()>& stop) {
  Rebuilt rebuilt;
  if (!Rebuild(problem, relaxed, design, rebuilt)) return std::nullopt;
  const Workbench bench{.stop = stop};
  rebuilt.candidate.bench = &bench;
  const OperatingPoint point = PointOf(problem, rebuilt.candidate, design);
  const Evaluation evaluation = Evaluate(problem, rebuilt.candidate, point);
  if (!evaluation.works) return std::nullopt;
  return Margins(problem, rebuilt.candidate, point, evaluation);
}

AtSettings EvaluateAtSettings(const Problem& problem, const Design& design,
                              const std::function<bool()>& stop) {
  const Problem free = WithoutStrokeLimits(problem);
  AtSettings found;
  Rebuilt rebuilt;
  if (!Rebuild(free, Relaxed(free), design, rebuilt)) return found;
  found.source = SourceWindow(free, rebuilt.candidate);
  OperatingPoint point = PointOf(free, rebuilt.candidate, design);
  if (!StandsSettings(free, rebuilt.candidate, found.source, point)) return found;
  const Workbench bench{.stop = stop};
  rebuilt.candidate.bench = &bench;
  const Evaluation evaluation = EvaluateFilled(free, rebuilt.candidate, point);
  found.unknown = evaluation.failed;
  if (!evaluation.works) return found;
  found.design = Describe(problem, rebuilt.candidate, point, evaluation);
  if (found.design->totals.cost_eur || problem.unpriced_allowed) return found;
  for (Margin& margin : found.design->margins)  // of a part without a price no cost is known
    if (margin.requirement == "/supply/cost_eur_max")
      margin.achieved = kUnlimited, margin.relative_margin = -kUnlimited;
  return found;
}

std::optional<DrivenDesign> Drive(const Problem& problem, const Design& design,
                                  const std::function<bool()>& stop) {
  const Problem free = WithoutStrokeLimits(problem);
  Rebuilt rebuilt;
  if (!Rebuild(free, Relaxed(free), design, rebuilt)) return std::nullopt;
  Candidate& candidate = rebuilt.candidate;
  if (HasOwnRegulators(candidate)) return std::nullopt;
  const OperatingPoint point = PointOf(free, candidate, design);
  const Workbench bench{.stop = stop};
  candidate.bench = &bench;
  const Evaluation evaluation = Evaluate(free, candidate, point);
  if (!evaluation.works) return std::nullopt;
  DrivenDesign driven;
  driven.rig = MakeRig(free, candidate, point);
  // Of a tank without a regulator that of the last cycle.
  if (IsOpenTank(candidate))
    std::get<model::ReservoirSource>(driven.rig.source).initial_pressure_pa = point.source_pa;
  std::vector<model::GroupRig> squads = std::move(driven.rig.groups);
  driven.rig.groups.clear();
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const Line& line = *candidate.lines[g];
    const auto squad = std::find_if(squads.begin(), squads.end(),
                                    [&](const auto& one) { return one.name == group.name; });
    model::GroupRig actuator = *squad;
    actuator.count = 1;
    actuator.schedule.clear();
    actuator.close_at_operating = false;
    for (int i = 1; i <= group.count; ++i) {
      actuator.name = group.count == 1 ? group.name : group.name + "[" + std::to_string(i) + "]";
      driven.rig.groups.push_back(actuator);
      driven.coil_power_w.push_back(line.coil_power_w / group.count);
      driven.holds.push_back(line.holds);
    }
  }
  for (const model::Regulator* regulator : RegulatorsOf(free, candidate))
    driven.regulator_power_w += regulator->electrical_power_w;
  driven.energy_available_j = evaluation.energy_available_j;
  driven.air_available_m3 = evaluation.air_available_m3;
  return driven;
}

}  // namespace plenum::optimizer
