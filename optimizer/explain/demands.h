// What a request demands that can be dropped, in the order of its fields.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_DEMANDS_H_
#define PLENUM_OPTIMIZER_EXPLAIN_DEMANDS_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/explain/requirements.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

struct Demand {
  std::string pointer;  // JSON pointer; "prices"
  std::function<void(Problem&)> drop;
  std::optional<Requirement> number;  // none: it is dropped or not
};

// What "dropped" means:
//   rise_time_s_max, fall_time_s_max, pressure_kpa_gauge_max, mains/flow_l_per_min_anr_max,
//   source_pressure_kpa_gauge_max, mass_kg_max, volume_l_max, cost_eur_max    no limit
//   actuations                                                                1
//   frequency_hz                       an eighth or less (requirements.h)
//   limits/*_max                       16, the most that a request may allow
//   power/energy_wh_max, power/current_a_max, supply/parts, require/FAMILY, exclude    as if it
//   were not there (with SearchOptions::select) prices                             unknown prices
//   count as 0
// Never dropped: volumes, operating pressures, counts, lengths, configurations.
std::vector<Demand> Demands(const Problem& problem, const SearchOptions& options);

// The same problem for a search to which any design will do: the least of what is limited is
// sought, mass where nothing is, and parts without a price are left out where cost mattered.
Problem ForAnyDesign(Problem problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_DEMANDS_H_
