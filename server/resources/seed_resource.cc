#include "server/resources/seed_resource.h"

#include <system_error>
#include <variant>
#include <vector>

#include "api/catalogue/seed/seed_document.h"
#include "api/catalogue/stores.h"
#include "server/call/signature.h"

namespace plenum::server {

Reply UpdateCatalog(SharedCatalog& catalog, const std::filesystem::path& file,
                    const std::filesystem::path& seed, const Call& call) {
  auto errors = CheckQuery(call, {"dry_run"});
  const bool dry_run = ReadFlag(call, "dry_run", errors);
  if (!errors.empty()) return ProblemReply(422, errors);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  std::error_code missing;
  if (seed.empty() || !std::filesystem::exists(seed, missing))
    return ProblemReply(404, "no catalogue was installed with this program");
  if (std::filesystem::equivalent(file, seed, missing))
    return ProblemReply(404, "the installed catalogue is the one that is served");
  const std::vector<catalog::Part> parts = catalog::Store(seed, catalog::Access::kRead).List();
  const std::string who = std::get<catalog::Signature>(signature).who;
  const auto update = catalog.WithLong(
      [&](catalog::Store& store) { return store.UpdateSeed(parts, who, dry_run); });
  return JsonReply(200, api::RenderSeedUpdate(update));
}

}  // namespace plenum::server
