// Designs and whole answers as JSON.
#ifndef PLENUM_API_DESIGN_DESIGNS_H_
#define PLENUM_API_DESIGN_DESIGNS_H_

#include <vector>

#include "api/design/read/requirements_reader.h"
#include "optimizer/problem/robust_answer.h"

namespace plenum::api {

// The answer as JSON. `parts` are the rows the problem was made of: makers, provenance.
Json RenderAnswer(const DesignRequest& request, const optimizer::Answer& answer,
                  const std::vector<catalog::Part>& parts);
// What a list that asks for a probability was chosen from: { count, status, lower_bound, gap,
// designs: [{ rank, listed } or a design that is not listed] }.
Json RenderSearched(const optimizer::Problem& problem, const optimizer::Searched& searched,
                    const std::vector<catalog::Part>& parts);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_DESIGNS_H_
