#include "server/shared_catalog.h"

#include <sys/stat.h>

#include <ctime>
#include <utility>

namespace plenum::server {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
// Two writes within one tick of the file system's clock leave the same time.
constexpr std::int64_t kTickNs = 50'000'000;

std::int64_t NowNs() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

}  // namespace

CatalogView::CatalogView(catalog::Revision of, std::vector<catalog::Part> all)
    : revision(std::move(of)),
      parts(std::make_shared<const std::vector<catalog::Part>>(std::move(all))),
      table(std::make_shared<const api::PartTable>(*parts)) {}

SharedCatalog::SharedCatalog(const std::filesystem::path& path)
    : store_(path, catalog::Access::kWrite), path_(path) {}

SharedCatalog::FileState SharedCatalog::StateOfFile() const {
  struct stat file {};
  if (stat(path_.c_str(), &file) != 0) return {};
  return {file.st_ino, file.st_size, file.st_mtim.tv_sec * kNsPerS + file.st_mtim.tv_nsec};
}

const catalog::Revision& SharedCatalog::HeadLocked() {
  const FileState state = StateOfFile();
  const bool settled = NowNs() - state.written_ns > kTickNs;
  if (!head_ || !settled || state != head_state_) {
    head_ = store_.Head();
    // What was read while the file may still have been changing is read again.
    head_state_ = settled ? state : FileState();
  }
  return *head_;
}

catalog::Revision SharedCatalog::Head() {
  const std::lock_guard lock(mutex_);
  return HeadLocked();
}

CatalogView SharedCatalog::View() {
  const std::lock_guard lock(mutex_);
  // The whole revision counts: after a restore the same number may stand for other parts.
  if (!view_.parts || view_.revision != HeadLocked()) {
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
