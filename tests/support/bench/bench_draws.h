// What cases of all kinds draw alike: uncertainties, true numbers and effects of a size.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_DRAWS_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_DRAWS_H_

#include <string>
#include <vector>

#include "tests/support/bench/bench_case.h"

namespace plenum::test {

Numbers DrawUncertainty(const BenchRig& rig, Random& random);
Numbers DrawFactors(const Numbers& sd, Random& random);

// Gives the case these effects, each as visible as its kind asks for; false where one cannot be.
bool DrawEffects(BenchCase& bench, const std::vector<std::string>& ids, Random& random);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_DRAWS_H_
