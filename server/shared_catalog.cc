#include "server/shared_catalog.h"

#include <utility>

namespace plenum::server {

CatalogView::CatalogView(catalog::Revision of, std::vector<catalog::Part> all)
    : revision(std::move(of)),
      parts(std::make_shared<const std::vector<catalog::Part>>(std::move(all))),
      table(std::make_shared<const api::PartTable>(*parts)) {}

SharedCatalog::SharedCatalog(const std::filesystem::path& path)
    : store_(path, catalog::Access::kWrite) {}

CatalogView SharedCatalog::View() {
  const std::lock_guard lock(mutex_);
  // The whole revision counts: after a restore the same number may stand for other parts.
  if (!view_.parts || view_.revision != store_.Head()) {
    auto [revision, parts] = store_.ListWithHead();
    view_ = {std::move(revision), std::move(parts)};
  }
  return view_;
}

std::optional<CatalogView> SharedCatalog::ViewAt(std::int64_t revision) {
  if (auto view = View(); view.revision.number == revision) return view;
  const std::lock_guard lock(mutex_);
  const auto found = store_.FindRevision(revision);
  if (!found) return std::nullopt;
  return CatalogView{*found, store_.ListAt(revision)};
}

}  // namespace plenum::server
