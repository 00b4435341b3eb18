// A sweep answered here, one patch after the other.
#ifndef PLENUM_API_DESIGN_SWEEP_SWEEP_ANSWER_H_
#define PLENUM_API_DESIGN_SWEEP_SWEEP_ANSWER_H_

#include <functional>
#include <vector>

#include "api/design/sweep/sweep_request.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// What is told while the patch at `place` is at work, from 0; null where it begins.
using TellSweep = std::function<void(std::size_t place, const optimizer::Progress* progress)>;

// sweep_table/1. Cancelled: the patch at work ends with the best it has, and no other begins; these
// have the status cancelled.
Json AnswerSweep(const SweepRequest& sweep, const std::vector<catalog::Part>& parts,
                 const std::function<bool()>& cancelled, const TellSweep& tell);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SWEEP_SWEEP_ANSWER_H_
