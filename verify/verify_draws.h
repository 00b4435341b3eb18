// A list's stand against part numbers that are not quite right, checked anew: shares nothing with
// robust.cc but the draws themselves, which the request defines.
#ifndef PLENUM_VERIFY_VERIFY_DRAWS_H_
#define PLENUM_VERIFY_VERIFY_DRAWS_H_

#include "verify/design/verify_values.h"
#include "verify/verify.h"

namespace plenum::verify {

// Sizes every listed design again in each of RobustAnswer::draws draws. `met` and `first` must lie
// between what holds with 1e-6 to spare and what holds if 1e-6 may be missed, relative.
//
// With probability_min the list is checked against RobustAnswer::searched, which must be there:
// each of its designs is listed if it reaches the probability and the list is not full, and the
// list's bound and status follow from those of the search. Whether that search holds is for Verify,
// with Searched::count designs wanted. Stopped before all draws are made, their counts stay open.
Verification VerifyDraws(const Problem& problem, const RobustAnswer& answer,
                         const RobustOptions& options, const DrawParts& draw_parts,
                         const Stop& stop = {});

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_VERIFY_DRAWS_H_
