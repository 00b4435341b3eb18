#include "model/flow/series_curve.h"

#include <algorithm>
#include <cmath>

namespace plenum::model {
namespace {

constexpr std::size_t kIntervals = 128;
constexpr double kWidth = 1.0 / kIntervals;
// The slopes at both ends are limits, which are taken this close to them.
constexpr double kFromChoked = 1e-6, kFromNoFlow = 1e-9;

double ShareAt(double cosine) { return std::sqrt((1.0 - cosine) * (1.0 + cosine)); }  // q/q*

}  // namespace

std::optional<SeriesCurve> SeriesCurve::Of(const Series& series) {
  SeriesCurve curve(series);
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const double share = ShareAt((static_cast<double>(i) + 0.5) * kWidth);
    const double ratio = RatioAtFlow(series, series.choked_flow_m3_per_s_pa * share);
    const double read = ShareAt(curve.CosineAt(ratio));
    if (!(std::abs(read - share) <= kCurveError * share)) return {};
  }
  return curve;
}

SeriesCurve::SeriesCurve(const Series& series) : points_(kIntervals + 1) {
  const double choked_flow = series.choked_flow_m3_per_s_pa;
  for (std::size_t i = 0; i <= kIntervals; ++i) {
    const double c = std::clamp(static_cast<double>(i) * kWidth, kFromChoked, 1.0 - kFromNoFlow);
    const double share = ShareAt(c);
    const RatioAndSlope at = RatioAndSlopeAtFlow(series, choked_flow * share);
    points_[i] = {at.ratio, -share / (at.slope_pa_s_per_m3 * choked_flow * c)};
  }
  points_.front().ratio = series.choked_ratio;
  points_.back().ratio = 1.0;
}

double SeriesCurve::CosineAt(double ratio) {
  while (at_ > 0 && ratio < points_[at_].ratio) --at_;
  while (at_ + 1 < kIntervals && ratio > points_[at_ + 1].ratio) ++at_;
  const Point &left = points_[at_], &right = points_[at_ + 1];
  const double width = right.ratio - left.ratio;
  const double t = (ratio - left.ratio) / width;
  const double bend_left = left.slope * width - kWidth, bend_right = kWidth - right.slope * width;
  return kWidth * (static_cast<double>(at_) + t) +
         t * (1.0 - t) * ((1.0 - t) * bend_left + t * bend_right);
}

}  // namespace plenum::model
