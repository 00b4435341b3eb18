// One cycle of a design's periodic state. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_CYCLE_H_
#define PLENUM_OPTIMIZER_VERIFY_CYCLE_H_

#include <optional>
#include <vector>

#include "optimizer/verify_design.h"

namespace plenum::optimizer {

struct Cycle {
  std::vector<double> rise_s, inflate_s, fall_s;  // per group; +∞: never reached
  double air_m3 = 0.0;                            // ANR, by the contents at rest and full
  double pump_on_s = 0.0, pump_j = 0.0;
  double coil_w = 0.0;                       // all on at once, with the regulator
  double steady_j = 0.0, inflating_j = 0.0;  // coils and regulator; of it what strokes shorten
  double electric_j() const { return steady_j + inflating_j; }
};

// By the simulator, from the first cycle until the source repeats. None where it does not get
// there.
std::optional<Cycle> SimulateCycle(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly);

// By one quadrature or integration for each group, where groups do not meet on the source; else as
// above. `rising_m3`: the reservoir's volume while its pressure rises, where it is to bound those
// of an interval of volumes (model/reservoir_stroke.h). Air that pumps add to actuators that stay
// open to the reservoir is pumped at the stop pressure, the most that it can take.
std::optional<Cycle> QuickCycle(const Problem& problem, const Settings& settings,
                                const Assembly& assembly, double rising_m3);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_CYCLE_H_
