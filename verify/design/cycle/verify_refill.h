// A tank that pumps go on filling while strokes empty it: by sums over pressures, where the search
// integrates over the air that is pumped. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_REFILL_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_REFILL_H_

#include <vector>

#include "verify/design/verify_design.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Of a mission until its last period begins.
struct Refilled {
  double stop_pa = 0.0;   // the lowest that does, else the highest
  double lasts_s = 0.0;   // with pumps that stop as high as they can
  double on_s = 0.0;      // each pump
  double energy_j = 0.0;  // all pumps
};

// Pumps of a tank that must keep the air of one period above the pressure that its regulators ask.
class RefillCurve {
 public:
  RefillCurve(const Problem& problem, const Assembly& assembly, double source_pa, double air_m3);
  Refilled At(double fill_pa) const;
  // Least fill: above what is kept, by so much that rounding decides nothing.
  double LeastFill() const { return 1.0001 * kept_pa_; }

 private:
  // Since pressures were falling, with pumps that run, from a pressure to the one that is kept.
  struct Fallen {
    double seconds = 0.0, air_m3 = 0.0, energy_j = 0.0;
  };
  double Delivered(double pa) const;
  double Power(double pa) const;
  Fallen Between(double low_pa, double high_pa) const;
  Fallen Down(double from_pa) const;  // to what is kept
  double StopFor(double air_m3) const;

  const model::CompressorCurve& curve_;
  double pumps_, duty_;
  double capacity_m3_per_pa_, draw_m3_per_s_, seconds_;
  double kept_pa_, highest_pa_;
  bool holds_ = false;  // the pumps deliver what is drawn at the pressure that is kept
  std::vector<double> pressures_pa_;
  std::vector<Fallen> fallen_;  // from each pressure
};

// The fill of a tank for the mission, of which so much may be missed: the least, or of one that
// pumps fill what is best.
double FillFor(const Problem& problem, const Assembly& assembly, double source_pa,
               const Cycle& cycle, double slack);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_REFILL_H_
