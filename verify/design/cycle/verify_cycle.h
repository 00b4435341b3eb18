// One cycle of a design's periodic state. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_CYCLE_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_CYCLE_H_

#include <optional>
#include <vector>

#include "model/flow/flow_table.h"
#include "model/flow/series.h"
#include "model/simulate/simulate.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_pump_curve.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// By the simulator, from the first cycle until the source repeats; out of a tank without a
// regulator the last of the mission, which is the slowest. None where it does not get there, or is
// stopped.
std::optional<Cycle> SimulateCycle(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly, const Stop& stop = {});

// The same at many settings: by one quadrature or integration for each group, where groups do not
// meet on the source; else by the simulator, too.
class QuickCycles {
 public:
  // `fills`: where strokes that pumps fill themselves are kept; null: here.
  QuickCycles(const Problem& problem, const Assembly& assembly, Stop stop = {},
              DirectFills* fills = nullptr);

  // `rising_m3`: the reservoir's volume while its pressure rises, where it is to bound those of an
  // interval of volumes (model/strokes/reservoir_stroke.h). None where the simulator does not get
  // to a cycle that repeats, or when stopped, which is asked at each call.
  std::optional<Cycle> At(const Settings& settings, double rising_m3) const;

  // Strokes of each unit by itself out of a reservoir that is full, which others only empty: none
  // is faster in the cycle of all. None where that tells nothing beyond At.
  std::optional<Cycle> EachAlone(const Settings& settings, double rising_m3) const;

 private:
  // How long until the source is as it was before the stroke.
  double FillFromRegulator(const Settings& settings, int unit, Cycle& cycle) const;
  double FillFromReservoir(const Settings& settings, double rising_m3, int unit,
                           Cycle& cycle) const;
  double FillFromTank(double& tank_pa, int unit, Cycle& cycle) const;
  // What pumps that hold on take in a period beside filling the unit; how long they run for it.
  double AddHolding(const Unit& unit, double filling_s, Cycle& cycle) const;

  const Problem& problem_;
  const Assembly& assembly_;
  const Stop stop_;
  const std::vector<Unit> units_;
  std::vector<model::GroupRig> rigs_;  // per unit, as the next two
  std::vector<model::Series> fills_;   // with the regulator's share
  std::vector<model::FlowTable> fill_tables_;
  std::vector<double> fall_s_;  // per group
  DirectFills* direct_fills_;
  mutable DirectFills own_fills_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_CYCLE_H_
