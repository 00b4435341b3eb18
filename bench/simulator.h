// The only place of bench/ that speaks to the simulator (besides Simulator() of method.h).
#ifndef PLENUM_BENCH_SIMULATOR_H_
#define PLENUM_BENCH_SIMULATOR_H_

#include <string>
#include <vector>

namespace plenum::bench {

// What the simulator is asked to do in the growth table: one row of columns per variant.
struct CycleVariant {
  std::string name;
  // Wall time of one simulation of so many groups and cycles, s. Throws std::runtime_error where
  // the simulation does not end well.
  double (*seconds)(int groups, int cycles);
};

// Constant source pressure, and reservoir with compressor; an effect would be one more.
std::vector<CycleVariant> CycleVariants();

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SIMULATOR_H_
