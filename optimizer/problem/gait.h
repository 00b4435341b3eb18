// When strokes begin, and which of them may draw from the source at the same time.
//
// A squad is what fills at once of one group: all its actuators, or those with the same phase. A
// group without phases begins at 0 where all groups are simultaneous, else group g of G at g/(G·n)
// of the period, n its strokes in one.
#ifndef PLENUM_OPTIMIZER_PROBLEM_GAIT_H_
#define PLENUM_OPTIMIZER_PROBLEM_GAIT_H_

#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

struct Squad {
  int group = 0;
  int count = 0;       // actuators
  double phase = 0.0;  // of its first stroke, in [0, 1) of the period
};
// Of one group after another, by their phases.
std::vector<Squad> SquadsOf(const Problem& problem);

// When a stroke of a squad begins, as a share of the period in [0, 1).
struct Begin {
  double at = 0.0;
  int squad = 0;
};
// Of all strokes of a period, in the order of time.
std::vector<Begin> BeginsOf(const Problem& problem, const std::vector<Squad>& squads);

// Most actuators of the group that fill at once.
int FilledAtOnce(const Problem& problem, int group);

// Most actuators, of all groups, whose strokes begin at the same time.
int BegunAtOnce(const Problem& problem);

// Most time, s, that one inflation and one deflation of a group may take.
double InflateWindow(const Problem& problem, int group);
double DeflateWindow(const Problem& problem, int group);
// Most time, s, from the command until its rise target: within its own limit and the inflation's.
double RiseWindow(const Problem& problem, int group);

enum class Meeting {
  kAlone,     // one squad
  kTogether,  // several, all of whose strokes begin and end at the same times
  kApart,     // no two strokes of different squads begin at the same time
  kMixed      // some do and some do not
};
Meeting MeetingOf(const Problem& problem);

// Whether all that is drawn in a period is drawn by equal bursts, each of all actuators; so many in
// a period.
bool IsBurst(const Problem& problem);
int BurstsPerPeriod(const Problem& problem);  // 1 where it is no burst

// Whether two groups alternate by half periods: each ends its inflation when the other begins.
bool Alternates(const Problem& problem);

// Whether an inflation may go on while another squad's does.
bool WindowsOverlap(const Problem& problem);

// Whether strokes that last so long, per group, end before the next begins.
bool EndInTurn(const Problem& problem, const std::vector<double>& inflate_s);

// From the begin of each squad's strokes to the next begin of any, s, at least.
std::vector<double> TurnSeconds(const Problem& problem, const std::vector<Squad>& squads);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_GAIT_H_
