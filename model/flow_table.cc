#include "model/flow_table.h"

#include <algorithm>
#include <cmath>

namespace plenum::model {
namespace {

// d(1 − c)/dr inside the curve.
double Slope(const Series& series, double cosine) {
  const double choked = series.choked_flow_m3_per_s_pa;
  const double flow = choked * std::sqrt((1.0 - cosine) * (1.0 + cosine));
  return flow / (choked * choked * cosine * RatioAndSlopeAtFlow(series, flow).slope_pa_s_per_m3);
}

// At equal pressures 1 − r = ½·Σ(1 − b)·(q/C)² and 1 − c = ½·(q/q*)².
double SlopeAtEqualPressures(const Series& series) {
  double loss = 0.0;
  for (std::size_t i = 0; i < series.size; ++i) {
    const double c =
        series.choked_flow_m3_per_s_pa / series.elements[i].sonic_conductance_m3_per_s_pa;
    loss += (1.0 - series.elements[i].critical_ratio) * c * c;
  }
  return -1.0 / loss;
}

// At the choked ratio the slope is 0/0; extrapolated from two points next to it.
double SlopeWhereChoked(const Series& series) {
  return 1.0 / (2.0 / Slope(series, 1e-4) - 1.0 / Slope(series, 2e-4));
}

}  // namespace

FlowTable::FlowTable(const Series& series)
    : choked_flow_(series.choked_flow_m3_per_s_pa), choked_ratio_(series.choked_ratio) {
  cells_per_ratio_ = kCells / (1.0 - choked_ratio_);
  std::array<double, kCells + 1> value{}, slope{};  // slope: per cell
  value[kCells] = 1.0;
  slope[0] = -SlopeAtEqualPressures(series) / cells_per_ratio_;
  slope[kCells] = -SlopeWhereChoked(series) / cells_per_ratio_;
  double next = slope[0];  // a guess, from the slope where the curve begins
  for (int i = 1; i < kCells; ++i) {
    const CosineAndSlope exact =
        CosineNear(series, 1.0 - i / cells_per_ratio_, std::max(1.0 - next, 0.5 / kCells));
    value[i] = 1.0 - exact.cosine;
    slope[i] = exact.slope / cells_per_ratio_;
    // The next one lies about where the cubic of this cell goes on to.
    next = 5.0 * value[i - 1] - 4.0 * value[i] + 2.0 * slope[i - 1] + 4.0 * slope[i];
  }
  // Fritsch and Carlson's condition: three times the secant at most keeps each piece monotone.
  for (int i = 0; i < kCells; ++i) {
    const double most = 3.0 * (value[i + 1] - value[i]);
    slope[i] = std::min(slope[i], most);
    slope[i + 1] = std::min(slope[i + 1], most);
  }
  for (int i = 0; i < kCells; ++i) {
    const double rise = value[i + 1] - value[i];
    cubic_[i] = {value[i], slope[i], 3.0 * rise - 2.0 * slope[i] - slope[i + 1],
                 slope[i] + slope[i + 1] - 2.0 * rise};
  }
}

}  // namespace plenum::model
