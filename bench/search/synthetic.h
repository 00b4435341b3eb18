// Made-up catalogues of any size whose parts trade off as real ones do, and requirements that such
// parts mostly meet. The same seed gives the same numbers.
#ifndef PLENUM_BENCH_SEARCH_SYNTHETIC_H_
#define PLENUM_BENCH_SEARCH_SYNTHETIC_H_

#include <cstdint>

#include "optimizer/problem/problem.h"

namespace plenum::bench {

// `size` parts of each family of the cylinder and compressor configurations: tubes, fittings,
// valves, regulators, cylinders, compressors, batteries, reservoirs. More flow, pressure, gas or
// energy costs mass; every number scatters around its rule. Diameters, threads and voltages are
// those on the market, bores are in steps of 0.1 mm.
model::Parts SyntheticParts(std::uint64_t seed, int size);

// One group of actuators on a cylinder or a compressor, whichever is lighter; k = 10. Without
// parts.
optimizer::Problem SyntheticRequirements(std::uint64_t seed);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SEARCH_SYNTHETIC_H_
