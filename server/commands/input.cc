#include "server/commands/input.h"

#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "api/json/problem_document.h"
#include "server/commands/exit_status.h"

namespace plenum::server {

std::string ReadText(const std::string& path) {
  using Iterator = std::istreambuf_iterator<char>;
  if (path == "-") return {Iterator(std::cin), Iterator()};
  if (std::filesystem::is_directory(path)) throw BadInput(path + ": is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw BadInput(path + ": cannot be read");
  return {Iterator(file), Iterator()};
}

api::Json ReadJson(const std::string& path, std::size_t bytes_max) {
  return ValueOrRefuse(api::ParseJson(ReadText(path), bytes_max));
}

catalog::Store OpenCatalog(const std::string& path, catalog::Access access) {
  try {
    const auto place = catalog::BeginCatalog(path);
    if (catalog::IsServer(place)) return {place, access};
    if (!std::filesystem::exists(place))
      throw BadInput(path + ": no such catalogue; name one with --catalog or PLENUM_CATALOG");
    if (place != path && access == catalog::Access::kWrite)
      throw BadInput(path + ": cannot be made; name a catalogue with --catalog or PLENUM_CATALOG");
    return {place, access};
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

catalog::Signature CommandSignature() {
  const passwd* user = getpwuid(geteuid());
  return {user != nullptr ? user->pw_name : "uid " + std::to_string(geteuid()), {}, {}};
}

void Refuse(const api::Errors& errors) {
  std::string lines = api::Lines(errors);
  while (!lines.empty() && lines.back() == '\n') lines.pop_back();
  throw BadInput(lines);
}

}  // namespace plenum::server
