#include "api/design/read/worst_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/selection.h"
#include "api/json/units.h"
#include "model/physics/storage.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

bool IsMass(std::string_view field) { return field.starts_with("mass_kg"); }
bool IsRatio(std::string_view field) { return field.starts_with("critical_ratio"); }

// What the tables of the families leave to rules.
Worst WorstByRule(std::string_view family, std::string_view field) {
  if (field == "pressure_max_kpa_gauge" || field == "co2_mass_kg") return Worst::kLow;
  if (field == "vacuum_max_kpa_gauge") return Worst::kHigh;  // below 0
  // Gas that stays behind in a CO2 bottle fills its volume.
  if (field == "water_volume_l") return family == "co2" ? Worst::kHigh : Worst::kLow;
  return Worst::kExact;
}

double ValueOf(const catalog::Part& row, std::string_view field) {
  const auto found = row.numbers.find(std::string(field));
  return found == row.numbers.end() ? 0.0 : found->second.value;
}

// The row with each number that has one worst end at that.
catalog::Part AtWorst(catalog::Part row, const Tolerance& tolerance, const Settled& settled) {
  for (auto& [field, number] : row.numbers) {
    const Worst worst = WorstOf(row.family, field);
    const double width = HalfWidth(row, field, tolerance, settled);
    if (worst == Worst::kLow || worst == Worst::kBothEnds)
      number.value = WithinRange(row, field, number.value - width * std::abs(number.value));
    if (worst == Worst::kHigh)
      number.value = WithinRange(row, field, number.value + width * std::abs(number.value));
  }
  if (row.curve) {
    const double less = 1.0 - HalfWidth(row, "free_air", tolerance, settled);
    const double more = 1.0 + HalfWidth(row, "current", tolerance, settled);
    for (catalog::CurvePoint& point : row.curve->points) {
      point.free_air_l_per_min *= less;
      point.current_a *= more;
    }
  }
  return row;
}

// What the part may weigh and take beyond what is printed.
void AddSlack(const catalog::Part& row, const Tolerance& tolerance, const Settled& settled,
              model::PartBasics& basics) {
  for (const char* mass : {"mass_kg", "mass_kg_per_m"})
    if (row.numbers.contains(mass))
      basics.mass_slack_kg += ValueOf(row, mass) * HalfWidth(row, mass, tolerance, settled);
  basics.body_volume_slack_m3 = M3FromMl(ValueOf(row, "body_volume_ml")) *
                                HalfWidth(row, "body_volume_ml", tolerance, settled);
}

// Ranks with the gas of a full bottle as printed, limits with the most.
void SetCharge(const catalog::Part& row, const Tolerance& tolerance, const Settled& settled,
               const model::Ambient& ambient, model::Cylinder& cylinder) {
  const double volume_width = HalfWidth(row, "water_volume_l", tolerance, settled);
  const double fill_width = HalfWidth(row, "fill_pressure_kpa_gauge", tolerance, settled);
  const double water_m3 = M3FromL(ValueOf(row, "water_volume_l"));
  const double fill_kpa = ValueOf(row, "fill_pressure_kpa_gauge");
  const auto charge_kg = [&](double sign) {
    return model::CylinderCharge(water_m3 * (1.0 + sign * volume_width),
                                 PaFromKpaGauge(fill_kpa * (1.0 + sign * fill_width), ambient),
                                 ambient.temperature_k);
  };
  cylinder.basics.mass_kg += charge_kg(0.0) - charge_kg(-1.0);
  cylinder.basics.mass_slack_kg += charge_kg(1.0) - charge_kg(0.0);
  cylinder.fill_pressure_spread_pa =
      PaFromKpaGauge(fill_kpa * (1.0 + fill_width), ambient) - cylinder.fill_pressure_pa;
}

void SetCharge(const catalog::Part& row, const Tolerance& tolerance, const Settled& settled,
               model::Co2Bottle& bottle) {
  const double charge_kg = ValueOf(row, "co2_mass_kg");
  bottle.basics.mass_kg += charge_kg - bottle.co2_mass_kg;
  bottle.basics.mass_slack_kg += charge_kg * HalfWidth(row, "co2_mass_kg", tolerance, settled);
}

// What an element of the row passes at most: `of` is "" or "_fill".
model::FlowElement MostFlow(catalog::Part row, const std::string& of, const Tolerance& tolerance,
                            const Settled& settled) {
  const std::string conductance = "sonic_conductance" + of + "_dm3_per_s_bar",
                    ratio = "critical_ratio" + of;
  const catalog::Part printed = row;
  for (const std::string& field : {conductance, ratio}) {
    double& value = row.numbers.at(field).value;
    value = WithinRange(row, field, value * (1.0 + HalfWidth(printed, field, tolerance, settled)));
  }
  return ElementOf(row, conductance.c_str(), ratio.c_str());
}

}  // namespace

Worst WorstOf(std::string_view family, std::string_view field) {
  using optimizer::Use;
  if (field == "free_air") return Worst::kLow;
  if (field == "current") return Worst::kHigh;
  if (IsMass(field) || field == "body_volume_ml") return Worst::kSum;
  if (IsRatio(field)) return Worst::kLow;
  // Of a bottle's filling the least gas counts, and the most that its regulator must stand.
  if (field == "fill_pressure_kpa_gauge") return Worst::kBothEnds;
  if (field == "internal_volume_ml") return Worst::kBothEnds;
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    if (family != spec.name) continue;
    for (const optimizer::PartField& known : spec.fields) {
      if (known.name != field) continue;
      switch (known.use) {
        case Use::kMore:
        case Use::kRating:
        case Use::kFlow:
        case Use::kSharedFlow:
          return IsExact(field) ? Worst::kExact : Worst::kLow;
        case Use::kLess:
          return Worst::kHigh;
        case Use::kBoth:  // the bore of a tube
        case Use::kMate:
          return Worst::kExact;
        case Use::kRule:
          return WorstByRule(family, field);
      }
    }
  }
  return Worst::kExact;
}

double HalfWidth(const catalog::Part& row, std::string_view field, const Tolerance& tolerance,
                 const Settled& settled) {
  if (WorstOf(row.family, field) == Worst::kExact || (settled && settled(row, field))) return 0.0;
  if (row.curve && field == "free_air")
    return tolerance.Of(row.curve->free_air_provenance, row.curve->free_air_uncertainty);
  if (row.curve && field == "current")
    return tolerance.Of(row.curve->current_provenance, row.curve->current_uncertainty);
  const auto found = row.numbers.find(std::string(field));
  if (found == row.numbers.end()) return 0.0;
  return tolerance.Of(found->second.provenance, found->second.uncertainty);
}

catalog::Part AtCorner(catalog::Part row, const Tolerance& tolerance, int corner) {
  constexpr std::uint64_t kSeed = 2;
  constexpr double kMostlyWorst = 0.5;  // of −1 to 1
  const auto share = [&](const std::string& field) {
    const double drawn = Factor(kSeed, corner, row.id, field, 1.0) - 1.0;
    const double worst = WorstOf(row.family, field) == Worst::kHigh ? 1.0 : -1.0;
    const double sign =
        corner % 2 == 0 ? (drawn < 0.0 ? -1.0 : 1.0) : (drawn < kMostlyWorst ? worst : -worst);
    return 1.0 + sign * HalfWidth(row, field, tolerance);
  };
  for (auto& [field, number] : row.numbers)
    number.value = WithinRange(row, field, number.value * share(field));
  if (row.curve) {
    const double delivery = share("free_air"), current = share("current");
    for (catalog::CurvePoint& point : row.curve->points) {
      point.free_air_l_per_min *= delivery;
      point.current_a *= current;
    }
  }
  return row;
}

model::Parts ToWorstParts(const optimizer::Problem& problem, const std::vector<catalog::Part>& rows,
                          const Tolerance& tolerance, const Settled& settled) {
  std::vector<catalog::Part> worst;
  worst.reserve(rows.size());
  for (const catalog::Part& row : rows) worst.push_back(AtWorst(row, tolerance, settled));
  model::Parts parts = ModelPartsFor(problem, worst);
  std::vector<std::size_t> seen(optimizer::Families().size());
  for (const catalog::Part& row : rows) {
    for (const optimizer::FamilySpec& spec : optimizer::Families()) {
      // Reservoirs as tanks, and check valves: a guarantee has none (guarantee.h).
      if (row.family != spec.name || spec.family == optimizer::Family::kTank ||
          spec.family == optimizer::Family::kCheckValve)
        continue;
      if (spec.joins && !IsJoint(row)) continue;  // it is no part of the problem
      const std::size_t part = seen[static_cast<std::size_t>(spec.family)]++;
      AddSlack(row, tolerance, settled,
               optimizer::BasicsOf(parts, spec.family, static_cast<int>(part)));
      if (spec.family == optimizer::Family::kCylinder)
        SetCharge(row, tolerance, settled, problem.ambient, parts.cylinders[part]);
      if (spec.family == optimizer::Family::kCo2)
        SetCharge(row, tolerance, settled, parts.co2[part]);
      if (spec.family == optimizer::Family::kFitting)
        parts.fittings[part].flow_most = MostFlow(row, "", tolerance, settled);
      if (spec.family == optimizer::Family::kValve)
        parts.valves[part].fill_most = MostFlow(row, "_fill", tolerance, settled);
      if (spec.family == optimizer::Family::kReservoir)
        parts.reservoirs[part].volume_spread_m3 =
            2.0 * HalfWidth(row, "internal_volume_ml", tolerance, settled) *
            M3FromMl(ValueOf(row, "internal_volume_ml"));
    }
  }
  optimizer::FollowMission(problem.actuations / problem.frequency_hz, parts);  // masses have slack
  return parts;
}

}  // namespace plenum::api
