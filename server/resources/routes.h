// What the service answers: one table of routes, from which requests are dispatched, 405 is decided
// and the table itself is served.
#ifndef PLENUM_SERVER_RESOURCES_ROUTES_H_
#define PLENUM_SERVER_RESOURCES_ROUTES_H_

#include <string>
#include <string_view>
#include <vector>

#include "server/resources/route.h"

namespace plenum::server {

std::vector<Route> Routes(const Services& services);  // which must outlive them

// Whether `path` has the form of `route.path`; the segments at {id} and {rank} go to `argument`.
bool Matches(const Route& route, std::string_view path, std::string& argument);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_ROUTES_H_
