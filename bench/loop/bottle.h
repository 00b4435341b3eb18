// The recording of a bottle test in a hidden world, by the simulator that shares no code with the
// model (tests/support/effects).
#ifndef PLENUM_BENCH_LOOP_BOTTLE_H_
#define PLENUM_BENCH_LOOP_BOTTLE_H_

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "tests/support/random.h"

namespace plenum::bench {

// What the engineer's bench is in truth, and nobody tells: each as far off what is declared as the
// docs of protocols say (docs/reference/protocols.md).
struct HiddenBench {
  double volume = 1.0;        // times the weighed one; σ 0.2 %
  double source = 1.0;        // times the gauge pressure that was read; σ 0.5 %
  double room_k = 293.15;     // where the rig says 20 °C; σ 2 K
  double wall_w_per_k = 0.0;  // heat from the bottle's wall
  double noise_pa = 200.0;
  double resolution_pa = 100.0;
};
HiddenBench DrawBench(double bottle_l, test::Random& random);

// `test` is one of a protocol/1's "tests" that has a "recording": its template with readings of
// the part `truth` in each run.
api::Json RecordBottleTest(const api::Json& test, const catalog::Part& truth, test::Random& random);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_LOOP_BOTTLE_H_
