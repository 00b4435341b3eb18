// Tests after which a design on paper is a guaranteed one.
#ifndef PLENUM_API_DESIGN_SAVINGS_MEASURE_TOGETHER_H_
#define PLENUM_API_DESIGN_SAVINGS_MEASURE_TOGETHER_H_

#include <vector>

#include "api/design/read/requirements_reader.h"

namespace plenum::api {

// "measure_together": [{ "rank", "tests": [{ "part", "family", "protocol", "numbers" }],
//                        "objective", "saving", "saving_share" }]
// What one test cannot save several may: the design of that rank on paper meets every requirement
// within the tolerances once the numbers of these tests are exact, and would not if one of them
// were left out. `objective` is what it then comes to, `saving` the objective of the best
// guaranteed design less that: what a search finds with the same tests is no less. Looked at are
// all designs on paper that beat the guaranteed one; of two with as many tests the better is told,
// and none that asks for more tests and saves less. The most saving comes first. Sizing parts that
// are given takes milliseconds, so that this is no search and comes before measure_first.
void AddMeasureTogether(const DesignRequest& request, const optimizer::Answer& guaranteed,
                        const optimizer::Answer& on_paper, const optimizer::SearchOptions& options,
                        const std::vector<catalog::Part>& rows, Json& document);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SAVINGS_MEASURE_TOGETHER_H_
