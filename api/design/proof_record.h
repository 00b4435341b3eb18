// The record of a search (optimizer/problem/proof.h) as compact JSON: arrays of numbers, parts by
// id.
#ifndef PLENUM_API_DESIGN_PROOF_RECORD_H_
#define PLENUM_API_DESIGN_PROOF_RECORD_H_

#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// { "count", "plans": [{ "configuration", "equal_flow", "tie", "slots", "boxes" }] }
//   slot: { "family", "group": index or null, "ids": [id or null],
//           "choices": [[id, quantity]], "dominated": [[id, quantity, [dominators]]] } with places
//           in `ids`, and dominators as places in `choices`; null stands for no fitting
//   box:  [0, slot, middle] split, [1, constraint] infeasible, [2, bound] bound, [3, bound] order,
//         [4, design] design, [5, bound] not listed, [6] refuted, [7, bound] undecided
Json RenderRecord(const optimizer::ProofRecord& record, const model::Parts& parts);

// Errors name the first thing that is not as above, or a part that the catalogue does not have.
optimizer::ProofRecord ReadRecord(Reader& record, const model::Parts& parts);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_PROOF_RECORD_H_
