#include "optimizer/problem/joints.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "model/physics/storage.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/gait.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

int PiecesFor(int joined, const model::Manifold& manifold) {
  return (joined - 1 + manifold.stations - 2) / (manifold.stations - 1);
}

// What orders the rows that may be taken.
auto KeyOf(const Problem& problem, const model::PartBasics& one, int quantity) {
  const Objective& by = problem.joints_by;
  const double mass_kg = quantity * one.mass_kg, cost_eur = PackCost(quantity, one);
  const double volume_l = 1000.0 * quantity * one.body_volume_m3;
  return std::tuple(by.mass_kg * mass_kg + by.volume_l * volume_l + by.cost_eur * cost_eur, mass_kg,
                    cost_eur, one.id);
}

std::optional<Joint> Least(const Problem& problem, int joined, double pressure_pa,
                           double conductance_m3_per_s_pa) {
  if (joined < 2) return std::nullopt;
  const std::vector<model::Manifold>& rows = problem.parts.manifolds;
  const auto some = [&](const auto& does) { return std::any_of(rows.begin(), rows.end(), does); };
  const auto serves = [&](const model::Manifold& row) {
    return row.stations >= 2 && row.pressure_max_pa >= pressure_pa &&
           (!PricesNeeded(problem) || row.basics.cost_eur);
  };
  const bool products = problem.orderable_only && some([&](const model::Manifold& row) {
                          return serves(row) && row.orderable;
                        });
  const auto is_choice = [&](const model::Manifold& row) {
    return serves(row) && (!products || row.orderable);
  };
  const bool priced =
      some([&](const model::Manifold& row) { return is_choice(row) && row.basics.cost_eur; });
  const auto may = [&](const model::Manifold& row) {
    return is_choice(row) && (!priced || row.basics.cost_eur);
  };
  double most = 0.0;
  for (const model::Manifold& row : rows)
    if (may(row)) most = std::max(most, row.sonic_conductance_m3_per_s_pa);
  std::optional<Joint> best;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    if (!may(rows[i]) ||
        rows[i].sonic_conductance_m3_per_s_pa < std::min(conductance_m3_per_s_pa, most))
      continue;
    const Joint joint{Family::kManifold, i, PiecesFor(joined, rows[i])};
    if (!best || KeyOf(problem, rows[i].basics, joint.quantity) <
                     KeyOf(problem, rows[best->part].basics, best->quantity))
      best = joint;
  }
  return best;
}

// What joins some pieces must stand; of regulators what the mains have.
double PressureOf(const Problem& problem, Family family, int part) {
  const model::Parts& parts = problem.parts;
  switch (family) {
    case Family::kCylinder:
      return parts.cylinders[part].fill_pressure_pa + parts.cylinders[part].fill_pressure_spread_pa;
    case Family::kCo2:
      return model::Co2SaturationPressure(problem.ambient.temperature_k);
    case Family::kTank:
      return std::min(parts.tanks[part].pressure_max_pa, problem.tank_fill_max_pa);
    case Family::kRegulator:
      return problem.mains.pressure_pa;
    default: {
      double operating_pa = 0.0;
      for (const ActuatorGroup& group : problem.groups)
        operating_pa = std::max(operating_pa, group.chamber.operating_pressure_pa);
      return operating_pa;
    }
  }
}

bool MayBeJoined(Family family) {
  const FamilySpec& spec = SpecOf(family);
  return !spec.in_line && !spec.joins && family != Family::kBattery;
}

// Pumps fill a tank, or keep a vacuum.
bool MayFeedRegulators(Family family) {
  return !IsPump(family) && family != Family::kVacuumReservoir;
}

// ── check valves ──

auto RankOf(const Problem& problem, const model::CheckValve& row) {
  return std::tuple(!row.basics.cost_eur, KeyOf(problem, row.basics, FeedsOf(problem)));
}

model::MonotoneCurve Lowered(const model::MonotoneCurve& curve, double by_pa) {
  std::vector<double> pressures_pa(curve.x().begin(), curve.x().end());
  for (double& pressure_pa : pressures_pa) pressure_pa -= by_pa;
  return {std::move(pressures_pa), {curve.y().begin(), curve.y().end()}};
}

void Fit(const model::CheckValve* valve, std::vector<model::Compressor>& pumps) {
  if (!valve)
    std::erase_if(pumps, [](const model::Compressor& pump) {
      return pump.check_valve_cracking_pa.has_value();
    });
  for (model::Compressor& pump : pumps) {
    if (!pump.check_valve_cracking_pa ||
        *pump.check_valve_cracking_pa == valve->cracking_pressure_pa)
      continue;
    const double by_pa = valve->cracking_pressure_pa - *pump.check_valve_cracking_pa;
    model::CompressorCurve& curve = pump.curve;
    curve.free_air_m3_per_s = Lowered(curve.free_air_m3_per_s, by_pa);
    if (!curve.current_a.empty()) curve.current_a = Lowered(curve.current_a, by_pa);
    curve.pressure_max_pa -= by_pa;
    pump.check_valve_cracking_pa = valve->cracking_pressure_pa;
  }
}

void NeedNone(std::vector<model::Compressor>& pumps) {
  for (model::Compressor& pump : pumps) pump.check_valve_cracking_pa.reset();
}

}  // namespace

int LineCount(const Problem& problem) {
  int lines = 0;
  for (const ActuatorGroup& group : problem.groups) lines += group.count;
  return lines;
}

double JointConductance(const Problem& problem, int g) {
  const ActuatorGroup& group = problem.groups[g];
  const model::Chamber& chamber = group.chamber;
  const double at_rest_pa = model::RestPa(chamber);
  const double inside_pa =
      std::abs(model::MirrorPa(chamber) - chamber.operating_pressure_pa);  // as it is
  const double upstream_pa =
      chamber.evacuated ? (at_rest_pa - inside_pa) / std::log(at_rest_pa / inside_pa) : inside_pa;
  const double air_m3 = (model::Content(chamber, chamber.operating_pressure_pa) -
                         model::Content(chamber, at_rest_pa)) *
                        model::StandardVolume(1.0, problem.ambient.temperature_k);
  return kJointFactor * group.count * air_m3 / (RiseWindow(problem, g) * upstream_pa);
}

double JointConductance(const Problem& problem) {
  double sum = 0.0;
  for (const ActuatorGroup& group : problem.groups) sum += group.joint_conductance_m3_per_s_pa;
  return sum;
}

std::optional<Joint> JointOfLines(const Problem& problem) {
  return Least(problem, LineCount(problem), PressureOf(problem, Family::kReservoir, 0),
               JointConductance(problem));
}

std::optional<Joint> JointOfLines(const Problem& problem, int g) {
  const ActuatorGroup& group = problem.groups[g];
  return Least(problem, group.count, group.chamber.operating_pressure_pa,
               group.joint_conductance_m3_per_s_pa);
}

std::optional<Joint> JointOfOwnRegulators(const Problem& problem, Family family, int part) {
  if (!MayFeedRegulators(family)) return std::nullopt;
  const bool bottle = family == Family::kCylinder || family == Family::kCo2;
  return Least(problem, static_cast<int>(problem.groups.size()), PressureOf(problem, family, part),
               bottle ? 0.0 : JointConductance(problem));
}

std::optional<Joint> JointOfPieces(const Problem& problem, Family family, int part, int quantity) {
  if (quantity < 2 || !MayBeJoined(family)) return std::nullopt;
  const bool drawn_from = CatalogueFamily(family) == Family::kReservoir;
  return Least(problem, quantity, PressureOf(problem, family, part),
               drawn_from ? JointConductance(problem) : 0.0);
}

int CheckValveOf(const Problem& problem, const model::Parts& parts) {
  double stands_pa = 0.0, passes = 0.0;
  for (const ActuatorGroup& group : problem.groups) {
    stands_pa = std::max(stands_pa, group.chamber.operating_pressure_pa);
    passes = std::max(passes, group.joint_conductance_m3_per_s_pa / group.count);
  }
  const std::vector<model::CheckValve>& rows = parts.check_valves;
  int best = -1;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const model::CheckValve& row = rows[i];
    const bool serves = row.pressure_max_pa >= stands_pa &&
                        row.sonic_conductance_m3_per_s_pa >= passes &&
                        (!PricesNeeded(problem) || row.basics.cost_eur);
    if (serves && (best < 0 || RankOf(problem, row) < RankOf(problem, rows[best]))) best = i;
  }
  return best;
}

void FitCheckValves(const Problem& problem, model::Parts& parts) {
  if (problem.pump_feed != PumpFeed::kPerActuator) {
    parts.check_valves.clear();
    NeedNone(parts.compressors);
    return NeedNone(parts.vacuum_pumps);
  }
  const int index = CheckValveOf(problem, parts);
  const model::CheckValve* valve = index < 0 ? nullptr : &parts.check_valves[index];
  Fit(valve, parts.compressors);
  Fit(valve, parts.vacuum_pumps);
}

std::vector<Joint> JointsOfFeeds(const Problem& problem, Family family, int part, int quantity) {
  std::vector<Joint> joints;
  const auto add = [&](std::optional<Joint> joint, int times) {
    if (!joint) return;
    joint->quantity *= times;
    joints.push_back(*joint);
  };
  if (problem.pump_feed != PumpFeed::kPerActuator) {
    add(JointOfPieces(problem, family, part, quantity), FeedsOf(problem));
    return joints;
  }
  for (const ActuatorGroup& group : problem.groups)
    add(Least(problem, quantity + 1, group.chamber.operating_pressure_pa,
              group.joint_conductance_m3_per_s_pa / group.count),
        group.count);
  if (PumpsIn(problem.parts, family)[part].check_valve_cracking_pa)
    if (const int valve = CheckValveOf(problem, problem.parts); valve >= 0)
      joints.push_back({Family::kCheckValve, valve, FeedsOf(problem)});
  return joints;
}

std::vector<Joint> JointsOf(const Problem& problem, const std::vector<Choice>& rows) {
  std::vector<Joint> joints;
  const auto add = [&](const std::optional<Joint>& joint) {
    if (!joint) return;
    const auto same = std::find_if(joints.begin(), joints.end(), [&](const Joint& other) {
      return other.family == joint->family && other.part == joint->part;
    });
    if (same == joints.end())
      joints.push_back(*joint);
    else
      same->quantity += joint->quantity;
  };
  const bool own = HasOwnRegulators(rows);
  const bool shared = problem.pump_feed == PumpFeed::kShared;
  if (!own && shared) add(JointOfLines(problem));
  for (int g = 0; (own || problem.pump_feed == PumpFeed::kPerGroup) &&
                  g < static_cast<int>(problem.groups.size());
       ++g)
    add(JointOfLines(problem, g));
  bool joined = false;  // the regulators
  for (const Choice& row : rows) {
    if (row.group >= 0 || !MayBeJoined(row.family)) continue;
    const int part = FindPart(problem.parts, row.family, row.id);
    if (part < 0) continue;
    const int pieces = static_cast<int>(row.quantity);
    if (shared) add(JointOfPieces(problem, row.family, part, pieces));
    if (!shared && SpecOf(row.family).kind_role == KindRole::kSource)
      for (const Joint& joint : JointsOfFeeds(problem, row.family, part, pieces / FeedsOf(problem)))
        add(joint);
    if (own) add(JointOfOwnRegulators(problem, row.family, part));
    joined = joined || MayFeedRegulators(row.family);
  }
  if (own && !joined) add(JointOfOwnRegulators(problem, Family::kRegulator, 0));
  return joints;
}

}  // namespace plenum::optimizer
