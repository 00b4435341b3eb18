// How what a pump takes changes with pressure, on a fine grid; and the strokes that pumps fill
// themselves, without a reservoir. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_PUMP_CURVE_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_PUMP_CURVE_H_

#include <map>
#include <tuple>
#include <vector>

#include "model/flow/series.h"
#include "model/physics/compressor.h"
#include "model/simulate/simulate_rig.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// The least that energy per air, or power alone, at some pressure up to `high_pa` is of what it is
// at a lower one, as a ratio: 1 where it rises all the way.
double EnergyPerAirHeld(const model::CompressorCurve& curve, double low_pa, double high_pa);
double PowerHeld(const model::CompressorCurve& curve, double low_pa, double high_pa);

// The least that the pumps take in a cycle, J, with any volume of an interval whose ends have this
// ratio, from the cycle `low` with the smallest volume while the reservoir falls and the largest
// while it rises; `held`: of the pump's energy per air, or of its power, on the way up.
double LeastPumpEnergy(const Problem& problem, const Assembly& assembly, double volume_ratio,
                       double held, double source_pa, const Cycle& low);

// Most time that a group may take to fill: its window, or its turn at such pumps.
double FillSecondsMax(const Problem& problem, const Assembly& assembly, int group);

// What the pumps of one feed take while they hold chambers of the group full, W.
double HoldingWatts(const Problem& problem, const Assembly& assembly, int group);

// Pressure between pumps and valves at which all pumps of the assembly deliver what `count` lines
// take to chambers at `chamber_pa`, or the highest that pumps reach where lines take less.
double NodePressure(const Assembly& assembly, const model::Series& fill, double mirror_pa,
                    int count, double chamber_pa);

// The highest of groups that fill one after another; `factor` on what their lines conduct.
double HighestNode(const Assembly& assembly, const std::vector<model::GroupRig>& groups,
                   double factor);

// Strokes of groups that the pumps of an assembly fill, by Gauss' rule over panels of the chamber's
// pressure. Keeps them: combinations that come after each other share most of their lines.
class DirectFills {
 public:
  // Adds the strokes of a unit, whose lines are `fill`.
  double Add(const Problem& problem, const Assembly& assembly, const Unit& unit,
             const model::Series& fill, Cycle& cycle);

 private:
  struct Fill {
    double rise_s = kUnlimited, inflate_s = kUnlimited, pump_j = 0.0, node_pa = 0.0;
  };
  using Key = std::tuple<int, int, const model::Tubing*, const model::Fitting*, const model::Valve*,
                         const model::Compressor*, int>;
  static Fill Make(const Problem& problem, const Assembly& assembly, const Unit& unit,
                   const model::Series& fill);

  std::map<Key, Fill> known_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_PUMP_CURVE_H_
