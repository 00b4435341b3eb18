#include "optimizer/problem/amount.h"

#include <algorithm>
#include <cmath>

#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {
namespace {

constexpr double kEurPerKg = 1e-3;      // where unknown prices count as 0
constexpr double kPackRounding = 1e-9;  // of a pack: lengths of several tubes are sums

}  // namespace

Objective ObjectiveOn(Amount amount) {
  switch (amount) {
    case Amount::kMass:
      return {.mass_kg = 1.0};
    case Amount::kVolume:
      return {.volume_l = 1.0};
    case Amount::kCost:
      return {.cost_eur = 1.0};
    case Amount::kEnergy:
      return {.energy_wh = 1.0};
  }
  return {};
}

double& LimitOn(Amount amount, Problem& problem) {
  return amount == Amount::kMass     ? problem.mass_max_kg
         : amount == Amount::kVolume ? problem.volume_max_l
                                     : problem.cost_max_eur;
}

const char* Name(Amount amount) {
  switch (amount) {
    case Amount::kMass:
      return "mass_kg";
    case Amount::kVolume:
      return "volume_l";
    case Amount::kCost:
      return "cost_eur";
    case Amount::kEnergy:
      return "energy_wh";
  }
  return "";
}

double Of(Amount amount, const Totals& totals) {
  switch (amount) {
    case Amount::kMass:
      return totals.mass_kg;
    case Amount::kVolume:
      return totals.volume_m3 * 1e3;
    case Amount::kCost:
      return totals.cost_eur.value_or(std::nan(""));
    case Amount::kEnergy:
      return totals.energy_j / kJoulePerWattHour;
  }
  return std::nan("");
}

double PacksFor(double quantity, const model::PartBasics& basics) {
  return basics.pack > 0.0 ? std::ceil(quantity / basics.pack - kPackRounding) : 0.0;
}

double PackCost(double quantity, const model::PartBasics& basics) {
  const double bought = basics.pack > 0.0 ? PacksFor(quantity, basics) * basics.pack : quantity;
  return bought * basics.cost_eur.value_or(0.0);
}

bool CostCounts(const Problem& problem) {
  return problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
}

bool PricesNeeded(const Problem& problem) {
  return CostCounts(problem) && !problem.unpriced_allowed;
}

void AllowUnpriced(Problem& problem) {
  problem.unpriced_allowed = true;
  Objective& objective = problem.objective;
  if (objective.cost_eur > 0.0 && objective.mass_kg == 0.0)
    objective.mass_kg = kEurPerKg * objective.cost_eur;
}

double TieOf(const Problem& problem) {
  const double cost = problem.objective.cost_eur;
  const bool by_price =
      cost > 0.0 && problem.objective == Objective{kEurPerKg * cost, 0.0, cost, 0.0};
  const bool made = MadeToMeasureAllowed(problem, Family::kReservoir) &&
                    std::any_of(problem.configurations.begin(), problem.configurations.end(),
                                [](Configuration one) { return KeepsReservoir(one); });
  return by_price && !made ? 1e-9 : 1e-6;
}

}  // namespace plenum::optimizer
