// The description of the service (OpenAPI 3.1). Requests are described by what validates them
// (api/describe/descriptions.h), paths and summaries by the table of routes.
#ifndef PLENUM_SERVER_RESOURCES_OPENAPI_H_
#define PLENUM_SERVER_RESOURCES_OPENAPI_H_

#include <vector>

#include "server/call/reply.h"
#include "server/resources/route.h"

namespace plenum::server {

// Every route, with each status that it may answer with.
api::Json OpenApi(const std::vector<Route>& routes);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_OPENAPI_H_
