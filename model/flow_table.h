// The flow curve of a line, tabulated once for use inside integrators.
//
// With q = q*·√(1 − c²) the cosine c rises smoothly from 0 at the choked ratio to 1 at equal
// pressures; it is tabulated over r by cubic Hermite pieces through exact values and slopes.
#ifndef PLENUM_MODEL_FLOW_TABLE_H_
#define PLENUM_MODEL_FLOW_TABLE_H_

#include <algorithm>
#include <array>
#include <cmath>

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
  // 1 − c by cells from equal pressures to the choked ratio: a cubic each, in shares of the cell.
  std::array<std::array<double, 4>, kCells> cubic_{};
};

inline double FlowTable::operator()(double ratio) const {
  if (ratio <= choked_ratio_) return choked_flow_;
  if (ratio >= 1.0) return 0.0;
  const double position = (1.0 - ratio) * cells_per_ratio_;
  const int cell = std::min(static_cast<int>(position), kCells - 1);
  const double t = position - cell;
  const std::array<double, 4>& cubic = cubic_[cell];
  const double u = cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
  return choked_flow_ * std::sqrt(u * (2.0 - u));
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_TABLE_H_
