// Random problems of evacuated actuators, small enough to enumerate.
#ifndef PLENUM_TESTS_SUPPORT_PUMPS_VACUUM_PROBLEMS_H_
#define PLENUM_TESTS_SUPPORT_PUMPS_VACUUM_PROBLEMS_H_

#include "tests/support/small_catalogue.h"

namespace plenum::test {

// A draw of pressure with its actuators evacuated and its compressors turned into vacuum pumps; all
// parts stand vacuum.
optimizer::Problem EvacuatedProblem(const Draw& draw);
// The same with ejectors as well, of the pumps' curves, and compressed air that may have a limit.
optimizer::Problem EjectorProblem(const Draw& draw);

// A compressor's curve at the same shares of the way to its end, which lies below ambient.
model::Compressor AsVacuumPump(Random& random, model::Compressor pump);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PUMPS_VACUUM_PROBLEMS_H_
