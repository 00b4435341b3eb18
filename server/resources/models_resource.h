// /v1/models: saved model revisions, as rankings name them.
#ifndef PLENUM_SERVER_RESOURCES_MODELS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_MODELS_RESOURCE_H_

#include "server/call/reply.h"
#include "server/call/shared_catalog.h"

namespace plenum::server {

// { "models": [{ name, version, at, who, hash, model }] }, the newest of each name, by name.
Reply ListModels(SharedCatalog& catalog, const Call& call);
// { "name", "versions": [{ name, version, at, who, hash, model }] }, newest first; 404 if no model
// was saved under the name.
Reply GetModel(SharedCatalog& catalog, const Call& call);

// Saves { "name", "model": model/1 } as the next version of its name; 201 with the version, also
// where the newest one holds the same document already. 422 for a document that does not rank.
Reply SaveModel(SharedCatalog& catalog, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_MODELS_RESOURCE_H_
