#include "api/catalogue/seed/seed_document.h"

namespace plenum::api {

Json RenderSeedUpdate(const catalog::SeedUpdate& update) {
  return {{"added", update.plan.added},
          {"replaced", update.plan.replaced},
          {"removed", update.plan.removed},
          {"kept", update.plan.kept},
          {"revision", {{"number", update.revision.number}, {"hash", update.revision.hash}}}};
}

}  // namespace plenum::api
