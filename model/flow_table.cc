#include "model/flow_table.h"

#include <algorithm>
#include <cmath>

namespace plenum::model {

FlowTable::FlowTable(const Series& series)
    : choked_flow_(series.choked_flow_m3_per_s_pa), choked_ratio_(series.choked_ratio) {
  const double y_choked = std::sqrt(1.0 - choked_ratio_);
  cells_per_y_ = kCells / y_choked;
  for (int i = 0; i <= kCells; ++i) {
    const double y = i / cells_per_y_;
    value_[i] = FlowAtRatio(series, 1.0 - y * y);
    // dq/dy = (dq/dr)·(dr/dy) with dr/dy = −2y; at y = 0 the limit, at the choked ratio zero.
    if (i == kCells) continue;
    const double q = i == 0 ? 1e-6 * choked_flow_ : value_[i];
    const RatioAndSlope at = RatioAndSlopeAtFlow(series, q);
    const double y_at_q = i == 0 ? std::sqrt(1.0 - at.ratio) : y;
    slope_[i] = (i == 0 ? q / y_at_q : -2.0 * y / at.slope_pa_s_per_m3) / cells_per_y_;
  }
}

double FlowTable::operator()(double ratio) const {
  if (ratio <= choked_ratio_) return choked_flow_;
  if (ratio >= 1.0) return 0.0;
  const double position = std::sqrt(1.0 - ratio) * cells_per_y_;
  const int cell = std::min(static_cast<int>(position), kCells - 1);
  const double t = position - cell;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * value_[cell] + t * slope_[cell]) +
         t * t * ((1.0 + 2.0 * s) * value_[cell + 1] - s * slope_[cell + 1]);
}

}  // namespace plenum::model
