#include "server/call/entity_tag.h"

#include "api/catalogue/stores.h"

namespace plenum::server {

std::string ETag(const std::string& text) {
  return '"' + catalog::Sha256(text).substr(0, 32) + '"';
}

std::string OfGzip(const std::string& etag) { return etag.substr(0, etag.size() - 1) + "-gzip\""; }

bool Holds(const std::string& list, const std::string& etag, Compare compare) {
  bool quoted = false;  // a tag may hold commas
  std::string item;
  for (std::size_t i = 0; i <= list.size(); ++i) {
    if (i < list.size() && list[i] == '"') quoted = !quoted;
    if (i < list.size() && (quoted || list[i] != ',')) {
      if (quoted || (list[i] != ' ' && list[i] != '\t')) item += list[i];
      continue;
    }
    if (compare == Compare::kWeak && item.starts_with("W/")) item.erase(0, 2);
    if (item == etag) return true;
    if (item == "*" && list.find_first_not_of("* \t") == std::string::npos) return true;
    item.clear();
  }
  return false;
}

bool IsKnown(const Call& call, const std::string& etag) {
  const auto condition = call.header("If-None-Match");
  return condition && Holds(*condition, etag, Compare::kWeak);
}

}  // namespace plenum::server
