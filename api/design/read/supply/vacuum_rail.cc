#include "api/design/read/supply/vacuum_rail.h"

#include <algorithm>
#include <vector>

#include "api/catalogue/catalogue_parts.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/evaluate/pumped_rail.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;

void KeepConfigurations(Reader& supply, optimizer::Problem& problem) {
  if (supply.Has("configurations"))
    for (const Configuration configuration : problem.configurations)
      if (!GoesWithVacuumRail(configuration))
        supply.Fail("configurations",
                    std::string("must be without ") + optimizer::Name(configuration) +
                        " where an actuator has a low_pressure_kpa_gauge: cylinder, co2 and mains "
                        "are searched beside a vacuum");
  std::erase_if(problem.configurations, [](Configuration one) { return !GoesWithVacuumRail(one); });
}

// Which vacuum is asked for. Pumps by default.
enum class Kind { kPumps, kWall };

Kind ReadKind(Reader& vacuum) {
  if (!vacuum.Has("configurations")) return Kind::kPumps;
  const std::vector<std::string> kinds = vacuum.Texts("configurations", 1, 3);
  if (kinds != std::vector<std::string>{"mains"} && kinds != std::vector<std::string>{"pump"})
    vacuum.Fail("configurations",
                "must be [\"pump\"] or [\"mains\"] for actuators under pressure: ejectors beside a "
                "pressure supply are not searched yet, nor are two kinds of vacuum at once");
  return kinds == std::vector<std::string>{"mains"} ? Kind::kWall : Kind::kPumps;
}

// The wall's, kPa gauge; nothing where the request has none.
std::optional<double> ReadWall(Reader& vacuum, Kind kind, std::optional<double> limit,
                               const model::Ambient& ambient) {
  auto mains = vacuum.OptionalObject("mains");
  if (!mains && kind == Kind::kWall) vacuum.Fail("mains", "is required by the configuration mains");
  if (!mains) return std::nullopt;
  const double kpa = mains->Number("pressure_kpa_gauge", {DeepestKpaGauge(ambient), -1});
  if (kind != Kind::kWall)
    vacuum.Fail("mains",
                "is for the configuration mains, which supply.vacuum.configurations does not name");
  if (limit && kpa < *limit)
    mains->Fail("pressure_kpa_gauge", "must be ≥ the vacuum_kpa_gauge_min of " + Decimal(*limit) +
                                          ": nothing regulates the wall's "
                                          "vacuum, not " +
                                          Decimal(kpa));
  RefuseFlow(*mains);
  mains->Finish();
  return kpa;
}

// What chambers empty into at the deepest, and where that stands.
struct Deepest {
  double pa = 0.0;
  std::string is;
};

Deepest ReadVacuumBeside(Reader& supply, optimizer::Problem& problem) {
  const model::Ambient& ambient = problem.ambient;
  Kind kind = Kind::kPumps;
  std::optional<double> limit, wall;
  if (auto vacuum = supply.OptionalObject("vacuum")) {
    kind = ReadKind(*vacuum);
    limit = vacuum->OptionalNumber("vacuum_kpa_gauge_min", {-ambient.pressure_pa / 1e3, -1});
    wall = ReadWall(*vacuum, kind, limit, ambient);
    vacuum->Finish();
  }
  if (kind == Kind::kWall)
    return {PaFromKpaGauge(wall.value_or(DeepestKpaGauge(ambient)), ambient),
            "only vacuum: /supply/vacuum/mains/pressure_kpa_gauge is "};
  problem.rail_floor_pa = std::max(
      model::kDeepestVacuumPa, PaFromKpaGauge(limit.value_or(DeepestKpaGauge(ambient)), ambient));
  return {problem.rail_floor_pa, "deepest vacuum allowed: /supply/vacuum/vacuum_kpa_gauge_min is "};
}

bool Holds(const catalog::Part& valve) {
  const auto function = valve.texts.find("function");
  return function != valve.texts.end() &&
         (function->second.value == "2/2 pair" || function->second.value == "proportional");
}

}  // namespace

void RefuseFlow(Reader& wall) {
  constexpr char kField[] = "flow_l_per_min_anr_max";
  if (!wall.Has(kField)) return;
  wall.Fail(kField, "must be left out: the wall is taken to keep its vacuum whatever is drawn");
}

bool HasVacuumRail(const optimizer::Problem& problem) {
  return std::any_of(
      problem.groups.begin(), problem.groups.end(),
      [](const optimizer::ActuatorGroup& group) { return group.chamber.low_pressure_pa > 0.0; });
}

void ReadVacuumRail(Reader& supply, optimizer::Problem& problem) {
  KeepConfigurations(supply, problem);
  const Deepest deepest = ReadVacuumBeside(supply, problem);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    model::Chamber& chamber = problem.groups[g].chamber;
    if (!(chamber.low_pressure_pa > 0.0)) continue;
    chamber.exhaust_pressure_pa = deepest.pa;
    if (chamber.low_pressure_pa < deepest.pa)
      supply.errors().push_back(
          {optimizer::GroupPointer(problem, static_cast<int>(g)) + "/low_pressure_kpa_gauge",
           "is " + Decimal(Rounded(KpaGaugeFromPa(chamber.low_pressure_pa, problem.ambient))) +
               ", below the " + deepest.is +
               Decimal(Rounded(KpaGaugeFromPa(deepest.pa, problem.ambient)))});
  }
}

// Those whose source keeps its pressure.
bool GoesWithVacuumRail(Configuration configuration) {
  return configuration == Configuration::kCylinder || configuration == Configuration::kCo2 ||
         configuration == Configuration::kMains;
}

bool SuitsVacuumRail(const optimizer::Problem& problem, const catalog::Part& part) {
  if (!HasVacuumRail(problem)) return true;
  const bool of_rail = part.family == "reservoir" || part.family == "vacuum_pump";
  if (part.family == "tubing" || (of_rail && optimizer::PumpsRail(problem)))
    return StandsVacuum(part);
  return part.family != "valve" || (StandsVacuum(part) && Holds(part));
}

std::string WhyNotForVacuumRail(const catalog::Part& part) {
  return part.family == "valve" && !Holds(part)
             ? " cannot close both ways, as an actuator with a low pressure needs"
             : " does not stand a vacuum, or its row does not say enough";
}

Range PumpedRailRange(const optimizer::Problem& problem) {
  const auto kpa = [&](double pa) { return Rounded(KpaGaugeFromPa(pa, problem.ambient)); };
  return {kpa(problem.rail_floor_pa), kpa(optimizer::HighestRailPa(problem))};
}

double VacuumRailKpa(const optimizer::Problem& problem) {
  for (const optimizer::ActuatorGroup& group : problem.groups)
    if (group.chamber.low_pressure_pa > 0.0)
      return KpaGaugeFromPa(model::ExhaustPa(group.chamber), problem.ambient);
  return 0.0;
}

}  // namespace plenum::api
