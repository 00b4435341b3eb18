#include "python/core/documents.h"

#include <algorithm>
#include <limits>

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

namespace {

bool IsNumber(const api::Json& value) { return value.is_number() || value.is_null(); }

void TakeArrays(api::Json& value, std::vector<std::vector<double>>& arrays) {
  if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), IsNumber)) {
    if (value.is_structured())
      for (api::Json& member : value) TakeArrays(member, arrays);
    return;
  }
  std::vector<double>& numbers = arrays.emplace_back();
  numbers.reserve(value.size());
  for (const api::Json& number : value)
    numbers.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : number.get<double>());
  value = {{"$array", arrays.size() - 1}};
}

}  // namespace

Split SplitArrays(api::Json document) {
  Split split;
  TakeArrays(document, split.arrays);
  split.text = Dump(document);
  return split;
}

}  // namespace plenum::python
