// Rise time to 30 digits by quadrature, for the errors of all methods; shares nothing with model/.
#ifndef PLENUM_BENCH_REFERENCE_H_
#define PLENUM_BENCH_REFERENCE_H_

#include "bench/rigs.h"

namespace plenum::bench {

// t = ∫ W(p) dp / (P0·C·p_s·Ψ(p/p_s)) from ambient to the rig's target, in 50-digit arithmetic,
// split where the flow stops being choked; with p = p_s·(1 − u²) the subsonic integrand is analytic
// up to p_s and beyond. Throws std::runtime_error where Gauss–Kronrod does not confirm 30 digits.
double ReferenceRiseTime(const RiseRig& rig);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_REFERENCE_H_
