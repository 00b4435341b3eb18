// /v1/parts: the catalogue over HTTP. Requests and answers as in api/catalogue/part_document.h.
#ifndef PLENUM_SERVER_RESOURCES_PARTS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_PARTS_RESOURCE_H_

#include "server/call/reply.h"
#include "server/call/shared_catalog.h"

namespace plenum::server {

// One page: api/catalogue/part_query.h. With ETag; 304 when If-None-Match holds it.
Reply ListParts(SharedCatalog& catalog, const Call& call);
// With ETag; 304 when If-None-Match holds it. The header Catalogue-Revision has the number and the
// hash of the revision shown: the newest, or the one that the query's `revision` names.
Reply GetPart(SharedCatalog& catalog, const Call& call);
// How to measure the part; the query tells of the sensor: api/protocol/protocol_document.h.
Reply GetProtocol(SharedCatalog& catalog, const Call& call);
// With an Idempotency-Key the request acts once: a repetition gets the same answer, also after a
// restart (server/call/signature.h).
Reply AddPart(SharedCatalog& catalog, const Call& call);
// Only what If-Match names: 412 otherwise, also without If-Match.
Reply ReplacePart(SharedCatalog& catalog, const Call& call);
Reply RemovePart(SharedCatalog& catalog, const Call& call);

Reply ExportParts(SharedCatalog& catalog, const Call& call);
// The parts that the query's `ids` name, with commas between: api/catalogue/part_comparison.h.
Reply GetPartsComparison(SharedCatalog& catalog, const Call& call);
// Duplicates, odd numbers, what is missing or estimated: api/catalogue/catalog_check.h.
Reply GetPartsCheck(SharedCatalog& catalog, const Call& call);
// A table of any dialect; what it leaves open is refused with questions, which the query answers
// (encoding, delimiter, decimal, header_row, column=HEADING=COLUMN [UNIT], set=COLUMN=VALUE).
// All rows or none when a row is invalid. Rows whose id exists are replaced. `dry_run=true` answers
// what would be done. Takes an Idempotency-Key as AddPart does.
Reply ImportParts(SharedCatalog& catalog, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_PARTS_RESOURCE_H_
