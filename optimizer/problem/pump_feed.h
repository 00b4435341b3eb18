// Which actuators pumps without a reservoir feed.
//
// A feed is some pumps and what they fill: all groups one after another (shared), the actuators of
// one group (per group), or one actuator (per actuator). All feeds of a design have the same pumps,
// as many of them. A feed fills one squad (gait.h) at a time, from ambient pressure in front of its
// lines, and is off else; other feeds may run meanwhile.
//
// Pumps that hold on (PumpsHoldOn()) run from a squad's command until it is to be emptied, or
// until their feed begins the next squad: shared pumps hold what they filled last. While they hold
// the valve between them and the squad stays open, they stand at its operating pressure and take
// their power there; what they deliver beyond what leaks away blows off, by a relief or a bypass
// that is no part of the design. What no pump holds any more its valve keeps full, as else.
//
// A pump of one actuator feeds its line past the valve, which only vents (a 2/2 valve): what the
// line takes crosses tube and fittings alone, and the pump's own valves keep the actuator full.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PUMP_FEED_H_
#define PLENUM_OPTIMIZER_PROBLEM_PUMP_FEED_H_

#include <vector>

#include "optimizer/problem/gait.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Of a design of pumps without a reservoir; 1 where they are shared.
int FeedsOf(const Problem& problem);
// How many times a piece of a family is bought where a design has one a feed: of its pumps.
int FeedsOf(const Problem& problem, Family family);

// Compressed air that so many ejectors for each feed take, m³ ANR/s; 0 of pumps with a motor. They
// are taken to blow all the while, at their supply pressure: what a valve in their air would save
// is left out.
inline double CompressedAir(const Problem& problem, const model::Compressor& pump, int pieces) {
  return pump.air_consumption_m3_per_s * pieces * FeedsOf(problem);
}
// Whether the wall gives it.
inline bool AirSuffices(const Problem& problem, const model::Compressor& pump, int pieces) {
  constexpr double kRounding = 1.0 + 1e-12;
  return CompressedAir(problem, pump, pieces) <=
         problem.compressed_air.flow_max_m3_per_s * kRounding;
}

// Most feeds that may run at the same time, by the windows of their strokes (gait.h).
int FeedsAtOnce(const Problem& problem);

// A squad as its feeds have it.
struct FedSquad {
  Squad squad;
  int feed = 0;   // the first of those that fill it; they are alike
  int feeds = 1;  // that fill it, each its part
  int count = 0;  // actuators on each
  // It must be full so long after its command, s: its window, or the next turn of its feed; 0 where
  // a feed would begin two squads at once.
  double turn_s = 0.0;
  double run_s = 0.0;  // in a period, that a feed runs for it if pumps hold on
  // That it runs for it if filling takes so long in a period.
  double Seconds(bool holds_on, double filling_s) const { return holds_on ? run_s : filling_s; }
};
std::vector<FedSquad> FedSquadsOf(const Problem& problem);

// How long the valves of a group stand open in a period while pumps fill and hold it, s, in the
// mean over its actuators: 0 where pumps do not hold on, and where they feed past the valves.
double HeldOpenSeconds(const Problem& problem, int group);

// Whether some feed would begin two squads at once, so that there are no designs.
bool FeedsMeet(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PUMP_FEED_H_
