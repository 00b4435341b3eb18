#include "server/call/coding/accepted.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include "server/call/lower_case.h"

namespace plenum::server {
namespace {

std::string WithoutBlanks(std::string_view text) {
  std::string bare(text);
  std::erase_if(bare, [](char c) { return c == ' ' || c == '\t'; });
  return LowerCase(std::move(bare));
}

}  // namespace

double Wanted(std::string_view list, const std::vector<std::string_view>& names) {
  std::map<std::string, double, std::less<>> given;
  while (!list.empty()) {
    const std::string entry = WithoutBlanks(list.substr(0, list.find(',')));
    list.remove_prefix(std::min(list.find(','), list.size() - 1) + 1);
    const auto weight = entry.find(";q=");
    given[entry.substr(0, entry.find(';'))] =
        weight == entry.npos ? 1.0 : std::atof(entry.substr(weight + 3, 5).c_str());
  }
  for (const std::string_view name : names)
    if (const auto found = given.find(name); found != given.end()) return found->second;
  return 0.0;
}

bool WantsGzip(const Call& call) {
  const auto list = call.header("Accept-Encoding");
  if (!list) return false;
  const double gzip = Wanted(*list, {"gzip", "x-gzip", "*"});
  return gzip > 0.0 && gzip >= Wanted(*list, {"identity"});
}

}  // namespace plenum::server
