#include "server/call/shared_catalog.h"

#include <sys/stat.h>

#include <ctime>
#include <utility>

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLookEvery = std::chrono::milliseconds(2);
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

SharedCatalog::Turn SharedCatalog::AwaitTurn(std::chrono::seconds patience) {
  Turn turn{waiting_.Enter(), std::unique_lock(mutex_, std::defer_lock)};
  if (!turn.place || !turn.lock.try_lock_for(patience))
    throw catalog::StoreError("another request writes for long", catalog::StoreFault::kBusy);
  return turn;
}

std::shared_ptr<const SharedCatalog::Published> SharedCatalog::WhatIsPublished() const {
  const std::lock_guard lock(published_mutex_);
  return published_;
}

std::optional<CatalogView> SharedCatalog::ViewBeforeWrite() const {
  const auto published = WhatIsPublished();
  return published ? std::optional(published->view) : std::nullopt;
}

SharedCatalog::Publication::Publication(SharedCatalog& catalog) : catalog_(catalog) {
  auto published = std::make_shared<const Published>(
      Published{catalog_.RefreshView(), catalog_.store_.Models()});
  const std::lock_guard lock(catalog_.published_mutex_);
  catalog_.published_ = std::move(published);
}

SharedCatalog::Publication::~Publication() {
  const std::lock_guard lock(catalog_.published_mutex_);
  catalog_.published_ = nullptr;
}

// `ask` with the store when its turn comes, or `look` at what a long write has published.
template <typename Ask, typename Look>
auto SharedCatalog::AskOrLook(Ask ask, Look look) {
  std::unique_lock lock(mutex_, std::defer_lock);
  const auto until = Clock::now() + std::chrono::seconds(kCatalogueWaitSeconds);
  while (!lock.try_lock_for(kLookEvery)) {
    if (const auto published = WhatIsPublished()) return look(*published);
    if (Clock::now() > until)
      throw catalog::StoreError("another request writes for long", catalog::StoreFault::kBusy);
  }
  return ask();
}

const catalog::Revision& SharedCatalog::RefreshHead() {
  const FileState state = StateOfFile();
  const bool settled = NowNs() - state.written_ns > kTickNs;
  if (!head_ || !settled || state != head_state_) {
    head_ = store_.Head();
    // What was read while the file may still have been changing is read again.
    head_state_ = settled ? state : FileState();
  }
  return *head_;
}

const CatalogView& SharedCatalog::RefreshView() {
  // The whole revision counts: after a restore the same number may stand for other parts.
  if (!view_.parts || view_.revision != RefreshHead()) {
    view_ = {};  // before the next takes as much memory
    auto [revision, parts] = store_.ListWithHead();
    view_ = {std::move(revision), std::move(parts)};
  }
  return view_;
}

catalog::Revision SharedCatalog::Head() {
  return AskOrLook([this] { return catalog::Revision(RefreshHead()); },
                   [](const Published& published) { return published.view.revision; });
}

CatalogView SharedCatalog::View() {
  return AskOrLook([this] { return CatalogView(RefreshView()); },
                   [](const Published& published) { return published.view; });
}

std::vector<catalog::ModelRevision> SharedCatalog::Models() {
  return AskOrLook([this] { return store_.Models(); },
                   [](const Published& published) { return published.models; });
}

std::optional<CatalogView> SharedCatalog::ViewAt(std::int64_t revision) {
  if (auto view = View(); view.revision.number == revision) return view;
  return With([&](const catalog::Store& store) -> std::optional<CatalogView> {
    const auto found = store.FindRevision(revision);
    if (!found) return std::nullopt;
    return CatalogView{*found, store.ListAt(revision)};
  });
}

}  // namespace plenum::server
