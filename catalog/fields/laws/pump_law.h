// Flow and current of a pump between the numbers of its sheet: the law of
// catalog/estimates/pumps.py, with the coefficients that it was fitted to.
#ifndef PLENUM_CATALOG_FIELDS_LAWS_PUMP_LAW_H_
#define PLENUM_CATALOG_FIELDS_LAWS_PUMP_LAW_H_

#include <optional>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// What a sheet prints of a pump.
struct PumpSheet {
  double free_flow_l_per_min = 0;  // > 0
  double far_kpa_gauge = 0;        // highest pressure, or deepest vacuum (below 0); not 0
  double voltage_v = 0;            // > 0
  std::optional<double> power_min_w = std::nullopt, power_max_w = std::nullopt;
  bool is_piston = false;
};

struct PumpEstimate {
  std::vector<CurvePoint> points;  // in order of pressure, a tenth of the range apart
  double free_air_uncertainty = 0, current_uncertainty = 0;  // relative, one standard deviation
};

// The flow runs straight from free flow to the far end (that of pistons in the shape of a measured
// one), cut where the air's isothermal work would need more than the highest power at the best
// efficiency that pumps reach. The power goes with the air's work from the low end of its range
// (half of the highest where it is not printed) to the high one, and never falls on the way to the
// far end. A highest power that is not printed is predicted from free flow.
PumpEstimate EstimatePump(const PumpSheet& sheet);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LAWS_PUMP_LAW_H_
