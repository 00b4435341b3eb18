// The vacuum that pumps keep beside a pressure supply, found by halving. Internal to verify*.cc.
//
// Its reservoirs take the air of a period at once, while no pump runs, and then the pumps bring
// them back to where they stop. Falls count at the weakest pressure, the largest current on the way
// from ambient all the time that pumps run.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RAIL_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RAIL_H_

#include <optional>
#include <vector>

#include "model/flow/series.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// An actuator of a group, and what it empties through.
struct RailLine {
  int group = 0;
  model::Series exhaust;
  model::Chamber chamber;
};
// Those of a design that go below ambient.
std::vector<RailLine> RailLinesOf(const Problem& problem, const Assembly& assembly);

struct RailPumps {
  const model::Compressor* pump = nullptr;
  int pumps = 1;
  double volume_m3 = 0.0;  // of all reservoirs
};
inline RailPumps RailPumpsOf(const Assembly& a) {
  return {a.rail.pump, a.rail.pumps, a.rail.reservoir ? a.rail.VolumeM3() : 0.0};
}

// What the pumps bear at a weakest pressure; +∞ where they do not come to where they would stop.
struct RailBorne {
  double stop_pa = 0.0;
  double duty = kUnlimited, per_cycle_j = kUnlimited, first_fill_j = kUnlimited,
         current_a = kUnlimited;
};
RailBorne BorneAt(const Problem& problem, const RailPumps& pumps,
                  const std::vector<RailLine>& lines, double rail_pa);

// The weakest pressure at which falls are in time and the pumps keep up; none: there is none. Both
// may be missed by `slack`, relative.
std::optional<double> WeakestRail(const Problem& problem, const RailPumps& pumps,
                                  const std::vector<RailLine>& lines, double slack);

// The assembly at the weakest pressure of its vacuum; as it is without pumps of one.
std::optional<Assembly> OnItsRail(const Problem& problem, const Assembly& assembly, double slack);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RAIL_H_
