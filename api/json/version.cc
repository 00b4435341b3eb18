#include "api/json/version.h"

namespace plenum::api {

std::string_view Version() { return PLENUM_VERSION; }

Json AnswerDocument(std::string_view schema) { return {{"schema", schema}, {"plenum", Version()}}; }

}  // namespace plenum::api
