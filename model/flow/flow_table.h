// The flow curve of a line, tabulated once for use inside integrators.
//
// With q = q*·√(1 − c²) the cosine c rises smoothly from 0 at the choked ratio to 1 at equal
// pressures; it is tabulated over r by cubic Hermite pieces through exact values and slopes.
#ifndef PLENUM_MODEL_FLOW_FLOW_TABLE_H_
#define PLENUM_MODEL_FLOW_FLOW_TABLE_H_

#include <algorithm>
#include <array>
#include <cmath>

#include "model/flow/series.h"

namespace plenum::model {

class FlowTable {
 public:
  FlowTable() = default;
  // Of elements with a subsonic index of ½; `mirror_pa`: that of the chamber behind (chamber.h).
  explicit FlowTable(const Series& series, double mirror_pa = 0.0);

  // As FlowAtRatio(series, ratio), m³/(s·Pa).
  double operator()(double ratio) const;
  // The same and its slope by the ratio, below equal pressures.
  struct FlowAndSlope {
    double flow, slope;
  };
  FlowAndSlope WithSlope(double ratio) const;
  // m³/s ANR from a pressure down to another.
  double Flow(double upstream_pa, double downstream_pa) const {
    return (mirror_pa_ > 0.0 ? mirror_pa_ - downstream_pa : upstream_pa) *
           (*this)(PressureRatio(mirror_pa_, upstream_pa, downstream_pa));
  }

  // Where its pieces meet, from equal pressures (0) to the choked ratio (kCells).
  static constexpr int kCells = 48;
  double KnotRatio(int i) const { return 1.0 - i / cells_per_ratio_; }

 private:
  double choked_flow_ = 0.0, choked_ratio_ = 0.0, cells_per_ratio_ = 0.0, mirror_pa_ = 0.0;
  // 1 − c and its slope per cell where cells begin, from equal pressures to the choked ratio: each
  // cell is the cubic that both ends have in common.
  struct Knot {
    double value, slope;
  };
  std::array<Knot, kCells + 1> knots_{};
  struct Cubic {  // of a cell, and where a ratio lies in it
    double t, value, slope, square, cube;
    double At() const { return value + t * (slope + t * (square + t * cube)); }
  };
  Cubic CubicAt(double ratio) const;
};

inline double FlowTable::operator()(double ratio) const {
  if (ratio <= choked_ratio_) return choked_flow_;
  if (ratio >= 1.0) return 0.0;
  const double u = CubicAt(ratio).At();
  return choked_flow_ * std::sqrt(u * (2.0 - u));
}

inline FlowTable::FlowAndSlope FlowTable::WithSlope(double ratio) const {
  if (ratio <= choked_ratio_) return {choked_flow_, 0.0};
  const Cubic cell = CubicAt(ratio);
  const double u = cell.At();
  const double u_per_cell = cell.slope + cell.t * (2.0 * cell.square + cell.t * 3.0 * cell.cube);
  const double sine = std::sqrt(u * (2.0 - u));
  return {choked_flow_ * sine, -choked_flow_ * (1.0 - u) / sine * u_per_cell * cells_per_ratio_};
}

inline FlowTable::Cubic FlowTable::CubicAt(double ratio) const {
  const double position = (1.0 - ratio) * cells_per_ratio_;
  const int cell = std::min(static_cast<int>(position), kCells - 1);
  const Knot &from = knots_[cell], &to = knots_[cell + 1];
  const double rise = to.value - from.value;
  return {.t = position - cell,
          .value = from.value,
          .slope = from.slope,
          .square = 3.0 * rise - 2.0 * from.slope - to.slope,
          .cube = from.slope + to.slope - 2.0 * rise};
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_FLOW_TABLE_H_
