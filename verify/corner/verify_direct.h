// Pumps without a reservoir, and batteries, of a box: what they take at least. Internal to
// verify*.cc.
//
// With any delivery that is no less than that of each pump of the box, and lines that take no less
// than each of its lines, no more flows while the chambers are at p than where the two are equal;
// and that does not rise with p. So over a panel of pressures it is at most that of the lower end.
// Energy per air, made non-falling, counts at the chamber's pressure, or of a single choice of
// pumps at the pressure in front of the best lines, which is no higher than in front of any other.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_DIRECT_H_
#define PLENUM_VERIFY_CORNER_VERIFY_DIRECT_H_

#include <map>
#include <tuple>
#include <vector>

#include "verify/corner/verify_pump.h"
#include "verify/design/cycle/verify_gait.h"

namespace plenum::verify {

class DirectPumps {
 public:
  DirectPumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts,
              KnownStrokes& strokes);

  // Bound on the objective of the box whose lines and compressors come to `chosen`.
  double Least(const Ranges& ranges, const std::vector<const BestLine*>& lines, double chosen);

 private:
  struct Stroke {
    double rise_s = 0.0, inflate_s = 0.0, pump_j = 0.0, node_pa = 0.0;
    double beyond_j = 0.0;  // of filling, beyond what holding takes for as long
  };
  using Range = PumpChoices::Range;

  const Stroke& StrokeOf(Range compressors, const BestLine& line, const Unit& unit);
  Stroke MakeStroke(Range compressors, const BestLine& line, const Unit& unit) const;
  bool Suits(const Ranges& ranges, const std::vector<const BestLine*>& lines) const;
  double LeastBattery(const Ranges& ranges, double energy_j, double node_pa, double coil_w) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  const SlotAmounts& amounts_;
  PumpChoices& choices_;
  int compressor_, battery_;  // slots
  std::vector<Unit> units_;
  int running_;  // feeds, at most at one time
  std::map<std::tuple<Range, const BestLine*, int, int>, Stroke> known_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_DIRECT_H_
