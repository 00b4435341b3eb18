// The Pareto front of an answer, as JSON.
#ifndef PLENUM_API_DESIGN_FRONT_H_
#define PLENUM_API_DESIGN_FRONT_H_

#include "api/json/json.h"
#include "optimizer/front/pareto.h"

namespace plenum::api {

// Adds to the answer `document` made of `front.answer`:
//   "front": [{ "objectives": { "mass_kg": … }, "rank": n }], by rank in `designs`;
//   "front_proof": { "complete", "resolution", "searches", "proved",
//                    "unexplored": [{ "limits": { "volume_l_max": … }, "mass_kg_min": … }] }.
void AddFront(const optimizer::Front& front, Json& document);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_FRONT_H_
