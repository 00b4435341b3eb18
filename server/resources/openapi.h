// The description of the service (OpenAPI 3.1) and a page that shows it. Requests are described by
// what validates them (api/describe/descriptions.h), paths and summaries by the table of routes.
//
// docs_page.cc: the page.
#ifndef PLENUM_SERVER_RESOURCES_OPENAPI_H_
#define PLENUM_SERVER_RESOURCES_OPENAPI_H_

#include <vector>

#include "server/call/reply.h"
#include "server/resources/route.h"

namespace plenum::server {

// Every route, with each status that it may answer with.
api::Json OpenApi(const std::vector<Route>& routes);

// A page that renders /openapi.json, without requests to anywhere else.
Reply GetDocs(const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_OPENAPI_H_
