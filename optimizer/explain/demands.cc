#include "optimizer/explain/demands.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/line.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {
namespace {

constexpr int kPiecesMost = 16;  // that a request may allow of a part
constexpr double kLitrePerMinute = 1e-3 / 60.0;

// Of the numbers of requirements.h; what no longer binds there may still do so once other demands
// are dropped.
Demand OfRequirement(const Requirement& requirement) {
  const bool unlimited = !requirement.pointer.starts_with("/duty/");
  Demand demand{requirement.pointer, nullptr, requirement};
  // Under vacuum pressures are below 0.
  if (unlimited) demand.number->loosest = std::copysign(kUnlimited, requirement.loosest);
  demand.drop = [set = requirement.set, loosest = demand.number->loosest](Problem& p) {
    set(p, loosest);
  };
  return demand;
}

Demand OfNumber(std::string pointer, double required, double loosest, bool whole,
                std::function<void(Problem&, double)> set) {
  Demand demand{pointer, [set, loosest](Problem& p) { set(p, loosest); }, std::nullopt};
  demand.number =
      Requirement{std::move(pointer), required, loosest, std::move(set), std::nullopt, whole};
  return demand;
}

Demand OfGroupPressure(const Problem& problem, std::size_t g) {
  return OfNumber(PressureLimitPointer(problem, static_cast<int>(g)),
                  KpaGauge(problem, problem.groups[g].pressure_max_pa),
                  Evacuated(problem) ? -kUnlimited : kUnlimited, false,
                  [sides = GroupsOfEntry(problem, g)](Problem& p, double kpa) {
                    for (const std::size_t side : sides)
                      p.groups[side].pressure_max_pa = PaFromKpaGauge(p, kpa);
                  });
}

// Of the wall that feeds actuators, or ejectors.
Demand OfMainsFlow(const Problem& problem, Mains Problem::*mains) {
  return OfNumber("/supply/mains/flow_l_per_min_anr_max",
                  (problem.*mains).flow_max_m3_per_s / kLitrePerMinute, kUnlimited, false,
                  [mains](Problem& p, double value) {
                    (p.*mains).flow_max_m3_per_s = value * kLitrePerMinute;
                  });
}

void AddPrices(const Problem& problem, std::vector<Demand>& list) {
  if (!PricesNeeded(problem)) return;
  list.push_back({"prices", [](Problem& p) { p.unpriced_allowed = true; }, std::nullopt});
}

void AddLimits(const Problem& problem, std::vector<Demand>& list) {
  const auto add = [&](const char* pointer, int Limits::*limit,
                       const std::vector<Configuration>& users, bool rail = false) {
    const bool used = (rail && PumpsRail(problem)) ||
                      std::any_of(users.begin(), users.end(), [&](Configuration user) {
                        return problem.configurations.contains(user);
                      });
    if (used && problem.limits.*limit < kPiecesMost)
      list.push_back(OfNumber(pointer, problem.limits.*limit, kPiecesMost, true,
                              [limit](Problem& p, double value) {
                                p.limits.*limit = static_cast<int>(std::lround(value));
                              }));
  };
  const Configuration pump = Configuration::kCompressor, bottle = Configuration::kCylinder,
                      co2 = Configuration::kCo2, tank = Configuration::kTank,
                      direct = Configuration::kDirectPump, vacuum = Configuration::kVacuumPump,
                      direct_vacuum = Configuration::kDirectVacuumPump,
                      ejector = Configuration::kEjector,
                      direct_ejector = Configuration::kDirectEjector,
                      refilled = Configuration::kTankAndPump;
  add("/limits/compressors_max", &Limits::compressors,
      {pump, direct, vacuum, direct_vacuum, refilled, ejector, direct_ejector}, true);
  if (problem.power.kind == PowerKind::kBattery)
    add("/limits/batteries_max", &Limits::batteries,
        {pump, bottle, co2, tank, direct, vacuum, direct_vacuum, refilled, ejector,
         direct_ejector});
  add("/limits/cylinders_max", &Limits::cylinders, {bottle});
  add("/limits/co2_max", &Limits::co2, {co2});
  add("/limits/reservoirs_max", &Limits::reservoirs, {pump, tank, vacuum, refilled, ejector}, true);
}

// What the robot gives; as many of its supplies there are not.
void AddPower(const Problem& problem, const SearchOptions& options, std::vector<Demand>& list) {
  if (!options.select) return;
  const auto add = [&](const char* pointer, std::optional<double> Power::*most) {
    if (problem.power.*most)
      list.push_back({pointer,
                      [most, select = options.select](Problem& p) {
                        (p.power.*most).reset();
                        p.parts = select(p);
                      },
                      std::nullopt});
  };
  add("/supply/power/energy_wh_max", &Power::energy_wh_max);
  add("/supply/power/current_a_max", &Power::current_a_max);
}

void AddProducts(const Problem& problem, const SearchOptions& options, std::vector<Demand>& list) {
  if (!options.select || !problem.orderable_only) return;
  list.push_back({"/supply/parts",
                  [select = options.select](Problem& p) {
                    p.orderable_only = false;
                    p.parts = select(p);
                  },
                  std::nullopt});
}

void AddSelection(const Problem& problem, const SearchOptions& options, std::vector<Demand>& list) {
  if (!options.select) return;
  for (const auto& [family, ids] : problem.require)
    list.push_back({std::string("/require/") + Name(family),
                    [family = family, select = options.select](Problem& p) {
                      p.require.erase(family);
                      p.parts = select(p);
                    },
                    std::nullopt});
  if (!problem.exclude.empty())
    list.push_back({"/exclude",
                    [select = options.select](Problem& p) {
                      p.exclude.clear();
                      p.parts = select(p);
                    },
                    std::nullopt});
}

void AddHoldOn(const Problem& problem, std::vector<Demand>& list) {
  if (!PumpsHoldOn(problem)) return;
  list.push_back({"/supply/hold_on", [](Problem& p) { SetPumpsHoldOn(false, p); }, std::nullopt});
}

template <typename Part>
void EraseUnpriced(std::vector<Part>& parts) {
  std::erase_if(parts, [](const Part& part) { return !part.basics.cost_eur; });
}

void EraseUnpriced(model::Parts& parts) {
  std::erase_if(parts.tubing, [](const model::Tubing& part) { return !part.per_metre.cost_eur; });
  EraseUnpriced(parts.fittings);
  EraseUnpriced(parts.valves);
  EraseUnpriced(parts.compressors);
  EraseUnpriced(parts.batteries);
  EraseUnpriced(parts.cylinders);
  EraseUnpriced(parts.co2);
  EraseUnpriced(parts.regulators);
  EraseUnpriced(parts.reservoirs);
  EraseUnpriced(parts.tanks);
  EraseUnpriced(parts.vacuum_pumps);
  EraseUnpriced(parts.ejectors);
}

}  // namespace

std::vector<Demand> Demands(const Problem& problem, const SearchOptions& options) {
  std::vector<Demand> list;
  const std::vector<Requirement> numbers = Requirements(problem);
  const auto add = [&](const std::string& place) {
    for (const Requirement& number : numbers)
      if (number.pointer.starts_with(place)) list.push_back(OfRequirement(number));
  };
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    if (GroupsOfEntry(problem, g).front() != g) continue;
    add(GroupPointer(problem, static_cast<int>(g)) + "/");
    list.push_back(OfGroupPressure(problem, g));
  }
  add("/duty/");
  if (problem.configurations.contains(Configuration::kMains) &&
      std::isfinite(problem.mains.flow_max_m3_per_s))
    list.push_back(OfMainsFlow(problem, &Problem::mains));
  if (std::any_of(problem.configurations.begin(), problem.configurations.end(), IsEjector) &&
      std::isfinite(problem.compressed_air.flow_max_m3_per_s))
    list.push_back(OfMainsFlow(problem, &Problem::compressed_air));
  add("/supply/");
  AddHoldOn(problem, list);
  AddPower(problem, options, list);
  AddProducts(problem, options, list);
  AddPrices(problem, list);
  AddLimits(problem, list);
  AddSelection(problem, options, list);
  return list;
}

Problem ForAnyDesign(Problem problem) {
  if (PricesNeeded(problem)) {
    EraseUnpriced(problem.parts);
    problem.exclude.insert("custom");  // a made-to-measure reservoir has no price
  }
  problem.count = 1;
  problem.objective = std::isfinite(problem.mass_max_kg)    ? Objective{.mass_kg = 1.0}
                      : std::isfinite(problem.volume_max_l) ? Objective{.volume_l = 1.0}
                      : std::isfinite(problem.cost_max_eur) ? Objective{.cost_eur = 1.0}
                                                            : Objective{.mass_kg = 1.0};
  return problem;
}

}  // namespace plenum::optimizer
