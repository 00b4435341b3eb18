// Which test of a part would make the best guaranteed design better, and by how much.
#ifndef PLENUM_API_DESIGN_SAVINGS_MEASURE_FIRST_H_
#define PLENUM_API_DESIGN_SAVINGS_MEASURE_FIRST_H_

#include <vector>

#include "api/design/read/requirements_reader.h"

namespace plenum::api {

// "measure_first": [{ "part", "protocol", "numbers", "saving", "saving_share",
//                     "saving_interval", "with" }]
// `saving` is the objective of the best guaranteed design less that of a proved search in which the
// numbers of the test are exact; null with a "saving_interval" where that search was not proved.
// Looked at are the parts of the best guaranteed design and of the designs on paper that beat it;
// the three that save most are told. "with" names a second test: of the same part, where both save
// at least kPairs times what one of them does (a pump delivers no more than its duty lets it), or,
// where nothing else saves, of another part. The least certain numbers come first, and
// "measure_first_complete" says whether `options` left time for all.
inline constexpr double kPairs = 1.1;
void AddMeasureFirst(const DesignRequest& request, const optimizer::Answer& guaranteed,
                     const optimizer::Answer& on_paper, const optimizer::SearchOptions& options,
                     const std::vector<catalog::Part>& rows, Json& document);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SAVINGS_MEASURE_FIRST_H_
