#include "server/call/past_revisions.h"

#include <algorithm>

namespace plenum::server {
namespace {

constexpr std::size_t kViewsMax = 2;
constexpr std::size_t kPartsMax = 200'000;  // of all that are kept
constexpr std::size_t kFollowedMin = 2000;

}  // namespace

CatalogView::CatalogView(catalog::Revision of, std::vector<catalog::Part> all)
    : revision(std::move(of)),
      table(std::make_shared<const api::PartTable>(
          std::make_shared<const std::vector<catalog::Part>>(std::move(all)))) {}

CatalogView::CatalogView(catalog::Revision of, const CatalogView& before,
                         catalog::PartChanges changes)
    : revision(std::move(of)),
      table(std::make_shared<const api::PartTable>(*before.table, std::move(changes))) {}

bool MayFollow(const CatalogView& view) {
  return view.table && view.rows().changes() < std::max(kFollowedMin, view.rows().size() / 10);
}

PastRevisions::PastRevisions(const std::filesystem::path& path, std::chrono::milliseconds patience)
    : patience_(patience), store_(path, catalog::Access::kRead) {
  store_.WaitForLocks(patience);
}

std::optional<CatalogView> PastRevisions::ViewAt(std::int64_t revision, const CatalogView& newest) {
  return With([&](const catalog::Store& store) -> std::optional<CatalogView> {
    const auto found = store.FindRevision(revision);
    if (!found) return std::nullopt;
    // The whole revision counts: after a restore the same number may stand for other parts.
    for (const CatalogView& known : views_)
      if (known.revision == *found) return known;
    if (views_.size() == kViewsMax) views_.pop_back();
    CatalogView view = ReadAt(store, *found, newest);
    views_.push_front(view);
    std::size_t parts = 0;
    std::erase_if(views_, [&](const CatalogView& one) {
      parts += one.rows().size();
      return parts > kPartsMax;
    });
    return view;
  });
}

CatalogView PastRevisions::ReadAt(const catalog::Store& store, const catalog::Revision& revision,
                                  const CatalogView& newest) {
  auto changed = MayFollow(newest) ? store.ChangesTo(revision.number, newest.revision, kChangesMax)
                                   : std::nullopt;
  return changed ? CatalogView(revision, newest, std::move(changed->second))
                 : CatalogView(revision, store.ListAt(revision.number));
}

}  // namespace plenum::server
