// The flow curve of a line, tabulated once for use inside integrators.
//
// Over y = √(1 − r) the flow per upstream pressure is smooth from equal pressures, where it is
// proportional to y, to the choked ratio, where its slope vanishes. Cubic Hermite pieces through
// exact values and slopes follow it to about 1e-8 of the choked flow (1e-6 where a second element
// is close to choking).
#ifndef PLENUM_MODEL_FLOW_TABLE_H_
#define PLENUM_MODEL_FLOW_TABLE_H_

#include <array>

#include "model/series.h"

namespace plenum::model {

class FlowTable {
 public:
  FlowTable() = default;
  explicit FlowTable(const Series& series);  // of elements with a subsonic index of ½

  // As FlowAtRatio(series, ratio), m³/(s·Pa).
  double operator()(double ratio) const;

 private:
  static constexpr int kCells = 48;
  double choked_flow_ = 0.0, choked_ratio_ = 0.0, cells_per_y_ = 0.0;
  std::array<double, kCells + 1> value_{}, slope_{};  // slope per cell
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_TABLE_H_
