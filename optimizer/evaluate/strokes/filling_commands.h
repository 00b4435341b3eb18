// The commands of squads that share a source, and what comes of them.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_FILLING_COMMANDS_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_FILLING_COMMANDS_H_

#include <cstddef>
#include <tuple>
#include <vector>

#include "optimizer/problem/gait.h"

namespace plenum::optimizer {

inline constexpr int kPeriodsMax = 50;

struct Command {
  double time_s;
  bool opens;
  std::size_t group;
  int period;
  bool operator<(const Command& other) const {
    return std::tie(time_s, opens, group) < std::tie(other.time_s, other.opens, other.group);
  }
};

// In the order of time, of kPeriodsMax periods; of bursts, which leave nothing to each other, of
// the first burst alone.
std::vector<Command> CommandsOf(const Problem& problem, const std::vector<Squad>& squads);

// One stroke when its window is over; `of`: the problem's group.
struct Filled {
  int of;
  double rise_s, inflate_s, filled_pa;
};

// Whether two periods are the same, to 1e-8 of their times.
bool SameTimes(const std::vector<Filled>& a, const std::vector<Filled>& b);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_FILLING_COMMANDS_H_
