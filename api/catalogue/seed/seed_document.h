// What a newer seed does to a catalogue, as JSON.
#ifndef PLENUM_API_CATALOGUE_SEED_SEED_DOCUMENT_H_
#define PLENUM_API_CATALOGUE_SEED_SEED_DOCUMENT_H_

#include "api/json/json.h"
#include "catalog/store/seed/seed_update.h"

namespace plenum::api {

// { "added", "replaced", "removed", "kept": ids, "revision": { "number", "hash" } }; the revision
// is the head where nothing was written.
Json RenderSeedUpdate(const catalog::SeedUpdate& update);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_SEED_SEED_DOCUMENT_H_
