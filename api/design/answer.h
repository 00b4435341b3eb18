// From a request for designs to its answer, designs/1.
#ifndef PLENUM_API_DESIGN_ANSWER_H_
#define PLENUM_API_DESIGN_ANSWER_H_

#include <vector>

#include "api/design/read/requirements_reader.h"

namespace plenum::api {

// Searches and renders what the request asks for; `options` say how to stop and to report progress,
// the time limit is the request's. `parts` are the rows the problem was made of.
Json AnswerRequest(const DesignRequest& request, optimizer::SearchOptions options,
                   const std::vector<catalog::Part>& parts);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_ANSWER_H_
