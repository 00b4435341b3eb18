// What is guaranteed, and what to measure first, for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_GUARANTEE_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_GUARANTEE_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// The best guaranteed design beside the best on paper, what the certainty costs, and the tests that
// would save most; empty where the answer has no guarantee.
std::string GuaranteeText(const api::Json& answer);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_GUARANTEE_H_
