// What a command reads: files, standard input, the catalogue. All throw BadInput.
#ifndef PLENUM_SERVER_COMMANDS_FILES_INPUT_H_
#define PLENUM_SERVER_COMMANDS_FILES_INPUT_H_

#include <string>
#include <utility>
#include <variant>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"

namespace plenum::server {

std::string ReadText(const std::string& path);  // "-" is standard input
api::Json ReadJson(const std::string& path, std::size_t bytes_max = api::kJsonBytesMax);

// An existing catalogue, or the user's, which begins as a copy of the installed seed; that one is
// read where no copy can be made.
catalog::Store OpenCatalog(const std::string& path, catalog::Access access);

// The user who runs the command, by login name.
catalog::Signature CommandSignature();

[[noreturn]] void Refuse(const api::Errors& errors);

// The value, or BadInput with every error.
template <typename T>
T ValueOrRefuse(api::Parsed<T> parsed) {
  if (const auto* errors = std::get_if<api::Errors>(&parsed)) Refuse(*errors);
  return std::get<T>(std::move(parsed));
}

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_FILES_INPUT_H_
