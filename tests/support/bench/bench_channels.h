// Sensors beside that of the chamber's pressure, for runs that a diagnosis asks for.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_CHANNELS_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_CHANNELS_H_

#include <string>
#include <vector>

#include "tests/support/bench/bench_case.h"

namespace plenum::test {

// What another sensor would show in a run, by the contract's name of its channel and in its units,
// with white noise of 1 % of its range there, a temperature's at least 0.5 K, a pressure's at least
// that of the chamber's sensor. The volume is without dead volume.
std::vector<double> ChannelReadings(const BenchCase& bench, const BenchRun& run, int number,
                                    const std::string& channel);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_CHANNELS_H_
