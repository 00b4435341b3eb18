// The web page at "/" and its files below "/assets/".
#ifndef PLENUM_SERVER_RESOURCES_PAGES_PAGE_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_PAGES_PAGE_RESOURCE_H_

#include "server/call/reply.h"

namespace plenum::server {

// The page is asked for anew each time (304 where If-None-Match holds its tag); its files carry a
// hash of their content in the name, so that a browser may keep them. The page may load from and
// talk to this service only (Content-Security-Policy).
Reply GetPage(const Call& call);
Reply GetAsset(const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_PAGES_PAGE_RESOURCE_H_
