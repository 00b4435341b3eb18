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
// the stroke. Bursts (verify_gait.h) that come several times in a cycle take so many times as much.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_PUMP_H_
#define PLENUM_VERIFY_CORNER_VERIFY_PUMP_H_

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "verify/corner/verify_known_strokes.h"
#include "verify/design/verify_choice.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Batteries of a range by energy.
class Packs {
 public:
  struct Pack {
    double energy_j, objective;
  };
  explicit Packs(std::vector<Pack> packs);
  double Least(double energy_j) const;  // share of the objective; +∞: none has the energy

 private:
  std::vector<Pack> packs_;  // by energy; objective: the least of this and all with more
};

class Pumps {
 public:
  Pumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts,
        KnownStrokes& strokes);

  // That any pumps of the box can keep a reservoir at.
  double HighestPa(const Ranges& ranges) {
    return choices_.CellsIn(ranges[compressor_]).highest_pa;
  }

  // Bound on the objective of a box. `others`: what all but the reservoir come to at least.
  struct Objectives {
    double chosen;  // of lines and compressors, at least
    double floor;   // of all parts, which is given where the bound is not above `enough`
    double enough;
  };
  double Least(const Ranges& ranges, const std::vector<const BestLine*>& lines,
               const ItemAmounts& others, const Objectives& objectives);

 private:
  struct Case {  // of reservoirs
    const PumpCells& pumps;
    const Packs& packs;
    const std::vector<const BestLine*>& lines;
    // For each stroke that counts by itself the content, Pa·m³, that is drawn by the time that the
    // reservoir is at the lower end of each cell; of all strokes together that of a cycle.
    std::vector<const std::vector<double>*> drawn;
    double air_m3;               // of a burst, or of a cycle where there are none
    double coil_j, inflating_j;  // per cycle
    const ItemAmounts& others;
    double chosen, enough;
    double reservoir_pa;  // most that it stands
    bool made;            // to measure
  };
  using Range = PumpChoices::Range;

  const Packs& PacksIn(Range compressors, Range batteries);
  const std::vector<double>& DrawnBy(const BestLine& line, int group);
  ItemAmounts Made(double volume_m3, double stop_pa) const;  // of a made-to-measure reservoir
  bool IsTooMuch(const Case& c, const ItemAmounts& reservoir) const;
  double FirstFill(const Case& c, double stop_pa, Volumes v) const;
  KnownStrokes::Query QueryOf(const Case& c, int group, Volumes v) const;
  double LeastTogether(const Case& c, double enough, double low_pa, double high_pa, Volumes v);
  double LeastInTurns(const Case& c, double enough, double low_pa, double high_pa, Volumes v);
  bool RaiseStarts(const Case& c, double high_pa, Volumes v, const std::function<bool()>& settled,
                   std::vector<double>& starts_pa) const;
  double LeastAt(const Case& c, double reservoir, Volumes v);
  double LeastMade(const Case& c, Volumes v);
  double Rest(const Case& c, const std::vector<double>& starts_pa, double stop_pa, Volumes v) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  const SlotAmounts& amounts_;
  KnownStrokes& strokes_;
  PumpChoices& choices_;
  int compressor_, reservoir_, battery_;  // slots
  double content_per_m3_;                 // κ
  int bursts_;                            // in a cycle; 0: other strokes
  std::map<std::array<int, 4>, Packs> packs_;
  std::map<const BestLine*, std::vector<double>> drawn_by_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_PUMP_H_
