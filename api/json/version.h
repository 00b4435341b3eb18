// Which plenum gives an answer.
#ifndef PLENUM_API_JSON_VERSION_H_
#define PLENUM_API_JSON_VERSION_H_

#include <string_view>

#include "api/json/json.h"

namespace plenum::api {

// The version in CMakeLists.txt, "0.2.0"; `plenum --version` prints it.
std::string_view Version();

// The head of every answer: { "schema": `schema`, "plenum": Version() }.
Json AnswerDocument(std::string_view schema);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_VERSION_H_
