// Pumps, reservoirs and batteries of a box: what they take at least. Internal to verify*.cc.
//
// Let p_1 be the reservoir's pressure when a stroke begins and m the air pumped since, ANR. No
// chamber is above the reservoir while it fills, so what was drawn is at most D(p), the content of
// all chambers at the reservoir's pressure p (at the operating pressure, where it is above):
//   V·p + D(p) ≥ V·p_1 + κ·m,   κ = P0·T/T0.
// So each bit of air is pumped at p(m) or above, where energy and time per air, made non-falling,
// bound what it takes. The pumps deliver most at the lowest such pressure, m = 0; a closed
// reservoir that holds all of it from the start is at every instant as full as the real one, and
// its rise time bounds p_1 from below. For several groups D is the air of a whole cycle; where two
// groups take turns the cheapest bits of both strokes count. Volumes: p rises with V, and so does
// the stroke.
#ifndef PLENUM_OPTIMIZER_VERIFY_PUMP_H_
#define PLENUM_OPTIMIZER_VERIFY_PUMP_H_

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "optimizer/verify_pump_choices.h"

namespace plenum::optimizer {

class Pumps {
 public:
  Pumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts);

  // Bound on the objective of the box whose lines and compressors come to `chosen` and whose parts
  // to `floor`, which is returned where the bound is not above `enough`.
  double Least(const Ranges& ranges, const std::vector<const BestLine*>& lines, double chosen,
               double floor, double enough);

 private:
  struct Case {  // one interval of volumes
    const PumpCells& pumps;
    const Packs& packs;
    const std::vector<const BestLine*>& lines;
    double air_m3, coil_w, inflating_j;  // per cycle
    double chosen, enough;
    double reservoir_pa;  // most that it stands
  };
  struct Volumes {
    double low_m3, high_m3;
  };

  bool TooSlow(const Case& c, int group, double start_pa, Volumes v) const;
  std::optional<double> LeastStart(const Case& c, int group, double low_pa, double high_pa,
                                   Volumes v);
  std::optional<double> FindStart(const Case& c, int group, double low_pa, double high_pa,
                                  Volumes v) const;
  double LeastTogether(const Case& c, double enough, double low_pa, double high_pa,
                       Volumes v) const;
  double LeastInTurns(const Case& c, double enough, double low_pa, double high_pa, Volumes v);
  double LeastAt(const Case& c, double reservoir, Volumes v);
  double LeastMade(const Case& c, Volumes v);
  double Rest(const Case& c, const std::vector<double>& starts_pa, double stop_pa, Volumes v) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  const SlotAmounts& amounts_;
  PumpChoices choices_;
  int compressor_, reservoir_, battery_;  // slots
  double content_per_m3_;                 // κ
  using StartKey = std::tuple<const BestLine*, const PumpCells*, double, double, double, double>;
  std::map<StartKey, std::optional<double>> starts_;  // found before
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_PUMP_H_
