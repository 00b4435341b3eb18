// Cases as a workshop records them, in place of a careful bench: a declared number that is wrong in
// one of four, few runs, in a third of the cases 8 to 30 readings each, noise that remembers,
// saturated sensors, coarse grids, commands that are off by up to a sample, zeros that drift from
// run to run, runs that stand twice in the record. Every case follows from its seed alone.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_REAL_CASE_H_
#define PLENUM_TESTS_SUPPORT_BENCH_REAL_CASE_H_

#include <cstdint>

#include "tests/support/bench/bench_case.h"

namespace plenum::test {

// A quarter has one wrong number (rest volume, expansion ratio, source pressure or conductance, 10
// to 35 % off), of these a fifth an effect beside it; of the others one in four has no effect, two
// have a listed one and the last one that is not listed. Numbers and effects alike are 4 to 16
// times the noise after the base model was re-fitted within its uncertainties.
BenchCase RealOfSeries(std::uint64_t series, int index);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_REAL_CASE_H_
