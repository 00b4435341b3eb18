// The flow curve of a line, tabulated once for use inside integrators.
//
// With q = q*·√(1 − c²) the cosine c rises smoothly from 0 at the choked ratio to 1 at equal
// pressures; it is tabulated over r by cubic Hermite pieces through exact values and slopes.
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
  double choked_flow_ = 0.0, choked_ratio_ = 0.0, cells_per_ratio_ = 0.0;
  // 1 − c from equal pressures to the choked ratio, and its slope per cell.
  std::array<double, kCells + 1> value_{}, slope_{};
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_TABLE_H_
