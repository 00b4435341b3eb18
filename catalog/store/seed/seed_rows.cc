#include "catalog/store/seed/seed_rows.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "catalog/fields/fields.h"
#include "catalog/store/store_error.h"

namespace plenum::catalog {
namespace {

constexpr char kSeedOrigin[] = "seed";

bool InOrder(const Part& a, const Part& b) { return a.id < b.id; }

// Whether a part that is not there was removed by a user, not by another seed.
bool RemovedByUser(SqlDatabase& db, const std::string& id) {
  const std::vector<Change> last = ChangesOf(db, id, INT64_MAX, 1);
  return !last.empty() && last.front().revision.what != kSeedWrite;
}

}  // namespace

std::vector<Part> SeedRows(std::vector<Part> parts) {
  for (Part& part : parts) {
    part.origin = kSeedOrigin;
    if (const auto errors = Validate(part); !errors.empty())
      throw StoreError("seed part " + part.id + ": " + errors.front().detail + " (" +
                       errors.front().field + ")");
  }
  std::sort(parts.begin(), parts.end(), InOrder);
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (parts[i].id == parts[i - 1].id)
      throw StoreError("two seed parts have the id " + parts[i].id);
  return parts;
}

SeedPlan ReplaceSeedRows(SqlDatabase& db, const std::vector<Part>& seed, RevisionWriter& writer) {
  SeedPlan plan;
  for (const Part& part : ReadParts(db)) {
    if (part.origin != kSeedOrigin || std::binary_search(seed.begin(), seed.end(), part, InOrder))
      continue;
    writer.Change(part.id, part, std::nullopt);
    plan.removed.push_back(part.id);
  }
  for (const Part& part : seed) {
    const std::optional<Part> stored = writer.Get(part.id);
    if (stored == part) continue;
    const bool of_user = stored ? stored->origin != kSeedOrigin : RemovedByUser(db, part.id);
    if (!of_user) writer.Change(part.id, stored, part);
    (of_user ? plan.kept : stored ? plan.replaced : plan.added).push_back(part.id);
  }
  return plan;
}

SeedUpdate UpdateSeedRows(SqlDatabase& db, const std::vector<Part>& seed, const std::string& who,
                          bool dry_run) {
  SqlTransaction transaction(db, Purpose::kWrite);
  RevisionWriter writer(db);
  SeedUpdate update{ReplaceSeedRows(db, seed, writer), writer.head()};
  if (dry_run) return update;
  update.revision = writer.Record(who, std::string(kSeedWrite));
  transaction.Commit();
  return update;
}

}  // namespace plenum::catalog
