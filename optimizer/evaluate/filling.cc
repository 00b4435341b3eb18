#include "optimizer/evaluate/filling.h"

#include <algorithm>
#include <cmath>

#include "model/strokes/stroke.h"
#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {

Filling::Filling(const Problem& problem, int group, std::span<const model::FlowElement> elements,
                 double flow_factor, const model::Chamber& chamber, double slack,
                 double flow_max_m3_per_s)
    : problem_(problem),
      group_(problem.groups[group]),
      elements_(elements),
      flow_factor_(flow_factor),
      chamber_(chamber),
      flow_max_m3_per_s_(flow_max_m3_per_s),
      operating_pa_(group_.chamber.operating_pressure_pa),
      rise_pa_(RiseTarget(problem, group_)),
      window_s_(InflateWindow(problem, group) * slack),
      rise_max_s_(group_.rise_time_max_s * slack) {}

const model::Series& Filling::series() {
  if (!series_) series_ = model::MakeSeries(elements_, flow_factor_);
  return *series_;
}

double Filling::FillTime(double source_pa, double to_pa) {
  return model::FillTime(series(), chamber_, source_pa, model::RestPa(chamber_), to_pa,
                         problem_.ambient.temperature_k, flow_max_m3_per_s_);
}

double Filling::Lateness(double source_pa) {
  const double inflate_s = InflateTime(source_pa);
  const double late_s = inflate_s - window_s_;
  if (std::isinf(rise_max_s_)) return late_s;
  // Reaching the target takes no longer than reaching the operating pressure.
  if (inflate_s <= group_.rise_time_max_s)
    return std::max(late_s, inflate_s - group_.rise_time_max_s);
  return std::max(late_s, FillTime(source_pa, rise_pa_) - rise_max_s_);
}

const Filling::Enclosures& Filling::Enclose(double source_pa) {
  if (source_pa == enclosed_pa_) return enclosures_;
  const model::CurveNodes nodes =
      model::MarchNodes(elements_, flow_factor_,
                        model::PressureRatio(model::MirrorPa(chamber_), source_pa, operating_pa_),
                        flow_max_m3_per_s_ / source_pa);
  const auto enclose = [&](double to_pa) {
    return model::EncloseFillTime(nodes, chamber_, source_pa, model::RestPa(chamber_), to_pa,
                                  problem_.ambient.temperature_k);
  };
  enclosed_pa_ = source_pa;
  enclosures_ = {nodes.size > 0, enclose(operating_pa_), {}};
  if (std::isfinite(rise_max_s_)) enclosures_.rise = enclose(rise_pa_);
  return enclosures_;
}

std::optional<double> Filling::LatenessAtLeast(double source_pa) {
  const auto& [known, inflate, rise] = Enclose(source_pa);
  if (!known) return std::nullopt;
  return std::max(inflate.low_s - window_s_, rise.low_s - rise_max_s_);
}

double Filling::InflateTimeAtLeast(double source_pa) { return Enclose(source_pa).inflate.low_s; }

bool Filling::InTime(double source_pa) {
  const auto most_s = [&](double to_pa) {
    return model::FillTimeAtMost(elements_, flow_factor_, chamber_, source_pa,
                                 model::RestPa(chamber_), to_pa, problem_.ambient.temperature_k,
                                 flow_max_m3_per_s_);
  };
  if (const double inflate_s = most_s(operating_pa_);
      inflate_s <= window_s_ && (inflate_s <= rise_max_s_ || most_s(rise_pa_) <= rise_max_s_))
    return true;
  const auto& [known, inflate, rise] = Enclose(source_pa);
  if (inflate.low_s > window_s_ || rise.low_s > rise_max_s_) return false;
  if (inflate.high_s <= window_s_ &&
      (std::isinf(rise_max_s_) || std::min(inflate.high_s, rise.high_s) <= rise_max_s_))
    return true;
  return Lateness(source_pa) <= 0.0;
}

}  // namespace plenum::optimizer
