#include "verify/corner/verify_pumped_stroke.h"

#include <algorithm>

#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr int kPanelsToTarget = 24, kPanelsBeyond = 4, kStepsClosed = 24;
constexpr double kSourceTolerance = 1e-4;  // of pressures: what is pumped by the end of a panel
constexpr double kEqualTolerance = 1e-4;   // of the pressure where all are equal
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
        window_s_(FillWindow(problem, group) * (1.0 + kSumTolerance)) {}

  PumpedStroke Run() {
    PumpedStroke stroke;
    const double target_pa = PressureAt(problem_, group_, problem_.rise_fraction);
    const double operating_pa = problem_.groups[group_].chamber.operating_pressure_pa;
    if (!FillTo(target_pa, kPanelsToTarget)) return stroke;
    stroke.rise_s = seconds_;
    if (!FillTo(operating_pa, kPanelsBeyond)) return stroke;
    stroke.inflate_s = seconds_;
    RefillClosed(operating_pa);
    stroke.end_pa = MostSource(pumped_, DrawnAtOnce(line_.chamber, operating_pa));
    return stroke;
  }

 private:
  double DrawnAtOnce(const model::Chamber& chamber, double pressure_pa) const {
    return Drawn(problem_, group_, chamber, pressure_pa) * count_ / problem_.groups[group_].count;
  }
  double MostSource(double pumped, double drawn) const {
    return start_pa_ + (pumped - drawn) / (pumped < drawn ? volumes_.high_m3 : volumes_.low_m3);
  }
  // While chambers at most at `full_pa` fill: none is above the reservoir, which is at least where
  // all of them would be equal.
  double LeastSource(double pumped, double full_pa) const {
    const auto left_by = [&](double p) {
      const double drawn = DrawnAtOnce(line_.widest, p);
      return start_pa_ + (pumped - drawn) / (pumped < drawn ? volumes_.low_m3 : volumes_.high_m3);
    };
    const double left_pa = left_by(full_pa);
    if (left_pa >= full_pa) return left_pa;
    double low = problem_.ambient.pressure_pa, high = full_pa;
    while (high - low > kEqualTolerance * high) {
      const double middle = 0.5 * (low + high);
      (left_by(middle) > middle ? low : high) = middle;
    }
    return low;
  }
  // Content per second.
  double MostDelivered(double source_pa) const {
    return content_per_m3_ *
           choices_.DeliveryAt(pumps_, std::max(source_pa, problem_.ambient.pressure_pa));
  }

  // False: that takes more than the window.
  bool FillTo(double end_pa, int panels) {
    const double begin_pa = pressure_pa_ > 0.0 ? pressure_pa_ : problem_.ambient.pressure_pa;
    const auto knot_pa = [&](int i) {  // closer to each other towards the end, where flow falls
      const double left = 1.0 - static_cast<double>(i) / panels;
      return end_pa - (end_pa - begin_pa) * left * left;
    };
    for (int i = 1; i <= panels; ++i) {
      const double from_pa = knot_pa(i - 1), to_pa = knot_pa(i);
      if (to_pa > from_pa && !FillPanel(from_pa, to_pa)) return false;
    }
    pressure_pa_ = end_pa;
    return true;
  }

  // The air pumped by its end is where it makes the panel last just as long as that takes.
  bool FillPanel(double from_pa, double to_pa) {
    const double drawn = DrawnAtOnce(line_.chamber, from_pa);
    const double more = DrawnAtOnce(line_.chamber, to_pa) - drawn;
    const double rate = MostDelivered(LeastSource(pumped_, to_pa));
    const auto panel_s = [&](double pumped) {
      const double source_pa = MostSource(pumped, drawn);
      if (!(source_pa > from_pa)) return kUnlimited;
      const double flow =
          count_ * content_per_m3_ * kFlowSlack * line_.fill_flow.Flow(source_pa, from_pa);
      return flow > 0.0 ? more / flow : kUnlimited;
    };
    double low = pumped_, high = pumped_ + rate * (window_s_ - seconds_);
    if (!(pumped_ + rate * panel_s(high) <= high)) return false;
    high = std::min(high, pumped_ + rate * panel_s(pumped_));
    while (MostSource(high, drawn) - MostSource(low, drawn) > kSourceTolerance * from_pa) {
      const double middle = 0.5 * (low + high);
      (pumped_ + rate * panel_s(middle) > middle ? low : high) = middle;
    }
    pumped_ = high;
    seconds_ += panel_s(high);
    return seconds_ <= window_s_;
  }

  // A valve that cannot hold draws on, from a source at the operating pressure or above.
  void RefillClosed(double operating_pa) {
    const double left_s = window_s_ - seconds_;
    const double open = line_.all_hold ? 0.0 : pumped_ + left_s * MostDelivered(operating_pa);
    for (int i = 0; i < kStepsClosed; ++i)
      pumped_ += left_s / kStepsClosed * MostDelivered(LeastSource(pumped_, operating_pa));
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
  double pressure_pa_ = 0.0, pumped_ = 0.0, seconds_ = 0.0;
};

}  // namespace

PumpedStroke FastestStroke(const Problem& problem, const PumpChoices& choices,
                           const PumpCells& pumps, const BestLine& line, int group, Volumes volumes,
                           double start_pa) {
  return Stroke(problem, choices, pumps, line, group, volumes, start_pa).Run();
}

}  // namespace plenum::verify
