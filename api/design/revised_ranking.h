// Ranking with a saved model revision, beside the ranking of the nominal model.
#ifndef PLENUM_API_DESIGN_REVISED_RANKING_H_
#define PLENUM_API_DESIGN_REVISED_RANKING_H_

#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// The list by one objective, with what else the request asks of it.
struct ListAnswer {
  optimizer::Answer answer;
  Json document;
};
ListAnswer AnswerList(const DesignRequest& request, const optimizer::SearchOptions& options,
                      const std::vector<catalog::Part>& parts);

// The list of the revised model, with
//   "model": { "name", "version", "at", "who", "hash", "effects": [ … ], "proved": bool }
//   "against_nominal": { "status", "designs": [ { "rank", "nominal_rank", "nominal": { "objective",
//     "source_pressure_kpa_gauge" } } ], "dropped": [ { "nominal_rank", "objective", "parts",
//     "why" } ] }
// `designs` has a row for each design of the list; `nominal_rank` is null for one that the nominal
// model does not list. `dropped` are designs that only the nominal model lists; `why` names the
// requirement that the revised model says they miss most at the nominal settings, null where they
// would meet all and are only no longer among the best. `proved`: the effects are of the kinds for
// which the list can be called optimal (optimizer/evaluate/relaxation.h).
Json AnswerRevised(const DesignRequest& request, const optimizer::SearchOptions& options,
                   const std::vector<catalog::Part>& parts);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_REVISED_RANKING_H_
