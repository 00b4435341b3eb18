#include "verify/corner/verify_pumped_stroke.h"

#include <algorithm>

#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr int kStepsClosed = 24;
constexpr int kCoarse = 4;                 // panels in one, at first
constexpr double kClearly = 0.85;          // of a limit: finer panels would not change it
constexpr double kSourceTolerance = 1e-4;  // of pressures: what is pumped by the end of a panel
constexpr double kEqualTolerance = 1e-4;   // of the pressure where all are equal
constexpr int kEqualLooksMax = 12;
constexpr double kFlowSlack = 1.0 + 1e-4;  // of the flow table

class Stroke {
 public:
  Stroke(const Problem& problem, const PumpChoices& choices, const PumpCells& pumps,
         const BestLine& line, int group, Volumes volumes, double start_pa)
      : problem_(problem),
        choices_(choices),
        pumps_(pumps),
        line_(line),
        group_(group),
        volumes_(volumes),
        start_pa_(start_pa),
        content_per_m3_(ContentPerVolume(problem)),
        count_(MostAtOnce(problem, group)),
        window_s_(FillWindow(problem, group) * (1.0 + kSumTolerance)),
        equal_pa_(problem.ambient.pressure_pa) {}

  // So many panels at a time. False: the target comes later than `rise_max_s`, or the operating
  // pressure than the window.
  bool Fill(double rise_max_s, int stride) {
    if (!FillAlong(line_.filling.to_target, std::min(rise_max_s, window_s_), stride)) return false;
    rise_s_ = seconds_;
    return FillAlong(line_.filling.to_operating, window_s_, stride);
  }
  bool HasTimeToSpare(double rise_max_s) const {
    return rise_s_ <= kClearly * rise_max_s && seconds_ <= kClearly * window_s_;
  }

  PumpedStroke Run() {
    PumpedStroke stroke;
    const bool filled = Fill(kUnlimited, 2);
    stroke.rise_s = rise_s_;
    if (!filled) return stroke;
    stroke.inflate_s = seconds_;
    RefillClosed();
    stroke.end_pa = MostSource(pumped_, line_.filling.to_operating.back().least_drawn);
    return stroke;
  }

 private:
  double MostSource(double pumped, double drawn) const {
    return start_pa_ + (pumped - drawn) / (pumped < drawn ? volumes_.high_m3 : volumes_.low_m3);
  }
  double LeftBy(double pumped, double drawn) const {
    return start_pa_ + (pumped - drawn) / (pumped < drawn ? volumes_.low_m3 : volumes_.high_m3);
  }
  // While chambers at most at `full` fill: none is above the reservoir, which is at least where
  // all of them would be equal. What is pumped only grows, and so does that pressure.
  double LeastSource(double pumped, const StrokeKnot& full) {
    const double left_pa = LeftBy(pumped, full.most_drawn);
    if (left_pa >= full.pressure_pa) return left_pa;
    const double share = static_cast<double>(count_) / problem_.groups[group_].count;
    const auto above = [&](double p) {
      return LeftBy(pumped, share * Drawn(problem_, group_, line_.widest, p)) - p;
    };
    double high_pa = full.pressure_pa;
    double low_above = above(equal_pa_), high_above = left_pa - high_pa;
    for (int i = 0; i < kEqualLooksMax && high_pa - equal_pa_ > kEqualTolerance * high_pa; ++i) {
      const double width_pa = high_pa - equal_pa_;
      const double crossing_pa = equal_pa_ + width_pa * low_above / (low_above - high_above);
      const double p = i % 3 == 2 ? equal_pa_ + 0.5 * width_pa
                                  : std::clamp(crossing_pa - 0.3 * kEqualTolerance * high_pa,
                                               equal_pa_, high_pa);
      const double here = above(p);
      (here > 0.0 ? equal_pa_ : high_pa) = p;
      (here > 0.0 ? low_above : high_above) = here;
    }
    return equal_pa_;
  }
  // Content per second.
  double MostDelivered(double source_pa) const {
    return content_per_m3_ *
           choices_.DeliveryAt(pumps_, std::max(source_pa, problem_.ambient.pressure_pa));
  }

  // False: that takes longer than `until_s`.
  bool FillAlong(const std::vector<StrokeKnot>& knots, double until_s, int stride) {
    for (std::size_t i = stride; i < knots.size(); i += stride)
      if (knots[i].pressure_pa > knots[i - stride].pressure_pa &&
          !FillPanel(knots[i - stride], knots[i], until_s))
        return false;
    return true;
  }

  // The air pumped by its end is where it makes the panel last just as long as that takes: more of
  // it makes the panel shorter, so that each guess gives one on the other side.
  bool FillPanel(const StrokeKnot& from, const StrokeKnot& to, double until_s) {
    const double more = to.least_drawn - from.least_drawn;
    const double rate = MostDelivered(LeastSource(pumped_, to));
    const auto panel_s = [&](double pumped) {
      const double source_pa = MostSource(pumped, from.least_drawn);
      if (!(source_pa > from.pressure_pa)) return kUnlimited;
      const double flow = count_ * content_per_m3_ * kFlowSlack *
                          line_.filling.flow.Flow(source_pa, from.pressure_pa);
      return flow > 0.0 ? more / flow : kUnlimited;
    };
    const auto pumped_by_end = [&](double pumped) {
      return rate > 0.0 ? pumped_ + rate * panel_s(pumped) : pumped_;
    };
    double low = pumped_, high = pumped_by_end(pumped_);
    const double most = pumped_ + rate * (until_s - seconds_);
    if (!(high <= most)) {
      high = most;
      if (!(pumped_by_end(high) <= high)) return false;
    }
    const auto wide = [&] {
      return (high - low) / volumes_.low_m3 > kSourceTolerance * from.pressure_pa;
    };
    while (wide()) {
      const double before = high - low;
      low = std::max(low, pumped_by_end(high));
      if (wide()) high = std::min(high, pumped_by_end(low));
      if (high - low < 0.5 * before) continue;
      const double middle = 0.5 * (low + high);
      (pumped_by_end(middle) > middle ? low : high) = middle;
    }
    // Close to equal pressures the pumps tell how long it takes, and the flow hardly does.
    seconds_ += std::max(panel_s(high), rate > 0.0 ? (low - pumped_) / rate : 0.0);
    pumped_ = high;
    return seconds_ <= until_s;
  }

  // A valve that cannot hold draws on, from a source at the operating pressure or above.
  void RefillClosed() {
    const StrokeKnot& full = line_.filling.to_operating.back();
    const double left_s = window_s_ - seconds_;
    const double open = line_.all_hold ? 0.0 : pumped_ + left_s * MostDelivered(full.pressure_pa);
    for (int i = 0; i < kStepsClosed; ++i)
      pumped_ += left_s / kStepsClosed * MostDelivered(LeastSource(pumped_, full));
    pumped_ = std::max(pumped_, open);
  }

  const Problem& problem_;
  const PumpChoices& choices_;
  const PumpCells& pumps_;
  const BestLine& line_;
  int group_;
  Volumes volumes_;
  double start_pa_;
  double content_per_m3_;
  int count_;
  double window_s_;
  double pumped_ = 0.0, seconds_ = 0.0, rise_s_ = kUnlimited;
  double equal_pa_;  // that the reservoir is not below
};

}  // namespace

PumpedStroke FastestStroke(const Problem& problem, const PumpChoices& choices,
                           const PumpCells& pumps, const BestLine& line, int group, Volumes volumes,
                           double start_pa) {
  return Stroke(problem, choices, pumps, line, group, volumes, start_pa).Run();
}

bool MayFill(const Problem& problem, const PumpChoices& choices, const PumpCells& pumps,
             const BestLine& line, int group, Volumes volumes, double start_pa, double rise_max_s) {
  const auto begin = [&] {
    return Stroke(problem, choices, pumps, line, group, volumes, start_pa);
  };
  Stroke coarse = begin();
  if (!coarse.Fill(rise_max_s, kCoarse)) return false;
  return coarse.HasTimeToSpare(rise_max_s) || begin().Fill(rise_max_s, 1);
}

}  // namespace plenum::verify
