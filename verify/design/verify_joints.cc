#include "verify/design/verify_joints.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/problem/family_specs.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_families.h"

namespace plenum::verify {
namespace {

double Pieces(int joined, const model::Manifold& row) {
  return std::ceil((joined - 1.0) / (row.stations - 1.0));
}

bool Serves(const Problem& problem, const model::Manifold& row, double pressure_pa) {
  return row.stations > 1 && row.pressure_max_pa >= pressure_pa &&
         (!AsksForPrices(problem) || row.basics.cost_eur);
}

// Whether a is taken rather than b, whatever they weigh: 1, 0 where that is open, or −1.
int Prefers(const Problem& problem, const model::Manifold& a, const model::Manifold& b,
            double asked) {
  if (problem.orderable_only && a.orderable != b.orderable) return a.orderable ? 1 : -1;
  if (a.basics.cost_eur.has_value() != b.basics.cost_eur.has_value())
    return a.basics.cost_eur ? 1 : -1;
  const double passes_a = std::min(a.sonic_conductance_m3_per_s_pa, asked);
  const double passes_b = std::min(b.sonic_conductance_m3_per_s_pa, asked);
  return passes_a > passes_b ? 1 : passes_a < passes_b ? -1 : 0;
}

// Whether so many pieces of a are taken rather than so many of b.
bool Before(const Problem& problem, double pieces_a, const model::PartBasics& a, double pieces_b,
            const model::PartBasics& b) {
  const double mass_a = pieces_a * a.mass_kg, mass_b = pieces_b * b.mass_kg;
  const double cost_a = CostInPacks(pieces_a, a), cost_b = CostInPacks(pieces_b, b);
  const Objective& by = problem.joints_by;
  const double litres_a = 1000.0 * pieces_a * a.body_volume_m3;
  const double litres_b = 1000.0 * pieces_b * b.body_volume_m3;
  const double value_a = by.mass_kg * mass_a + by.volume_l * litres_a + by.cost_eur * cost_a;
  const double value_b = by.mass_kg * mass_b + by.volume_l * litres_b + by.cost_eur * cost_b;
  if (value_a != value_b) return value_a < value_b;
  if (mass_a != mass_b) return mass_a < mass_b;
  return cost_a != cost_b ? cost_a < cost_b : a.id < b.id;
}

JointRows Join(const Problem& problem, int joined, double pressure_pa, double asked) {
  const std::vector<model::Manifold>& rows = problem.parts.manifolds;
  int best = -1;
  for (int i = 0; joined > 1 && i < static_cast<int>(rows.size()); ++i) {
    if (!Serves(problem, rows[i], pressure_pa)) continue;
    const int prefers = best < 0 ? 1 : Prefers(problem, rows[i], rows[best], asked);
    if (prefers > 0 || (prefers == 0 && Before(problem, Pieces(joined, rows[i]), rows[i].basics,
                                               Pieces(joined, rows[best]), rows[best].basics)))
      best = i;
  }
  if (best < 0) return {};
  return {{{Family::kManifold, best}, static_cast<int>(Pieces(joined, rows[best]))}};
}

double HighestOperatingPa(const Problem& problem) {
  double highest_pa = 0.0;
  for (const ActuatorGroup& group : problem.groups)
    highest_pa = std::max(highest_pa, group.chamber.operating_pressure_pa);
  return highest_pa;
}

double Asked(const Problem& problem) {
  double sum = 0.0;
  for (const ActuatorGroup& group : problem.groups) sum += group.joint_conductance_m3_per_s_pa;
  return sum;
}

}  // namespace

int Lines(const Problem& problem) {
  int lines = 0;
  for (const ActuatorGroup& group : problem.groups) lines += group.count;
  return lines;
}

JointRows JointOfLines(const Problem& problem) {
  return Join(problem, Lines(problem), HighestOperatingPa(problem), Asked(problem));
}

JointRows JointOfPieces(const Problem& problem, Family family, int part, int pieces) {
  if (pieces < 2 || part < 0) return {};
  switch (family) {
    case Family::kCylinder: {
      const model::Cylinder& cylinder = problem.parts.cylinders[part];
      return Join(problem, pieces, cylinder.fill_pressure_pa + cylinder.fill_pressure_spread_pa,
                  0.0);
    }
    case Family::kCo2:
      return Join(problem, pieces, model::Co2SaturationPressure(problem.ambient.temperature_k),
                  0.0);
    case Family::kTank:
      return Join(problem, pieces,
                  std::min(problem.parts.tanks[part].pressure_max_pa, problem.tank_fill_max_pa),
                  Asked(problem));
    case Family::kReservoir:
    case Family::kVacuumReservoir:
      return Join(problem, pieces, HighestOperatingPa(problem), Asked(problem));
    case Family::kCompressor:
    case Family::kVacuumPump:
    case Family::kEjector:
      return Join(problem, pieces, HighestOperatingPa(problem), 0.0);
    default:
      return {};
  }
}

JointRows JointOfGroup(const Problem& problem, int g) {
  const ActuatorGroup& group = problem.groups[g];
  return Join(problem, group.count, group.chamber.operating_pressure_pa,
              group.joint_conductance_m3_per_s_pa);
}

JointRows JointOfRegulators(const Problem& problem, Family family, int part) {
  const int regulators = static_cast<int>(problem.groups.size());
  switch (family) {
    case Family::kCylinder:
    case Family::kCo2:
    case Family::kTank:
      return JointOfPieces(problem, family, part, regulators);
    default:
      return {};
  }
}

JointRows JointOfRegulatorsAtMains(const Problem& problem) {
  return Join(problem, static_cast<int>(problem.groups.size()), problem.mains.pressure_pa,
              Asked(problem));
}

const model::CheckValve* CheckValveFor(const Problem& problem) {
  const model::CheckValve* best = nullptr;
  if (problem.pump_feed != PumpFeed::kPerActuator) return best;
  const auto serves = [&](const model::CheckValve& row) {
    if (AsksForPrices(problem) && !row.basics.cost_eur) return false;
    return std::all_of(problem.groups.begin(), problem.groups.end(), [&](const auto& group) {
      return row.pressure_max_pa >= group.chamber.operating_pressure_pa &&
             row.sonic_conductance_m3_per_s_pa >= group.joint_conductance_m3_per_s_pa / group.count;
    });
  };
  const double feeds = Feeds(problem);
  const auto before = [&](const model::PartBasics& a, const model::PartBasics& b) {
    if (a.cost_eur.has_value() != b.cost_eur.has_value()) return a.cost_eur.has_value();
    return Before(problem, feeds, a, feeds, b);
  };
  for (const model::CheckValve& row : problem.parts.check_valves)
    if (serves(row) && (!best || before(row.basics, best->basics))) best = &row;
  return best;
}

JointRows JointsOfFeeds(const Problem& problem, Family family, int part, int pumps) {
  JointRows all;
  for (const ActuatorGroup& group : problem.groups) {
    const bool each = problem.pump_feed == PumpFeed::kPerActuator;
    const JointRows one = each ? Join(problem, pumps + 1, group.chamber.operating_pressure_pa,
                                      group.joint_conductance_m3_per_s_pa / group.count)
                               : JointOfPieces(problem, family, part, pumps);
    for (const auto& [row, pieces] : one) all[row] += pieces * (each ? group.count : 1);
  }
  const bool lets_back = PumpsIn(problem.parts, family)[part].check_valve_cracking_pa.has_value();
  if (const model::CheckValve* valve = lets_back ? CheckValveFor(problem) : nullptr)
    all[{Family::kCheckValve, static_cast<int>(valve - problem.parts.check_valves.data())}] =
        Feeds(problem);
  return all;
}

JointRows JointsOf(const Problem& problem, const Design& design) {
  const bool own = HasOwnRegulators(design.parts);
  JointRows all;
  const auto add = [&](const JointRows& rows) {
    for (const auto& [row, pieces] : rows) all[row] += pieces;
  };
  const bool shared = problem.pump_feed == PumpFeed::kShared;
  if (!own && shared) add(JointOfLines(problem));
  for (int g = 0; (own || problem.pump_feed == PumpFeed::kPerGroup) &&
                  g < static_cast<int>(problem.groups.size());
       ++g)
    add(JointOfGroup(problem, g));
  if (own && design.configuration == Configuration::kMains) add(JointOfRegulatorsAtMains(problem));
  for (const Choice& row : design.parts) {
    if (row.group >= 0) continue;
    const int part = FindPart(problem.parts, row.family, row.id);
    const int pieces = static_cast<int>(row.quantity);
    if (shared)
      add(JointOfPieces(problem, row.family, part, pieces));
    else if (row.family == PumpFamily(design.configuration))
      add(JointsOfFeeds(problem, row.family, part, pieces / Feeds(problem)));
    if (own) add(JointOfRegulators(problem, row.family, part));
  }
  return all;
}

}  // namespace plenum::verify
