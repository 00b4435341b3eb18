#include "api/design/read/supply/vacuum_rail.h"

#include <algorithm>
#include <vector>

#include "api/catalogue/catalogue_parts.h"
#include "api/json/units.h"
#include "api/json/words.h"

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

// The wall's, kPa gauge; nothing where the request has none.
std::optional<double> ReadWall(Reader& supply, const model::Ambient& ambient) {
  auto vacuum = supply.OptionalObject("vacuum");
  if (!vacuum) {
    supply.Fail("vacuum",
                "is required by low_pressure_kpa_gauge: { \"configurations\": [\"mains\"], "
                "\"mains\": { \"pressure_kpa_gauge\": -60 } }, the wall's vacuum");
    return std::nullopt;
  }
  const std::vector<std::string> kinds = vacuum->Has("configurations")
                                             ? vacuum->Texts("configurations", 1, 3)
                                             : std::vector<std::string>{};
  if (kinds != std::vector<std::string>{"mains"})
    vacuum->Fail("configurations",
                 "must be [\"mains\"] for actuators under pressure: vacuum pumps and ejectors "
                 "beside a pressure supply are not searched yet");
  const double deepest_kpa = -ambient.pressure_pa / 1e3;
  const auto limit = vacuum->OptionalNumber("vacuum_kpa_gauge_min", {deepest_kpa, -1});
  std::optional<double> kpa;
  auto mains = vacuum->OptionalObject("mains");
  if (!mains) {
    vacuum->Fail("mains", "is required by the configuration mains");
  } else {
    kpa = mains->Number("pressure_kpa_gauge", {DeepestKpaGauge(ambient), -1});
    if (limit && *kpa < *limit)
      mains->Fail("pressure_kpa_gauge", "must be ≥ the vacuum_kpa_gauge_min of " + Decimal(*limit) +
                                            ": nothing regulates the wall's "
                                            "vacuum, not " +
                                            Decimal(*kpa));
    if (mains->Has("flow_l_per_min_anr_max")) {
      mains->Raw("flow_l_per_min_anr_max");
      mains->Fail("flow_l_per_min_anr_max",
                  "must be left out: the wall is taken to keep its vacuum whatever is drawn");
    }
    mains->Finish();
  }
  vacuum->Finish();
  return kpa;
}

bool Holds(const catalog::Part& valve) {
  const auto function = valve.texts.find("function");
  return function != valve.texts.end() &&
         (function->second.value == "2/2 pair" || function->second.value == "proportional");
}

}  // namespace

bool HasVacuumRail(const optimizer::Problem& problem) {
  return std::any_of(
      problem.groups.begin(), problem.groups.end(),
      [](const optimizer::ActuatorGroup& group) { return group.chamber.low_pressure_pa > 0.0; });
}

void ReadVacuumRail(Reader& supply, optimizer::Problem& problem) {
  KeepConfigurations(supply, problem);
  const std::optional<double> kpa = ReadWall(supply, problem.ambient);
  if (!kpa) return;
  const double rail_pa = PaFromKpaGauge(*kpa, problem.ambient);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    model::Chamber& chamber = problem.groups[g].chamber;
    if (!(chamber.low_pressure_pa > 0.0)) continue;
    chamber.exhaust_pressure_pa = rail_pa;
    if (chamber.low_pressure_pa < rail_pa)
      supply.errors().push_back(
          {optimizer::GroupPointer(problem, static_cast<int>(g)) + "/low_pressure_kpa_gauge",
           "is " + Decimal(Rounded(KpaGaugeFromPa(chamber.low_pressure_pa, problem.ambient))) +
               ", below the only vacuum: /supply/vacuum/mains/pressure_kpa_gauge is " +
               Decimal(*kpa)});
  }
}

// Those whose source keeps its pressure.
bool GoesWithVacuumRail(Configuration configuration) {
  return configuration == Configuration::kCylinder || configuration == Configuration::kCo2 ||
         configuration == Configuration::kMains;
}

bool SuitsVacuumRail(const optimizer::Problem& problem, const catalog::Part& part) {
  if (!HasVacuumRail(problem)) return true;
  if (part.family == "tubing") return StandsVacuum(part);
  return part.family != "valve" || (StandsVacuum(part) && Holds(part));
}

std::string WhyNotForVacuumRail(const catalog::Part& part) {
  return part.family == "valve" && !Holds(part)
             ? " cannot close both ways, as an actuator with a low pressure needs"
             : " does not stand a vacuum, or its row does not say enough";
}

double VacuumRailKpa(const optimizer::Problem& problem) {
  for (const optimizer::ActuatorGroup& group : problem.groups)
    if (group.chamber.low_pressure_pa > 0.0)
      return KpaGaugeFromPa(model::ExhaustPa(group.chamber), problem.ambient);
  return 0.0;
}

}  // namespace plenum::api
