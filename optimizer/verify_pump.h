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

#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "optimizer/verify_dominance.h"
#include "optimizer/verify_line.h"

namespace plenum::optimizer {

using SlotAmounts = std::vector<std::vector<ItemAmounts>>;  // per slot and choice

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

// The best of several pumps over cells of pressure.
struct PumpCells {
  std::vector<double> delivery_m3_per_s, energy_j_per_m3;
  double highest_pa = 0.0, duty_max = 0.0, current_a = kUnlimited;
};

class Pumps {
 public:
  Pumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts);

  // Least objective of the box whose lines and compressors come to `chosen`; not looked at closely
  // once it is above `enough`.
  double Least(const Ranges& ranges, const std::vector<const BestLine*>& lines, double chosen,
               double enough);

 private:
  using Range = std::pair<int, int>;
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

  PumpCells CellsOf(const ProofItem& item) const;
  const PumpCells& CellsIn(Range range);
  const Packs& PacksIn(Range compressors, Range batteries);
  double PressureOf(std::size_t cell) const;
  double DeliveryAt(const PumpCells& pumps, double pressure_pa) const;

  bool TooSlow(const Case& c, int group, double start_pa, Volumes v) const;
  std::optional<double> LeastStart(const Case& c, int group, double low_pa, double high_pa,
                                   Volumes v);
  std::optional<double> FindStart(const Case& c, int group, double low_pa, double high_pa,
                                  Volumes v) const;
  double LeastAt(const Case& c, double reservoir, Volumes v);
  double LeastMade(const Case& c, Volumes v);
  double Rest(const Case& c, const std::vector<double>& starts_pa, double stop_pa, Volumes v) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  const SlotAmounts& amounts_;
  int compressor_, reservoir_, battery_;  // slots
  double content_per_m3_;                 // κ
  double highest_pa_;                     // of any compressor
  std::vector<PumpCells> items_;          // of single choices
  std::map<Range, PumpCells> ranges_;
  std::map<std::array<int, 4>, Packs> packs_;
  using StartKey = std::tuple<const BestLine*, const PumpCells*, double, double, double, double>;
  std::map<StartKey, std::optional<double>> starts_;  // found before
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_PUMP_H_
