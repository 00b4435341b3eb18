// Guaranteed designs in corners of their parts' tolerances, by simulation.
#ifndef PLENUM_VERIFY_VERIFY_WORLDS_H_
#define PLENUM_VERIFY_VERIFY_WORLDS_H_

#include "verify/design/verify_values.h"
#include "verify/verify.h"

namespace plenum::verify {

// Each design at its own source pressure in `worlds` sets of part numbers, with the ids of the
// design: the parts must stand the pressure, fit together, and meet every requirement of `problem`
// within the tolerances of the simulator. A stock reservoir has the world's volume, a
// made-to-measure one its own. Which worlds is for the caller: a guarantee says that any will do,
// so that each is one more chance to find it wrong; none proves it right (that is for the record of
// the search, with the worst of each number).
Verification VerifyWorlds(const Problem& problem, const std::vector<Design>& designs, int worlds,
                          const DrawParts& parts_of_world, const Stop& stop = {});

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_VERIFY_WORLDS_H_
