// Continuous settings of a leaf with a made-to-measure reservoir: its volume and the stop pressure
// together, by branch and bound over rectangles of both.
//
// A rectangle is closed where the bounds that hold for all of it (settings_bounds.h) break a
// requirement or lie above the best point found. Points come from the sizing at one volume, once a
// rectangle that is still open is narrow or so many have been looked at that some point should be
// known, and from there by Ipopt: a leaf that its bounds rule out is never handed to a solver.
#ifndef PLENUM_OPTIMIZER_SIZING_CUSTOM_SIZING_H_
#define PLENUM_OPTIMIZER_SIZING_CUSTOM_SIZING_H_

#include <queue>
#include <vector>

#include "optimizer/pump/pump_bounds.h"
#include "optimizer/pump/settings_bounds.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

class CustomSizing {
 public:
  // `needs`: intervals of volumes outside which nothing will do, with what is known of each.
  CustomSizing(const Problem& problem, Candidate candidate,
               const std::vector<ReservoirNeed>& needs);
  // All volumes that can be made.
  CustomSizing(const Problem& problem, const Candidate& candidate);

  // A few rectangles more. True when done: leaf() is feasible with lower_bound within 1e-7 of the
  // objective (4e-7 where energy counts, 8e-7 where it is hard to prove), or infeasible; or
  // undecided, or feasible with a lower bound that holds, where a solver failed. Not done where it
  // was stopped.
  bool Refine();
  const Leaf& leaf() const { return leaf_; }
  // Before it is done, where energy does not count: the least volume that may still do.
  double volume_least_m3() const { return open_.top().box.low_m3; }

 private:
  struct Region {
    SettingsBox box;
    double bound = 0.0;  // of the objective
    bool examined = false;
    bool pressures_differ = false;  // and cost more of the bound than its volumes
    bool operator<(const Region& other) const { return bound > other.bound; }  // lowest on top
  };
  bool Decided() const;
  bool WithinLimits(const OperatingPoint& least) const;
  double LeastParts(double volume_m3) const;
  void Examine(Region region);
  bool Judge(Region& region, double tolerance);
  void Divide(const Region& region);
  void OfferIfNarrow(const Region& region);
  double ALittleMore(double volume_m3) const;
  bool Offer(double volume_m3);
  void Polish();
  bool Conclude(LeafStatus without_point);

  const Problem& problem_;
  Candidate candidate_;
  PumpTrend trend_;
  double tolerance_;
  std::priority_queue<Region> open_;
  Leaf leaf_;
  // The relative width of volumes, or else the number of steps, at which a point is sought next.
  double narrow_ = kUnlimited;
  int next_offer_ = 0;
  int steps_ = 0;
  bool failed_ = false;
};

// Intervals of volumes of a candidate that may do, by the cheap bounds of pump_bounds.h.
std::vector<ReservoirNeed> NeedsOfCandidate(const Problem& problem, const Candidate& candidate);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_CUSTOM_SIZING_H_
