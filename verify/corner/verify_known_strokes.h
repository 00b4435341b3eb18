// What is known of the strokes of boxes, whatever the objective. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_KNOWN_STROKES_H_
#define PLENUM_VERIFY_CORNER_VERIFY_KNOWN_STROKES_H_

#include <array>
#include <map>
#include <optional>
#include <tuple>

#include "verify/corner/verify_pumped_stroke.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Keeps what it found: boxes of one tree share most of their ranges, and several objectives may be
// asked of each box.
class KnownStrokes {
 public:
  KnownStrokes(const Problem& problem, const ProofPlan& plan);
  KnownStrokes(const KnownStrokes&) = delete;
  KnownStrokes& operator=(const KnownStrokes&) = delete;

  // Its source pressure is no higher than the highest of any line of the group.
  const BestLine& Line(const Ranges& ranges, int group);

  PumpChoices& pumps() { return *pumps_; }  // of a plan with compressors

  // Pressures of a reservoir at the start of a group's stroke. A higher one is faster.
  struct Starts {
    double too_slow_pa = 0.0, fast_enough_pa = kUnlimited;
  };
  struct Query {
    const BestLine& line;  // of this
    const PumpCells& pumps;
    int group;
    Volumes volumes;
  };
  const Starts& Known(const Query& query) { return KnownOf(query); }
  bool TooSlow(const Query& query, double start_pa);
  // The least that is fast enough, or a little less; none where even the highest is too slow.
  std::optional<double> LeastStart(const Query& query, double low_pa, double high_pa);
  // The least start from low_pa on, or a little less, that leaves end_pa after half of the period;
  // none where even the highest does not.
  std::optional<double> LeastStartLeaving(const Query& query, double end_pa, double low_pa,
                                          double high_pa) const;

 private:
  using LineRange = std::array<int, 7>;  // group, ranges of its slots
  using StrokeKey = std::tuple<const BestLine*, const PumpCells*, double, double>;

  double HighestSource(int group);
  Starts& KnownOf(const Query& query);
  bool IsTooSlow(const Query& query, double start_pa) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  struct LineSlots {
    int tubing, fitting, valve;
  };
  std::vector<LineSlots> slots_;  // per group
  std::map<LineRange, BestLine> lines_;
  std::map<int, double> highest_source_pa_;  // per group
  std::optional<PumpChoices> pumps_;
  std::map<StrokeKey, Starts> known_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_KNOWN_STROKES_H_
