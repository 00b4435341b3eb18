// What a request asks about part numbers that are not quite right, and what the answer says.
#ifndef PLENUM_API_DESIGN_ROBUSTNESS_H_
#define PLENUM_API_DESIGN_ROBUSTNESS_H_

#include <optional>

#include "api/design/read/tolerance.h"
#include "api/json/reader.h"

namespace plenum::api {

struct RobustRequest {
  optimizer::RobustOptions options;
  Tolerance tolerance;
  int seed = 1;
};

// Reads "robust"; none where the request has neither it nor a least probability.
std::optional<RobustRequest> ReadRobust(Reader& request, std::optional<double> probability_min);

// Adds "robustness" to each design and "robust" to the answer `document` made of `result.answer`.
void AddRobustness(const RobustRequest& request, const optimizer::RobustAnswer& result,
                   Json& document);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_ROBUSTNESS_H_
