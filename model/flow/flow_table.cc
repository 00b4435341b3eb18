#include "model/flow/flow_table.h"

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

FlowTable::FlowTable(const Series& series, double mirror_pa)
    : choked_flow_(series.choked_flow_m3_per_s_pa),
      choked_ratio_(series.choked_ratio),
      mirror_pa_(mirror_pa) {
  cells_per_ratio_ = kCells / (1.0 - choked_ratio_);
  knots_[0] = {0.0, -SlopeAtEqualPressures(series) / cells_per_ratio_};
  knots_[kCells] = {1.0, -SlopeWhereChoked(series) / cells_per_ratio_};
  double next = knots_[0].slope;  // a guess, from the slope where the curve begins
  for (int i = 1; i < kCells; ++i) {
    const CosineAndSlope exact =
        CosineNear(series, 1.0 - i / cells_per_ratio_, std::max(1.0 - next, 0.5 / kCells));
    knots_[i] = {1.0 - exact.cosine, exact.slope / cells_per_ratio_};
    // The next one lies about where the cubic of this cell goes on to.
    const Knot &before = knots_[i - 1], &here = knots_[i];
    next = 5.0 * before.value - 4.0 * here.value + 2.0 * before.slope + 4.0 * here.slope;
  }
  // Fritsch and Carlson's condition: three times the secant at most keeps each piece monotone.
  for (int i = 0; i < kCells; ++i) {
    const double most = 3.0 * (knots_[i + 1].value - knots_[i].value);
    knots_[i].slope = std::min(knots_[i].slope, most);
    knots_[i + 1].slope = std::min(knots_[i + 1].slope, most);
  }
}

}  // namespace plenum::model
