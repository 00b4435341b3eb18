#include "optimizer/pump/stroke_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "optimizer/evaluate/root.h"
#include "optimizer/pump/pump_facts.h"

namespace plenum::optimizer {
namespace {

constexpr int kSteps = 12;  // while the reservoir is pumped up again

// A stroke panel by panel.
class Stroke {
 public:
  Stroke(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
         const StrokeStart& start)
      : line_(line),
        pumps_(pumps),
        start_(start),
        nodes_(line.curve->panels),
        count_(FilledAtOnce(problem, g)),
        kappa_(model::kReferencePressurePa * problem.ambient.temperature_k /
               model::kReferenceTemperatureK),
        per_kappa_(1.0 / kappa_),
        per_flow_(1.0 / (count_ * kappa_)),
        per_low_m3_(1.0 / start.low_m3),
        per_high_m3_(1.0 / start.high_m3) {}

  // To a node; false if that takes until after `limit_s`.
  bool Reach(int node, double limit_s) {
    while (at_ < node)
      if (!Advance(limit_s)) return false;
    return true;
  }

  // The reservoir at a later time if nothing more is drawn, at most. The pumps are slower the
  // fuller it is, so that each step at the rate of its start gives too much.
  double PumpUp(double until_s) {
    const double step_s = (until_s - time_s_) / kSteps;
    const double drawn = nodes_.drawn[at_];
    const double most = drawn + start_.high_m3 * (start_.stop_pa - start_.start_pa);
    for (int i = 0; i < kSteps && pumped_ < most; ++i)
      pumped_ += step_s * kappa_ * pumps_.rates.Delivery(Reservoir(pumped_ - drawn, true));
    return std::min(Reservoir(pumped_ - drawn, false), start_.stop_pa);
  }

  double time_s() const { return time_s_; }
  double Share(int node) const { return nodes_.drawn[at_] / nodes_.drawn[node]; }

 private:
  bool Advance(double limit_s) {
    const double after = nodes_.drawn[at_ + 1];
    while (floor_ < at_ &&
           nodes_.drawn[floor_ + 1] <= pumped_ - Taken(nodes_.pressure_pa[at_], true))
      ++floor_;
    const double lowest_pa = std::max(nodes_.pressure_pa[floor_], Reservoir(pumped_ - after, true));
    const PumpRates::Pace& pace = pumps_.rates.PaceAt(lowest_pa);
    const double delivery = kappa_ * pace.delivery_m3_per_s;
    // At the end the reservoir is no lower than the chambers.
    const double least_s = (after + Taken(nodes_.pressure_pa[at_ + 1], false) - pumped_) *
                           per_kappa_ * pace.seconds_per_m3;
    const double left_s = limit_s - time_s_;
    if (!(least_s <= left_s)) return false;
    // The more is pumped the shorter the panel: from too long a one comes too short a one. What was
    // pumped a panel ago will do for the long one, and that does not wait for the panel before.
    const double fewer = pumped_ <= after ? earlier_ : pumped_;
    const double long_s = std::min(std::max(least_s, FlowTime(fewer)), left_s);
    const double seconds = std::max({0.0, least_s, FlowTime(pumped_ + long_s * delivery)});
    if (!(seconds <= left_s)) return false;
    time_s_ += seconds;
    earlier_ = pumped_;
    pumped_ = std::min(pumped_ + seconds * delivery,
                       after + start_.high_m3 * (start_.stop_pa - start_.start_pa));
    ++at_;
    return true;
  }

  // ∫ W/q dp over the panel is at least W's mean over q in the middle, since W grows with p and 1/q
  // is convex: q is concave in s and p together, and s in p. Where that is not so, q is taken where
  // the panel begins. Of evacuated chambers W falls with p and s is convex in p: q is taken at W's
  // centroid, and s where the panel begins.
  double FlowTime(double pumped) const {
    const double before = nodes_.drawn[at_], after = nodes_.drawn[at_ + 1];
    double p = nodes_.pressure_pa[at_], drawn = before;
    if (line_.chamber.volume_curve.empty()) {
      p = nodes_.middle_pa[at_];
      if (!line_.chamber.evacuated &&
          (pumped < before || pumped > after || start_.low_m3 == start_.high_m3))
        drawn = nodes_.middle_drawn[at_];
    }
    const double source_pa = std::min(Reservoir(pumped - drawn, false), start_.stop_pa);
    return (after - before) * per_flow_ / line_.curve->flow.Flow(source_pa, p);
  }

  // Over the interval of volumes: the pressure of the reservoir with so much more content, and the
  // content that brings it to a pressure.
  double Reservoir(double more, bool least) const {
    return start_.start_pa + more * ((more < 0.0) == least ? per_low_m3_ : per_high_m3_);
  }
  double Taken(double pressure_pa, bool most) const {
    const double rise_pa = pressure_pa - start_.start_pa;
    return rise_pa * ((rise_pa > 0.0) == most ? start_.high_m3 : start_.low_m3);
  }

  const Line& line_;
  const PumpFacts& pumps_;
  const StrokeStart& start_;
  const StrokePanels& nodes_;
  int count_;
  double kappa_, per_kappa_, per_flow_, per_low_m3_, per_high_m3_;
  int at_ = 0;     // node
  int floor_ = 0;  // node that the reservoir does not fall below
  double pumped_ = 0.0, earlier_ = 0.0, time_s_ = 0.0;
};

// A guess for a stroke that has drawn a share of its air when time is up.
double Late(double share) { return 1.0 / (share + 1e-3) - 1.0; }

// Excess of a stroke; `left_pa`, if asked for, is what it at most leaves when its window is over,
// and is not set where the stroke is too slow.
double StrokeExcessBound(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
                         const StrokeStart& start, double* left_pa) {
  const double window_s = InflateWindow(problem, g);
  const double rise_max_s = RiseWindow(problem, g);
  Stroke stroke(problem, g, line, pumps, start);
  if (!stroke.Reach(kStrokePanels, rise_max_s)) return Late(stroke.Share(kStrokePanels));
  const double rise_s = stroke.time_s();
  if (!stroke.Reach(kStrokeNodes - 1, window_s)) return Late(stroke.Share(kStrokeNodes - 1));
  const double excess = std::max(rise_s / rise_max_s, stroke.time_s() / window_s) - 1.0;
  if (left_pa != nullptr) *left_pa = stroke.PumpUp(window_s);
  return excess;
}

}  // namespace

double LeastStrokeExcess(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
                         const StrokeStart& start) {
  return StrokeExcessBound(problem, g, line, pumps, start, nullptr);
}

double LeastStrokeExcess(const Problem& problem, const std::vector<const Line*>& lines,
                         const PumpFacts& pumps, const StrokeStart& start) {
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(lines.size()); ++g)
    excess = std::max(excess, LeastStrokeExcess(problem, g, *lines[g], pumps, start));
  return excess;
}

double LeastRiseTime(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
                     const StrokeStart& start) {
  const double limit_s = RiseWindow(problem, g);
  Stroke stroke(problem, g, line, pumps, start);
  return stroke.Reach(kStrokePanels, limit_s) ? stroke.time_s() : limit_s;
}

double LeastInflateTime(const Problem& problem, int g, const Line& line, const PumpFacts& pumps,
                        const StrokeStart& start) {
  const double window_s = InflateWindow(problem, g);
  Stroke stroke(problem, g, line, pumps, start);
  return stroke.Reach(kStrokeNodes - 1, window_s) ? stroke.time_s() : window_s;
}

bool RaiseStarts(const Problem& problem, const std::vector<const Line*>& lines,
                 const PumpFacts& pumps, double stop_pa, double low_m3, double high_m3,
                 double tolerance, std::array<double, 2>& start_pa) {
  // Air only flows downhill: the other group has left its own operating pressure at least.
  for (int g : {0, 1})
    start_pa[g] = std::max(start_pa[g], problem.groups[1 - g].chamber.operating_pressure_pa);
  for (bool raised = true; raised;) {
    raised = false;
    for (int g : {0, 1}) {
      const auto excess = [&](double p) {
        double left_pa = 0.0;
        const double own = StrokeExcessBound(problem, g, *lines[g], pumps,
                                             {p, stop_pa, low_m3, high_m3}, &left_pa);
        return own > 0.0 ? own : std::max(own, 1.0 - left_pa / start_pa[1 - g]);
      };
      if (start_pa[g] > stop_pa) return false;
      const std::optional<double> floor_pa = RaisedFloor(excess, start_pa[g], stop_pa, tolerance);
      if (!floor_pa) return false;
      raised = raised || *floor_pa > start_pa[g];
      start_pa[g] = *floor_pa;
    }
  }
  return true;
}

}  // namespace plenum::optimizer
