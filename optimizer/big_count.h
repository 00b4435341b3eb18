// Exact counts of combinations, past 2^64.
#ifndef PLENUM_OPTIMIZER_BIG_COUNT_H_
#define PLENUM_OPTIMIZER_BIG_COUNT_H_

#include <boost/multiprecision/cpp_int.hpp>

namespace plenum::optimizer {

using BigCount = boost::multiprecision::cpp_int;

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BIG_COUNT_H_
