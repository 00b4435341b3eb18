// Gaits for drawn problems.
#ifndef PLENUM_TESTS_SUPPORT_DRAWN_GAIT_H_
#define PLENUM_TESTS_SUPPORT_DRAWN_GAIT_H_

#include "optimizer/problem/gait.h"
#include "tests/support/random_parts.h"

namespace plenum::test {

// Phases for all, for each actuator or none, windows from a quarter to three quarters, one to three
// strokes in a period, which is the slower for it.
inline void DrawGaits(Random& random, optimizer::Problem& problem) {
  int strokes = 1;
  for (optimizer::ActuatorGroup& group : problem.groups) {
    optimizer::Gait& gait = group.gait;
    if (Chance(random, 0.5)) gait.inflate_fraction = Uniform(random, 0.25, 0.75);
    if (Chance(random, 0.4)) gait.strokes_per_period = Pick(random, 1, 3);
    strokes = std::max(strokes, gait.strokes_per_period);
    if (Chance(random, 0.2)) continue;
    const int phases = Chance(random, 0.5) ? 1 : group.count;
    for (int i = 0; i < phases; ++i) gait.phases.push_back(Pick(random, 0, 7) / 8.0);
  }
  problem.frequency_hz /= strokes;
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_DRAWN_GAIT_H_
