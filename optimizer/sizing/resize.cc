#include "optimizer/sizing/resize.h"

#include <algorithm>
#include <set>

#include "model/physics/storage.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/evaluate/relaxation.h"
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

template <typename Part>
const Part* Find(const std::vector<Part>& parts, const Choice* choice) {
  if (choice == nullptr) return nullptr;
  for (const Part& part : parts)
    if (IdOf(part) == choice->id) return &part;
  return nullptr;
}

// False: a part is missing, or no source makes the line meet its limits.
bool SetLine(const Problem& problem, const Design& design, int g, Line& line) {
  const Choice* fitting_choice = ChoiceOf(design, Family::kFitting, g);
  const model::Tubing* tube = Find(problem.parts.tubing, ChoiceOf(design, Family::kTubing, g));
  const model::Fitting* fitting = Find(problem.parts.fittings, fitting_choice);
  const model::Valve* valve = Find(problem.parts.valves, ChoiceOf(design, Family::kValve, g));
  if (tube == nullptr || valve == nullptr || (fitting_choice != nullptr && fitting == nullptr))
    return false;
  const ActuatorGroup& group = problem.groups[g];
  const int pieces = (group.count + valve->channels - 1) / valve->channels;
  constexpr Kinds kMate = 1;  // they do
  TubeCorner tube_corner;
  tube_corner.amounts = group.count * group.tube_length_m * tube->per_metre;
  tube_corner.diameters = kMate;
  tube_corner.inner_low_m = tube_corner.inner_high_m = tube->inner_diameter_m;
  tube_corner.pressure_max_pa = tube->pressure_max_pa;
  FittingCorner fitting_corner;
  fitting_corner.diameters = fitting_corner.threads = kMate;
  fitting_corner.pressure_max_pa = kUnlimited;
  if (fitting != nullptr) {
    fitting_corner.amounts =
        static_cast<double>(group.count * group.fittings_per_line) * fitting->basics;
    fitting_corner.flow = fitting->flow;
    fitting_corner.pressure_max_pa = fitting->pressure_max_pa;
  }
  ValveCorner valve_corner;
  valve_corner.amounts = static_cast<double>(pieces) * valve->basics;
  valve_corner.threads = kMate;
  valve_corner.some_hold = valve_corner.all_hold = model::Holds(valve->kind);
  valve_corner.fill = valve->fill;
  valve_corner.exhaust = valve->exhaust;
  valve_corner.coil_power_w = valve->coil_power_w * group.count;
  valve_corner.pressure_min_pa = valve->pressure_min_pa;
  valve_corner.pressure_max_pa = valve->pressure_max_pa;
  const model::Gas gas =
      design.configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
  const Constraint missed =
      MakeLine(problem, g, gas, {tube_corner, fitting_corner, valve_corner}, true, true, line);
  line.tubing = static_cast<int>(tube - problem.parts.tubing.data());
  line.fitting =
      fitting == nullptr ? -1 : static_cast<int>(fitting - problem.parts.fittings.data());
  line.valve = static_cast<int>(valve - problem.parts.valves.data());
  return missed == Constraint::kNone;
}

// False: the design has such a part and the problem does not. `charge_kg` is the gas in one piece.
template <typename Part, typename Charge>
bool SetOption(const Problem& problem, const Design& design, Family family,
               const std::vector<Part>& parts, Charge&& charge_kg, Option& option) {
  const Choice* choice = ChoiceOf(design, family, -1);
  if (choice == nullptr) return true;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    if (IdOf(parts[i]) != choice->id) continue;
    option.index = i;
    option.quantity = static_cast<int>(choice->quantity);
    option.amounts = choice->quantity * parts[i].basics;
    option.amounts.mass_kg += choice->quantity * charge_kg(parts[i]);
    option.objective = ObjectiveOf(problem.objective, option.amounts);
    return true;
  }
  return false;
}

bool SetOptions(const Problem& problem, const Design& design, Candidate& candidate) {
  const model::Parts& parts = problem.parts;
  const auto none = [](const auto&) { return 0.0; };
  const auto air = [&](const model::Cylinder& cylinder) {
    return model::CylinderCharge(cylinder.water_volume_m3, cylinder.fill_pressure_pa,
                                 problem.ambient.temperature_k);
  };
  const auto co2 = [](const model::Co2Bottle& bottle) { return bottle.co2_mass_kg; };
  const auto set = [&](Family family, const auto& of_family, const auto& charge, Option& option) {
    return SetOption(problem, design, family, of_family, charge, option);
  };
  if (!set(Family::kReservoir, parts.reservoirs, none, candidate.reservoir)) {
    if (ChoiceOf(design, Family::kReservoir, -1)->id != "custom") return false;
    candidate.reservoir.index = kCustom;
    candidate.reservoir.quantity = 1;
  }
  return set(Family::kRegulator, parts.regulators, none, candidate.regulator) &&
         set(Family::kCylinder, parts.cylinders, air, candidate.bottle) &&
         set(Family::kCo2, parts.co2, co2, candidate.bottle) &&
         set(Family::kCompressor, parts.compressors, none, candidate.compressor) &&
         set(Family::kBattery, parts.batteries, none, candidate.battery);
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
  return SetOptions(problem, design, rebuilt.candidate);
}

OperatingPoint PointOf(const Design& design) {
  const double reservoir_m3 = design.settings.reservoir_volume_m3.value_or(0.0);
  return {design.settings.source_pressure_pa, reservoir_m3, reservoir_m3};
}

// Strokes as slow as the period allows are looked at, too.
Problem WithoutStrokeLimits(Problem problem) {
  for (ActuatorGroup& group : problem.groups)
    group.rise_time_max_s = group.fall_time_max_s = kUnlimited;
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
               .reservoirs = Kept(all.reservoirs, ids)};
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
  rebuilt.candidate.bench = &bench;
  if (rebuilt.candidate.reservoir.index != kCustom)
    return SizeAtVolume(problem, rebuilt.candidate, ReservoirVolume(problem, rebuilt.candidate));
  CustomSizing sizing(problem, rebuilt.candidate);
  while (!bench.stopped() && !sizing.Refine()) {
  }
  return sizing.leaf();
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
  const Leaf leaf = SizeWithEffects(problem, rebuilt.candidate,
                                    design.settings.reservoir_volume_m3.value_or(0.0), stop);
  Remade remade{leaf.status, {}};
  if (leaf.status != LeafStatus::kFeasible) return remade;
  remade.design = MakeDesign(problem, rebuilt.candidate, leaf);
  if (!remade.design) remade.status = LeafStatus::kUndecided;
  return remade;
}

std::optional<std::vector<Margin>> MarginsOf(const Problem& problem, const Problem& relaxed,
                                             const Design& design) {
  Rebuilt rebuilt;
  if (!Rebuild(problem, relaxed, design, rebuilt)) return std::nullopt;
  const OperatingPoint point = PointOf(design);
  const Evaluation evaluation = Evaluate(problem, rebuilt.candidate, point);
  if (!evaluation.works) return std::nullopt;
  return Margins(problem, rebuilt.candidate, point, evaluation);
}

AtSettings EvaluateAtSettings(const Problem& problem, const Design& design) {
  const Problem free = WithoutStrokeLimits(problem);
  AtSettings found;
  Rebuilt rebuilt;
  if (!Rebuild(free, Relaxed(free), design, rebuilt)) return found;
  found.source = SourceWindow(free, rebuilt.candidate);
  const OperatingPoint point = PointOf(design);
  if (point.source_pa < found.source.low_pa || point.source_pa > found.source.high_pa) return found;
  const Evaluation evaluation = Evaluate(free, rebuilt.candidate, point);
  if (!evaluation.works) return found;
  found.design = Describe(problem, rebuilt.candidate, point, evaluation);
  if (found.design->totals.cost_eur) return found;
  for (Margin& margin : found.design->margins)  // of a part without a price no cost is known
    if (margin.requirement == "/supply/cost_eur_max")
      margin.achieved = kUnlimited, margin.relative_margin = -kUnlimited;
  return found;
}

}  // namespace plenum::optimizer
