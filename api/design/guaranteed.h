// The guaranteed list beside the list on paper.
#ifndef PLENUM_API_DESIGN_GUARANTEED_H_
#define PLENUM_API_DESIGN_GUARANTEED_H_

#include <vector>

#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// designs/1 whose "designs" meet every requirement with all numbers of their parts within their
// tolerances: "status", "designs", "proof" and all that belongs to a list are of the guaranteed
// one. Performance, duties, energy and margins of its designs are those of the worst case; mass,
// volume, cost and the objective are as printed, and
//   "guarantee": { "mass_kg_max", "volume_l_max" } of a design is what they may come to.
// Of the whole:
//   "guarantee": { "tolerance", "objective_on_paper", "objective_guaranteed", "costs",
//   "costs_share"
//     }, null where one of the two has no design;
//   "on_paper": { status, list, designs, by_configuration, proof, … } of the list on paper;
//   "measure_together", "measure_first" (savings/).
// Each list has 2/5 of the time limit at most; what is left goes to these two.
Json AnswerGuaranteed(const DesignRequest& request, const optimizer::SearchOptions& options,
                      const std::vector<catalog::Part>& rows);

// "guarantee" of a design of the guaranteed problem, and of the whole answer.
Json RenderMost(const optimizer::Design& design, const optimizer::Problem& guaranteed);
Json RenderGuarantee(const Tolerance& tolerance, const optimizer::Answer& guaranteed,
                     const optimizer::Answer& on_paper);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GUARANTEED_H_
