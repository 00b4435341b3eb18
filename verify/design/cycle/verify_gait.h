// When strokes begin, worked out once more from the requirements. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GAIT_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GAIT_H_

#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

// Actuators of a group that fill at once: those with one phase.
struct Unit {
  int group, count;
  std::vector<double> begins;  // of the period, from 0 to 1, rising
  int feeds = 1;               // pumps of their own that fill it, each as many actuators
};
std::vector<Unit> UnitsOf(const Problem& problem);

// s: most that an inflation and a deflation may take, and from the begin of a unit's strokes to the
// next begin of any that the same source, or the same feed of pumps, fills, at least.
double FillWindow(const Problem& problem, int group);
double VentWindow(const Problem& problem, int group);
double UntilNext(const Problem& problem, const std::vector<Unit>& units, const Unit& unit);

// How long a feed whose pumps hold on runs for a unit, s: from one of its begins to the end of its
// window or the next begin that the feed serves, and in a period.
double RunFor(const Problem& problem, const std::vector<Unit>& units, const Unit& unit,
              double begin);
double RunSeconds(const Problem& problem, const std::vector<Unit>& units, const Unit& unit);

// Feeds of pumps without a reservoir, and the most of them that may run at one time.
int Feeds(const Problem& problem);
int FeedsRunning(const Problem& problem);
// How many times a design buys what a choice of the source's family is: of pumps once a feed.
int TimesBought(const Problem& problem, Family family);

int MostAtOnce(const Problem& problem, int group);
// Energised in a period, s, beside the time that valves that hold take to inflate; with the time
// that pumps which hold on fill and hold, for which such valves stand open.
double CoilSeconds(const Problem& problem, int group, bool holds);

// Whether several units begin and end as one; whether some do begin together at all, on one feed.
bool AllAtOnce(const Problem& problem);
bool SomeAtOnce(const Problem& problem);
// Equal bursts of all actuators in a period; 0 where strokes come at other times, too.
int Bursts(const Problem& problem);
// Two groups, each of which inflates for the half of the period in which the other does not.
bool Alternate(const Problem& problem);
// Whether one unit may still inflate when another begins.
bool MayOverlap(const Problem& problem);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GAIT_H_
