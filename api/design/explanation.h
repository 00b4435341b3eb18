// What a request asks to have explained, and what the answer says.
#ifndef PLENUM_API_DESIGN_EXPLANATION_H_
#define PLENUM_API_DESIGN_EXPLANATION_H_

#include <optional>
#include <vector>

#include "api/json/reader.h"
#include "optimizer/explain/prices.h"

namespace plenum::api {

struct ExplainRequest {
  bool prices = false;
  int ranks = 0;  // explain what would make each design down to this rank the first
  double time_limit_s = 20.0;
};

// Reads "explain"; none where the request has none.
std::optional<ExplainRequest> ReadExplain(Reader& request);

// Adds "prices" to the answer `document` made of `answer`, and "to_be_first" to its designs, by
// searches within the request's time limit, which prices and ranks share.
void AddExplanation(const ExplainRequest& request, const optimizer::Problem& problem,
                    const optimizer::Answer& answer, optimizer::SearchOptions options,
                    Json& document);

Json RenderPrice(const optimizer::Price& price, double objective);
Json RenderFlip(const optimizer::Flip& flip);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_EXPLANATION_H_
