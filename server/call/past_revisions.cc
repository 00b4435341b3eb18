#include "server/call/past_revisions.h"

#include <algorithm>

namespace plenum::server {
namespace {

constexpr std::size_t kViewsMax = 2;
constexpr std::size_t kPartsMax = 200'000;  // of all that are kept

}  // namespace

CatalogView::CatalogView(catalog::Revision of, std::vector<catalog::Part> all)
    : revision(std::move(of)),
      parts(std::make_shared<const std::vector<catalog::Part>>(std::move(all))),
      table(std::make_shared<const api::PartTable>(*parts)) {}

PastRevisions::PastRevisions(const std::filesystem::path& path, std::chrono::milliseconds patience)
    : patience_(patience), store_(path, catalog::Access::kRead) {
  store_.WaitForLocks(patience);
}

std::optional<CatalogView> PastRevisions::ViewAt(std::int64_t revision) {
  return With([&](const catalog::Store& store) -> std::optional<CatalogView> {
    const auto found = store.FindRevision(revision);
    if (!found) return std::nullopt;
    // The whole revision counts: after a restore the same number may stand for other parts.
    for (const CatalogView& known : views_)
      if (known.revision == *found) return known;
    if (views_.size() == kViewsMax) views_.pop_back();
    CatalogView view{*found, store.ListAt(revision)};
    views_.push_front(view);
    std::size_t parts = 0;
    std::erase_if(views_, [&](const CatalogView& one) {
      parts += one.parts->size();
      return parts > kPartsMax;
    });
    return view;
  });
}

}  // namespace plenum::server
