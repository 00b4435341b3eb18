// /v1/revisions and /v1/parts/{id}/history: what was changed, by whom, and taking it back.
#ifndef PLENUM_SERVER_RESOURCES_HISTORY_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_HISTORY_RESOURCE_H_

#include "server/call/reply.h"
#include "server/call/shared_catalog.h"

namespace plenum::server {

// { "id", "history": [{ "revision": { number, hash, at, who, what }, "before", "after" }],
// "next_cursor", "catalogue_revision" }, newest first. Query: limit, cursor. Also of a part that
// was removed; 404 if no part ever had the id. A part without changes since history began has none.
Reply PartHistory(SharedCatalog& catalog, const Call& call);

// { "revisions": [{ number, hash, at, who, what }], "next_cursor" }, newest first.
Reply ListRevisions(SharedCatalog& catalog, const Call& call);
// { number, hash, at, who, what, "changes": [{ id, before, after }] }.
Reply GetRevision(SharedCatalog& catalog, const Call& call);
// Takes the changes of a revision back, as a revision of its own: 200 with that one; 409 if one of
// its parts was changed again since.
Reply UndoRevision(SharedCatalog& catalog, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_HISTORY_RESOURCE_H_
