// /v1/parts/{id}/documents over HTTP: data sheets and recordings of a part, with their files.
// Answers as in api/catalogue/documents/part_files.h.
#ifndef PLENUM_SERVER_RESOURCES_DOCUMENTS_DOCUMENTS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_DOCUMENTS_DOCUMENTS_RESOURCE_H_

#include <vector>

#include "server/resources/route.h"

namespace plenum::server {

// The query's `revision` names an older revision, in which the part has its documents of then.
Reply ListDocuments(SharedCatalog& catalog, const Call& call);
// The body is the file; the query says `link` and, to have it checked, `sha256`. 201, or 200 where
// the part has it and it is kept already. application/octet-stream becomes what the link ends with.
// Takes an Idempotency-Key as AddPart does.
Reply AddDocument(SharedCatalog& catalog, const Call& call);
// The bytes, with the hash as ETag; always to be saved, never shown: whatever the file is, no
// browser runs it in the service's name. The argument is "ID/SHA256".
Reply GetDocument(SharedCatalog& catalog, const Call& call);
// Takes it off the part; the file stays for older revisions.
Reply RemoveDocument(SharedCatalog& catalog, const Call& call);

std::vector<Route> DocumentRoutes(SharedCatalog& catalog);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_DOCUMENTS_DOCUMENTS_RESOURCE_H_
