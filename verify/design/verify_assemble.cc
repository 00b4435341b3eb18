// Parts of a design, whether they fit, and what they weigh, take and cost.
#include <algorithm>
#include <set>

#include "model/flow/tube.h"
#include "model/physics/storage.h"
#include "optimizer/problem/pump_feed.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_joints.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

std::string Row(const Choice& choice) { return std::string(Name(choice.family)) + " " + choice.id; }

// The part of a row; none where the problem has no such part.
std::optional<ProofItem> ItemOf(const Problem& problem, const Choice& choice) {
  if (choice.id == "custom" && MadeToMeasureAllowed(problem, choice.family))
    return ProofItem{-2, 1};
  const int part = FindPart(problem.parts, choice.family, choice.id);
  if (part < 0) return std::nullopt;
  const int times = TimesBought(problem, choice.family);
  return ProofItem{part, choice.group < 0 ? static_cast<int>(choice.quantity) / times : 1};
}

// Pieces that a row of a group must have: metres of tube, fittings, valves with their channels.
double LineQuantity(const ActuatorGroup& group, const Choice& choice, const LineParts& line) {
  if (choice.family == Family::kRegulator) return 1.0;
  if (choice.family == Family::kTubing) return group.count * group.tube_length_m;
  if (choice.family == Family::kFitting) return group.count * group.fittings_per_line;
  return std::ceil(static_cast<double>(group.count) / line.valve->channels);
}

bool IsSourceQuantity(const Problem& problem, const Choice& choice, const ProofItem& item) {
  return item.quantity * TimesBought(problem, choice.family) == choice.quantity &&
         item.quantity >= 1 && item.quantity <= QuantityMax(problem, choice.family);
}

bool Whole(const Problem& problem, const Assembly& a) {
  for (std::size_t g = 0; g < a.lines.size(); ++g)
    if (!a.lines[g].tube || !a.lines[g].valve ||
        (problem.groups[g].fittings_per_line > 0) != (a.lines[g].fitting != nullptr))
      return false;
  const Configuration c = a.configuration;
  const bool pump = IsPumped(c);
  const bool tank = HasTank(c), filler = c == Configuration::kTankAndPump;
  if (std::count(a.regulators.begin(), a.regulators.end(), nullptr) > 0 ||
      (a.owns() && a.regulators.size() != a.lines.size()))
    return false;
  return (c == Configuration::kTank || a.regulators.empty() == pump) &&
         (a.tank != nullptr) == tank && (a.filler() != nullptr) == filler &&
         (a.pump() != nullptr) == pump && (a.reservoirs > 0) == KeepsReservoir(c) &&
         (a.battery != nullptr) == (c != Configuration::kMains) &&
         (a.rail.pump != nullptr) == PumpsRail(problem) &&
         (a.rail.reservoir != nullptr) == PumpsRail(problem) &&
         (a.cylinder != nullptr) == (c == Configuration::kCylinder) &&
         (a.co2 != nullptr) == (c == Configuration::kCo2);
}

// The part's numbers behind a row; gas on board comes on top of the mass.
struct Expected {
  double mass_kg = 0.0, volume_m3 = 0.0;
  const model::PartBasics* part = nullptr;  // so many pieces of it; null: made to measure
  double pieces = 0.0;
  double mass_slack_kg = 0.0, volume_slack_m3 = 0.0;
};

Expected Times(double quantity, const model::PartBasics& basics, double gas_kg = 0.0) {
  return {quantity * (basics.mass_kg + gas_kg),
          quantity * basics.body_volume_m3,
          &basics,
          quantity,
          quantity * basics.mass_slack_kg,
          quantity * basics.body_volume_slack_m3};
}

// Built for the pressure at which its pumps stop.
Expected Made(const Problem& problem, const Settings& settings) {
  const model::MadeReservoir made =
      model::MakeReservoir(settings.reservoir_volume_m3.value_or(0.0),
                           settings.source_pressure_pa - problem.ambient.pressure_pa);
  const double share = problem.guarantee ? problem.guarantee->made_share : 0.0;
  return {made.mass_kg, made.body_volume_m3,  nullptr,
          1.0,          share * made.mass_kg, share * made.body_volume_m3};
}

Expected Filled(const Problem& problem, int quantity, const model::Cylinder& cylinder) {
  return Times(quantity, cylinder.basics,
               model::CylinderCharge(cylinder.water_volume_m3, cylinder.fill_pressure_pa,
                                     problem.ambient.temperature_k));
}

// Of a fill that is not known the least air that there may be.
Expected Filled(const Problem& problem, int quantity, const model::Reservoir& tank,
                const Settings& settings) {
  return Times(quantity, tank.basics,
               ChargeKg(problem, tank, settings.tank_fill_pa.value_or(LeastLeftPa(problem))));
}

Expected ExpectedRow(const Problem& problem, const Design& design, const Choice& choice) {
  const int part = ItemOf(problem, choice)->part;
  if (part < 0) return Made(problem, design.settings);
  double gas_kg = 0.0;
  if (choice.family == Family::kCylinder)
    return Filled(problem, static_cast<int>(choice.quantity), problem.parts.cylinders[part]);
  if (choice.family == Family::kTank)
    return Filled(problem, static_cast<int>(choice.quantity), problem.parts.tanks[part],
                  design.settings);
  if (choice.family == Family::kCo2) gas_kg = problem.parts.co2[part].co2_mass_kg;
  return Times(choice.quantity, BasicsOf(problem.parts, choice.family, part), gas_kg);
}

// Each joint that lines and pieces need is a row, and no other.
void CheckJoints(const Problem& problem, const Design& design, Findings& findings) {
  JointRows needed = JointsOf(problem, design);
  for (const Choice& row : design.parts) {
    if (!SpecOf(row.family).joins) continue;
    const auto found = needed.find({row.family, FindPart(problem.parts, row.family, row.id)});
    if (found != needed.end() && row.group < 0 && found->second == row.quantity)
      needed.erase(found);
    else
      findings.push_back({"parts", Row(row) + " is not what joins the lines or the source"});
  }
  for (const auto& [row, pieces] : needed)
    findings.push_back({"parts", std::string(SpecOf(row.first).name) + " " +
                                     BasicsOf(problem.parts, row.first, row.second).id +
                                     ", which lines or pieces of the source need, is missing"});
}

// Pumps that let air back have a check valve, and their curves have lost what it asks to open.
void CheckCracking(const Problem& problem, const Assembly& assembly, Findings& findings) {
  if (!assembly.compressor || !assembly.compressor->check_valve_cracking_pa) return;
  const model::CheckValve* valve = CheckValveFor(problem);
  if (!valve || valve->cracking_pressure_pa != *assembly.compressor->check_valve_cracking_pa)
    findings.push_back({"parts", assembly.compressor->basics.id +
                                     " lets air back, and is not what it is behind a check valve"});
}

bool SameCost(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || Near(*a, *b, kSumTolerance));
}

// Each kind of piece of a design, all of them together.
template <typename Add>
void ForEachRow(const Problem& problem, const Assembly& a, const Settings& settings,
                const Add& add) {
  for (std::size_t g = 0; g < a.lines.size(); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const LineParts& line = a.lines[g];
    add(Times(group.count * group.tube_length_m, line.tube->per_metre));
    if (line.fitting) add(Times(group.count * group.fittings_per_line, line.fitting->basics));
    add(Times(std::ceil(static_cast<double>(group.count) / line.valve->channels),
              line.valve->basics));
  }
  for (const model::Regulator* regulator : a.regulators) add(Times(1, regulator->basics));
  const auto join = [&](const JointRows& rows) {
    for (const auto& [row, pieces] : rows)
      add(Times(pieces, BasicsOf(problem.parts, row.first, row.second)));
  };
  const bool shared = problem.pump_feed == PumpFeed::kShared;
  if (!a.owns() && shared) join(JointOfLines(problem));
  for (int g = 0; (a.owns() || problem.pump_feed == PumpFeed::kPerGroup) &&
                  g < static_cast<int>(a.lines.size());
       ++g)
    join(JointOfGroup(problem, g));
  if (a.owns() && a.configuration == Configuration::kMains) join(JointOfRegulatorsAtMains(problem));
  const auto join_pieces = [&](Family family, const auto& parts, const auto* part, int pieces) {
    if (!part) return;
    const int index = static_cast<int>(part - parts.data());
    join(shared                                  ? JointOfPieces(problem, family, index, pieces)
         : family == PumpFamily(a.configuration) ? JointsOfFeeds(problem, family, index, pieces)
                                                 : JointRows{});
    if (a.owns()) join(JointOfRegulators(problem, family, index));
  };
  const model::Parts& parts = problem.parts;
  join_pieces(Family::kCylinder, parts.cylinders, a.cylinder, a.bottles);
  join_pieces(Family::kCo2, parts.co2, a.co2, a.bottles);
  join_pieces(Family::kTank, parts.tanks, a.tank, a.tanks);
  join_pieces(PumpFamily(a.configuration), PumpsOf(problem, a.configuration), a.compressor,
              a.compressors);
  join_pieces(Family::kReservoir, parts.reservoirs, a.reservoir, a.reservoirs);
  join_pieces(Family::kVacuumPump, parts.vacuum_pumps, a.rail.pump, a.rail.pumps);
  join_pieces(Family::kVacuumReservoir, parts.reservoirs, a.rail.reservoir, a.rail.reservoirs);
  if (a.rail.pump) add(Times(a.rail.pumps, a.rail.pump->basics));
  if (a.rail.reservoir) add(Times(a.rail.reservoirs, a.rail.reservoir->basics));
  if (a.cylinder) add(Filled(problem, a.bottles, *a.cylinder));
  if (a.tank) add(Filled(problem, a.tanks, *a.tank, settings));
  if (a.co2) add(Times(a.bottles, a.co2->basics, a.co2->co2_mass_kg));
  if (a.compressor) add(Times(a.compressors * Feeds(problem), a.compressor->basics));
  if (a.battery) add(Times(a.batteries, a.battery->basics));
  if (a.reservoir)
    add(Times(a.reservoirs, a.reservoir->basics));
  else if (a.pump() && !a.direct())
    add(Made(problem, settings));
}

}  // namespace

model::Chamber ChamberOf(const ActuatorGroup& group, const LineParts& line) {
  model::Chamber chamber = group.chamber;
  chamber.dead_volume_m3 += model::BoreVolume(line.tube->inner_diameter_m, group.tube_length_m);
  return chamber;
}

double ObjectiveOf(const Problem& problem, const Totals& totals) {
  const Objective& weight = problem.objective;
  return weight.mass_kg * totals.mass_kg + weight.volume_l * totals.volume_m3 * 1e3 +
         weight.cost_eur * totals.cost_known_eur +
         weight.energy_wh * totals.energy_j / optimizer::kJoulePerWattHour;
}

Totals TotalsOf(const Problem& problem, const Assembly& a, const Settings& settings) {
  Totals totals;
  PackedCosts costs;
  ForEachRow(problem, a, settings, [&](const Expected& part) {
    totals.mass_kg += part.mass_kg;
    totals.volume_m3 += part.volume_m3;
    costs.Add(part.part, part.pieces);
  });
  totals.cost_known_eur = costs.Sum();
  if (costs.known()) totals.cost_eur = totals.cost_known_eur;
  return totals;
}

Totals SlackOf(const Problem& problem, const Assembly& a, const Settings& settings) {
  Totals slack;
  ForEachRow(problem, a, settings, [&](const Expected& part) {
    slack.mass_kg += part.mass_slack_kg;
    slack.volume_m3 += part.volume_slack_m3;
  });
  return slack;
}

bool Fit(const model::Tubing& tube, const model::Fitting& fitting) {
  return std::abs(tube.outer_diameter_m - fitting.tube_outer_diameter_m) <= 0.05e-3;
}

bool Fit(const model::Fitting& fitting, const model::Valve& valve) {
  return fitting.thread == valve.port;
}

bool Fit(const Problem& problem, const Assembly& source) {
  if (source.rail.pump && source.battery &&
      !model::VoltageMatches(source.battery->nominal_voltage_v, source.rail.pump->curve.voltage_v))
    return false;
  if (source.compressor)
    return AirSuffices(problem, *source.compressor, source.compressors) &&
           model::VoltageMatches(source.battery->nominal_voltage_v,
                                 source.compressor->curve.voltage_v);
  if (HasTank(source.configuration)) return true;  // its fill is a setting
  // A cylinder may be fuller than the regulator needs; other supplies have one pressure.
  const double inlet_pa =
      source.cylinder ? source.cylinder->fill_pressure_pa + source.cylinder->fill_pressure_spread_pa
      : source.co2    ? model::Co2SaturationPressure(problem.ambient.temperature_k)
                      : problem.mains.pressure_pa;
  return std::all_of(source.regulators.begin(), source.regulators.end(),
                     [&](const model::Regulator* regulator) {
                       return inlet_pa <= regulator->inlet_pressure_max_pa &&
                              (source.cylinder || regulator->inlet_pressure_min_pa <= inlet_pa);
                     });
}

void Place(const Problem& problem, Family family, int group, const ProofItem& item, Assembly& a) {
  const model::Parts& parts = problem.parts;
  const auto put = [&](const auto& of_family, auto& place) {
    if (item.part >= 0) place = &of_family[item.part];
  };
  switch (family) {
    case Family::kTubing:
      return put(parts.tubing, a.lines[group].tube);
    case Family::kFitting:
      return put(parts.fittings, a.lines[group].fitting);
    case Family::kValve:
      return put(parts.valves, a.lines[group].valve);
    case Family::kRegulator:
      if (item.part < 0) return;
      a.regulators.resize(group < 0 ? 1 : a.lines.size());
      return put(parts.regulators, a.regulators[std::max(group, 0)]);
    case Family::kCylinder:
      a.bottles = item.quantity;
      return put(parts.cylinders, a.cylinder);
    case Family::kCo2:
      a.bottles = item.quantity;
      return put(parts.co2, a.co2);
    case Family::kVacuumPump:
      if (PumpsRail(problem)) {
        a.rail.pumps = item.quantity;
        return put(parts.vacuum_pumps, a.rail.pump);
      }
      [[fallthrough]];
    case Family::kCompressor:
    case Family::kEjector:
      a.compressors = item.quantity;
      return put(PumpsIn(parts, family), a.compressor);
    case Family::kBattery:
      a.batteries = item.quantity;
      return put(parts.batteries, a.battery);
    case Family::kReservoir:
      a.reservoirs = item.quantity;
      return put(parts.reservoirs, a.reservoir);
    case Family::kVacuumReservoir:
      a.rail.reservoirs = item.quantity;
      return put(parts.reservoirs, a.rail.reservoir);
    case Family::kTank:
      a.tanks = item.quantity;
      return put(parts.tanks, a.tank);
    case Family::kManifold:
    case Family::kCheckValve:
      return;
  }
}

std::optional<Assembly> Assemble(const Problem& problem, const Design& design, Findings& findings) {
  Assembly assembly;
  assembly.configuration = design.configuration;
  assembly.lines.resize(problem.groups.size());
  const std::size_t before = findings.size();
  if (!problem.configurations.contains(design.configuration))
    findings.push_back(
        {"parts", std::string(Name(design.configuration)) + " is not a requested configuration"});
  std::set<std::pair<Family, int>> placed;
  for (const Choice& choice : design.parts) {
    if (SpecOf(choice.family).joins) continue;
    const bool in_line = choice.group >= 0;
    const auto item = ItemOf(problem, choice);
    const bool own = in_line && choice.family == Family::kRegulator;
    bool allowed = item && (own || SpecOf(choice.family).in_line == in_line) &&
                   placed.insert({choice.family, choice.group}).second;
    if (allowed) {
      Place(problem, choice.family, choice.group, *item, assembly);
      allowed = in_line ? Near(choice.quantity,
                               LineQuantity(problem.groups[choice.group], choice,
                                            assembly.lines[choice.group]),
                               kSumTolerance)
                        : IsSourceQuantity(problem, choice, *item);
    }
    if (allowed) continue;
    findings.push_back(
        {"parts",
         Row(choice) + (in_line ? " of group " + problem.groups[choice.group].name +
                                      " is not an allowed part in the number it needs"
                                : " is not an allowed part of the source in this number")});
  }
  const std::vector<Layout> asked = LayoutsOf(problem, design.configuration);
  if (findings.size() == before &&
      std::find(asked.begin(), asked.end(), LayoutOf(design)) == asked.end())
    findings.push_back({"parts", "regulators are not as the request has it"});
  if (findings.size() == before && !Whole(problem, assembly))
    findings.push_back({"parts", std::string("the list of parts of a ") +
                                     Name(design.configuration) + " design is not complete"});
  if (findings.size() != before) return std::nullopt;
  return assembly;
}

void CheckAmounts(const Problem& problem, const Design& design, const Assembly& assembly,
                  Findings& findings) {
  for (const LineParts& line : assembly.lines)
    if (line.fitting && (!Fit(*line.tube, *line.fitting) || !Fit(*line.fitting, *line.valve)))
      findings.push_back(
          {"parts", "fitting " + line.fitting->basics.id + " does not fit its tube " + "or valve"});
  if (!Fit(problem, assembly)) findings.push_back({"parts", "parts of the source do not fit"});
  CheckJoints(problem, design, findings);
  CheckCracking(problem, assembly, findings);
  CheckPacks(problem, design, findings);
  Totals sum;
  double cost_eur = 0.0;
  bool priced = true;
  const std::vector<std::optional<double>> costs_eur = RowCosts(problem, design);
  for (std::size_t i = 0; i < design.parts.size(); ++i) {
    const Choice& choice = design.parts[i];
    if (!ItemOf(problem, choice)) continue;  // a joint that there is not, told above
    const Expected row = ExpectedRow(problem, design, choice);
    if (!Near(choice.mass_kg, row.mass_kg, kSumTolerance) ||
        !Near(choice.volume_m3, row.volume_m3, kSumTolerance) ||
        !SameCost(choice.cost_eur, costs_eur[i]))
      findings.push_back({"amounts", Row(choice) + ": mass, volume or cost is not the part's"});
    sum.mass_kg += row.mass_kg;
    sum.volume_m3 += row.volume_m3;
    cost_eur += costs_eur[i].value_or(0.0);
    priced = priced && costs_eur[i].has_value();
  }
  if (priced) sum.cost_eur = cost_eur;
  const Totals& totals = design.totals;
  if (!Near(totals.mass_kg, sum.mass_kg, kSumTolerance) ||
      !Near(totals.volume_m3, sum.volume_m3, kSumTolerance) ||
      !SameCost(totals.cost_eur, sum.cost_eur) ||
      !Near(totals.cost_known_eur, cost_eur, kSumTolerance))
    findings.push_back({"amounts", "totals are not the sums of the parts"});
  const double objective = ObjectiveOf(problem, totals);
  if (!Near(design.objective, objective, kSumTolerance))
    findings.push_back({"amounts", "the objective is not that of the totals"});
  if (AsksForPrices(problem) && !totals.cost_eur)
    findings.push_back({"amounts", "a part without a price where cost matters"});
}

}  // namespace plenum::verify
