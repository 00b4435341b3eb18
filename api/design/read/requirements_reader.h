// requirements/1 becomes a problem and what else the request asks for.
#ifndef PLENUM_API_DESIGN_READ_REQUIREMENTS_READER_H_
#define PLENUM_API_DESIGN_READ_REQUIREMENTS_READER_H_

#include <optional>
#include <string>
#include <vector>

#include "api/design/explanation.h"
#include "api/design/read/guarantee.h"
#include "api/design/robustness.h"
#include "api/json/json.h"
#include "api/json/remarks.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

struct DesignRequest {
  optimizer::Problem problem;
  double time_limit_s = 30.0;
  bool proof = false;  // the answer holds the record of the search
  std::string name;
  std::vector<optimizer::Amount> pareto;  // amounts of a front; empty: one objective
  std::optional<RobustRequest> robust;
  std::optional<GuaranteeRequest> guarantee;    // with one objective only
  std::optional<ExplainRequest> explain;        // with one objective only
  std::optional<catalog::ModelRevision> model;  // that ranks instead of the nominal one
  Json request;  // as it was given; the answer echoes it, so that a saved answer can be checked
  Remarks remarks;
};
// Parses and validates requirements against the catalogue: every error at once. `parts` have passed
// catalog::Validate; `models` are the newest of each name that "model" may ask for.
Parsed<DesignRequest> ParseRequirements(const Json& request,
                                        const std::vector<catalog::Part>& parts,
                                        const std::vector<catalog::ModelRevision>& models = {});

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_REQUIREMENTS_READER_H_
