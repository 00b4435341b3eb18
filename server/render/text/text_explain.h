// What an answer says beyond the list, for a person: front, robustness, prices and flips.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_EXPLAIN_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_EXPLAIN_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// Each empty where the answer has no such part; else it ends with an empty line.
std::string FrontText(const api::Json& answer);
std::string RobustText(const api::Json& answer);
std::string PricesText(const api::Json& answer);
std::string FlipsText(const api::Json& answer);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_EXPLAIN_H_
