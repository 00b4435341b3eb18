// The check valves of pumps that let air back, by hand.
#ifndef PLENUM_TESTS_SUPPORT_PUMPS_CHECK_VALVES_H_
#define PLENUM_TESTS_SUPPORT_PUMPS_CHECK_VALVES_H_

#include <cmath>
#include <string>
#include <tuple>

#include "optimizer/evaluate/line.h"
#include "optimizer/problem/problem.h"

namespace plenum::test {

// One for each actuator: of those that serve all the lightest with a price, else the lightest.
inline optimizer::Amounts CheckValvesByHand(const optimizer::Problem& problem) {
  const bool priced_only = problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
  double actuators = 0.0;
  for (const optimizer::ActuatorGroup& group : problem.groups) actuators += group.count;
  std::tuple<bool, double, double, std::string> best;
  optimizer::Amounts amounts;
  for (const model::CheckValve& row : problem.parts.check_valves) {
    bool serves = !priced_only || row.basics.cost_eur.has_value();
    for (const optimizer::ActuatorGroup& group : problem.groups)
      serves =
          serves && row.pressure_max_pa >= group.chamber.operating_pressure_pa &&
          group.count * row.sonic_conductance_m3_per_s_pa >= group.joint_conductance_m3_per_s_pa;
    const std::tuple key(!row.basics.cost_eur, row.basics.mass_kg,
                         row.basics.cost_eur.value_or(0.0), row.basics.id);
    if (!serves || (!std::get<3>(best).empty() && !(key < best))) continue;
    best = key;
    amounts = {actuators * row.basics.mass_kg, actuators * row.basics.body_volume_m3,
               actuators * row.basics.cost_eur.value_or(0.0)};
  }
  return amounts;
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PUMPS_CHECK_VALVES_H_
