#include "python/core/documents.h"

#include "api/json/problem_document.h"
#include "api/json/request_limits.h"

namespace plenum::python {

Refused::Refused(api::Errors errors)
    : std::runtime_error(api::Lines(errors)), errors_(std::move(errors)) {}

api::Json Parse(const std::string& text) {
  return ValueOrRefuse(api::ParseJson(text, api::kResultBytesMax));
}

std::string Dump(const api::Json& json) {
  return json.dump(-1, ' ', false, api::Json::error_handler_t::replace);
}

}  // namespace plenum::python
