#include "api/design/read/supply/outside.h"

#include <algorithm>
#include <limits>

#include "api/design/read/supply/power.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::Family;

constexpr const char* kWallPort = "wall-vacuum";
constexpr double kWideM3PerSPa = 1e-5;  // of valves: 1e-9 to 1e-8

model::Regulator WallPort(double pressure_pa) {
  model::Regulator port;
  port.basics.id = kWallPort;
  port.basics.cost_eur = 0.0;
  port.flow = {.sonic_conductance_m3_per_s_pa = kWideM3PerSPa, .critical_ratio = 0.5};
  port.flow_max_m3_per_s = std::numeric_limits<double>::infinity();
  port.inlet_pressure_min_pa = 0.0;
  port.inlet_pressure_max_pa = pressure_pa;
  port.outlet_pressure_min_pa = port.outlet_pressure_max_pa = pressure_pa;
  return port;
}

}  // namespace

bool HasWallVacuum(const optimizer::Problem& problem) {
  return optimizer::Evacuated(problem) && problem.configurations.contains(Configuration::kMains);
}

void ReplaceOutside(const optimizer::Problem& problem, model::Parts& parts) {
  ReplaceBatteries(problem, parts);
  if (HasWallVacuum(problem)) parts.regulators = {WallPort(problem.mains.pressure_pa)};
}

bool IsOutside(const optimizer::Choice& choice, const optimizer::Problem& problem) {
  return IsOutsidePower(choice, problem) ||
         (choice.family == Family::kRegulator && HasWallVacuum(problem));
}

std::string WhyNotOutside(const optimizer::Choice& choice, const optimizer::Problem& problem) {
  if (optimizer::FindPart(problem.parts, choice.family, choice.id) >= 0) return "";
  return choice.family == Family::kBattery
             ? std::string("is no choice: power comes from the ") +
                   optimizer::Name(problem.power.kind)
             : "is no choice: a vacuum from the wall has no regulator";
}

void AddOutside(const optimizer::Problem& problem, optimizer::Design& design) {
  AddOutsidePower(problem, design);
  const bool there = std::any_of(design.parts.begin(), design.parts.end(),
                                 [](const auto& row) { return row.family == Family::kRegulator; });
  if (!HasWallVacuum(problem) || design.configuration != Configuration::kMains || there) return;
  optimizer::Choice port;
  port.family = Family::kRegulator;
  port.id = kWallPort;
  port.cost_eur = 0.0;
  const auto of_source =
      std::find_if(design.parts.begin(), design.parts.end(),
                   [](const auto& row) { return row.family == Family::kManifold; });
  design.parts.insert(of_source, std::move(port));  // in the order of a parts list
}

}  // namespace plenum::api
