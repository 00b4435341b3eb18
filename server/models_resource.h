// /v1/models: saved model revisions, as rankings name them.
#ifndef PLENUM_SERVER_MODELS_RESOURCE_H_
#define PLENUM_SERVER_MODELS_RESOURCE_H_

#include "server/reply.h"
#include "server/shared_catalog.h"

namespace plenum::server {

// { "models": [{ name, version, at, who, hash, model }] }, the newest of each name, by name.
Reply ListModels(SharedCatalog& catalog, const Call& call);
// { "name", "versions": [{ name, version, at, who, hash, model }] }, newest first; 404 if no model
// was saved under the name.
Reply GetModel(SharedCatalog& catalog, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_MODELS_RESOURCE_H_
