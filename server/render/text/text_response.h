// response/1, curves/1 and map answers for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_RESPONSE_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_RESPONSE_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

std::string ResponseText(const api::Json& response);
std::string CurvesText(const api::Json& answer);
std::string MapText(const api::Json& answer);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_RESPONSE_H_
