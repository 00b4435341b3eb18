// The page that shows the description of the service.
#ifndef PLENUM_SERVER_RESOURCES_PAGES_API_PAGE_H_
#define PLENUM_SERVER_RESOURCES_PAGES_API_PAGE_H_

#include "server/call/reply.h"

namespace plenum::server {

// It renders /openapi.json, without requests to anywhere else.
Reply GetApiPage(const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_PAGES_API_PAGE_H_
