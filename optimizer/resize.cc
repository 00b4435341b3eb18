#include "optimizer/resize.h"

#include <algorithm>
#include <set>

#include "model/storage.h"

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
bool Matches(const std::vector<Part>& parts, int index, const Choice* choice) {
  return choice == nullptr ? index < 0 : index >= 0 && IdOf(parts[index]) == choice->id;
}

const Line* FindLine(const Problem& problem, const Design& design, int group,
                     const LineSet& lines) {
  for (const Line& line : lines.lines)
    if (Matches(problem.parts.valves, line.valve, ChoiceOf(design, Family::kValve, group)) &&
        Matches(problem.parts.fittings, line.fitting, ChoiceOf(design, Family::kFitting, group)) &&
        Matches(problem.parts.tubing, line.tubing, ChoiceOf(design, Family::kTubing, group)))
      return &line;
  return nullptr;
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

Leaf Resize(const Problem& problem, const Design& design) {
  Leaf infeasible;
  infeasible.status = LeafStatus::kInfeasible;
  const model::Parts& parts = problem.parts;
  const model::Gas gas =
      design.configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
  Candidate candidate;
  candidate.configuration = design.configuration;
  std::vector<LineSet> lines;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    lines.push_back(EnumerateLines(problem, g, gas));
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line* line = FindLine(problem, design, g, lines[g]);
    if (line == nullptr) return infeasible;
    candidate.lines.push_back(line);
  }
  if (!SetOptions(problem, design, candidate)) return infeasible;
  if (candidate.reservoir.index != kCustom)
    return SizeAtVolume(
        problem, candidate,
        candidate.reservoir.index == kNone
            ? 0.0
            : candidate.reservoir.quantity * parts.reservoirs[candidate.reservoir.index].volume_m3);
  const PumpFacts facts =
      MakePumpFacts(problem, parts.compressors[candidate.compressor.index].curve);
  CustomSizing sizing(problem, facts, candidate);
  while (!sizing.Refine()) {
  }
  return sizing.leaf();
}

}  // namespace plenum::optimizer
