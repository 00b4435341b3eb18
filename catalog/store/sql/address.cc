#include "catalog/store/sql/address.h"

#include <libpq-fe.h>

#include <map>
#include <memory>

namespace plenum::catalog {
namespace {

// By name; empty where it is no address that libpq understands.
std::map<std::string, std::string> Parse(const std::string& address) {
  char* why = nullptr;  // repeats the address, so nobody sees it
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
      PQconninfoParse(address.c_str(), &why), PQconninfoFree);
  PQfreemem(why);
  std::map<std::string, std::string> values;
  for (const auto* option = options.get(); option && option->keyword; ++option)
    if (option->val) values[option->keyword] = option->val;
  return values;
}

}  // namespace

bool KnowsServers() { return true; }

bool IsUnderstood(const std::string& address) {
  const auto values = Parse(address);
  const auto port = values.find("port");
  return !values.empty() && (port == values.end() ||
                             port->second.find_first_not_of("0123456789,") == port->second.npos);
}

std::string Shown(const std::filesystem::path& place) {
  if (!IsServer(place)) return place.string();
  auto values = Parse(place.string());
  const std::string host = values["host"];
  const bool socket = host.starts_with("/");
  std::string shown = "postgresql://";
  if (!values["user"].empty()) shown += values["user"] + "@";
  if (!socket) shown += host;
  if (!values["port"].empty()) shown += ":" + values["port"];
  shown += "/" + values["dbname"];
  return socket ? shown + "?host=" + host : shown;
}

}  // namespace plenum::catalog
