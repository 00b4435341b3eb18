// What a job was ordered on: the parts and the saved model, pinned when it was posted and found
// again when it is done.
#ifndef PLENUM_SERVER_JOBS_JOB_INPUTS_H_
#define PLENUM_SERVER_JOBS_JOB_INPUTS_H_

#include <optional>
#include <string>
#include <vector>

#include "server/call/reply.h"
#include "server/call/shared_catalog.h"

namespace plenum::server {

// An order for the document in the call's body, signed like every write.
catalog::JobOrder OrderOf(const Call& call, const catalog::Signature& by, std::string name,
                          const catalog::Revision& revision,
                          const std::optional<catalog::ModelRevision>& model);

// The parts of the order's revision. An error where the catalogue holds them no longer, as after it
// was replaced by another.
api::Parsed<CatalogView> PartsOf(SharedCatalog& catalog, const catalog::JobOrder& order);

// The order's model alone, none for the nominal one. The same error.
api::Parsed<std::vector<catalog::ModelRevision>> ModelsOf(SharedCatalog& catalog,
                                                          const catalog::JobOrder& order);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_INPUTS_H_
