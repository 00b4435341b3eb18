// The catalogue as it was: a connection of its own, so that who reads history holds up nobody, and
// the last revisions that were asked for.
#ifndef PLENUM_SERVER_CALL_PAST_REVISIONS_H_
#define PLENUM_SERVER_CALL_PAST_REVISIONS_H_

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "api/catalogue/part_table.h"
#include "api/catalogue/stores.h"

namespace plenum::server {

using Parts = api::PartVector;

// All parts of one revision.
struct CatalogView {
  CatalogView() = default;
  CatalogView(catalog::Revision of, std::vector<catalog::Part> all);
  // Those of `before` with `changes`.
  CatalogView(catalog::Revision of, const CatalogView& before, catalog::PartChanges changes);

  const api::PartRows& rows() const { return table->rows(); }
  // In one vector, made when it is first asked for: for who works on all of them.
  Parts parts() const { return rows().All(); }

  catalog::Revision revision;
  std::shared_ptr<const api::PartTable> table;
};

// A view follows changes of at most so many parts, and of so many since all parts were read or of
// a tenth of them; others are read anew.
inline constexpr int kChangesMax = 1000;
bool MayFollow(const CatalogView& view);

class PastRevisions {
 public:
  // `patience`: for the locks of other connections and for the turn; then StoreError (kBusy).
  PastRevisions(const std::filesystem::path& path, std::chrono::milliseconds patience);

  // Runs `f(store)` while no other thread does.
  template <typename F>
  auto With(F&& f) {
    const std::unique_lock lock(mutex_, patience_);
    if (!lock)
      throw catalog::StoreError("another request reads history for long",
                                catalog::StoreFault::kBusy);
    return f(std::as_const(store_));
  }
  // None if there is no such revision. What it has in common with `newest` is shared.
  std::optional<CatalogView> ViewAt(std::int64_t revision, const CatalogView& newest);

 private:
  static CatalogView ReadAt(const catalog::Store& store, const catalog::Revision& revision,
                            const CatalogView& newest);

  const std::chrono::milliseconds patience_;
  std::timed_mutex mutex_;
  catalog::Store store_;
  std::deque<CatalogView> views_;  // the newest first
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_PAST_REVISIONS_H_
