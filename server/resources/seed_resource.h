// /v1/catalog/update: the catalogue follows the one that was installed with the program.
#ifndef PLENUM_SERVER_RESOURCES_SEED_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_SEED_RESOURCE_H_

#include <filesystem>

#include "server/call/reply.h"
#include "server/call/shared_catalog.h"

namespace plenum::server {

// Takes over what the catalogue `seed` has newer; rows that users added, changed or removed stay.
// With `dry_run=true` only says what that would do. Done twice it changes nothing more. 404 where
// no catalogue was installed, or where it is the service's own.
Reply UpdateCatalog(SharedCatalog& catalog, const std::filesystem::path& file,
                    const std::filesystem::path& seed, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SEED_RESOURCE_H_
