// /v1/parts: the catalogue over HTTP. Requests and answers as in api/services.h.
#ifndef PLENUM_SERVER_PARTS_RESOURCE_H_
#define PLENUM_SERVER_PARTS_RESOURCE_H_

#include "server/reply.h"
#include "server/shared_catalog.h"

namespace plenum::server {

// { "parts": […], "next_cursor": id or null }, in order of id. Query: family, limit (1…1000, 100 if
// not given), cursor (the last id seen).
Reply ListParts(SharedCatalog& catalog, const Call& call);
// With ETag; 304 when If-None-Match holds it.
Reply GetPart(SharedCatalog& catalog, const Call& call);
Reply AddPart(SharedCatalog& catalog, const Call& call);
// Only over the row that If-Match names: 412 otherwise, also without If-Match.
Reply ReplacePart(SharedCatalog& catalog, const Call& call);
// If-Match is honoured when given.
Reply RemovePart(SharedCatalog& catalog, const Call& call);

Reply ExportParts(SharedCatalog& catalog, const Call& call);
// All rows or none when a row is invalid. Rows whose id exists are replaced.
Reply ImportParts(SharedCatalog& catalog, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_PARTS_RESOURCE_H_
