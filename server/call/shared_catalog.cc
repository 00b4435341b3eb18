#include "server/call/shared_catalog.h"

#include <sys/stat.h>

#include <ctime>
#include <ratio>
#include <utility>

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kTryEvery = std::chrono::milliseconds(2);
constexpr std::chrono::milliseconds kLockPatience{100};  // for other processes
constexpr std::chrono::milliseconds kLeaveAlone{500};    // a file that they keep
// Whether they write; those of other services at a server, one soon after the other.
constexpr std::chrono::milliseconds kGlance{4}, kGlanceAtServer{50};
// Two writes within one tick of the file system's clock leave the same time.
constexpr std::int64_t kTickNs = 50'000'000;

std::int64_t NowNs() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * std::nano::den + now.tv_nsec;
}

}  // namespace

SharedCatalog::SharedCatalog(const std::filesystem::path& path)
    : store_(path, catalog::Access::kWrite),
      path_(path),
      on_server_(catalog::IsServer(path)),
      opened_(StateOfFile()),
      past_(path, kLockPatience) {
  store_.WaitForLocks(kLockPatience);
}

void SharedCatalog::ThrowBusy() {
  throw catalog::StoreError("another request writes for long", catalog::StoreFault::kBusy);
}

SharedCatalog::FileState SharedCatalog::StateOfFile() const {
  struct stat file {};
  if (stat(path_.c_str(), &file) != 0) return {};
  return {file.st_ino, file.st_dev, file.st_size,
          file.st_mtim.tv_sec * std::nano::den + file.st_mtim.tv_nsec};
}

std::shared_ptr<void> SharedCatalog::TakePlace() {
  auto place = waiting_.Enter();
  if (!place) ThrowBusy();
  return place;
}

std::unique_lock<std::timed_mutex> SharedCatalog::AwaitTurn() {
  std::unique_lock lock(turns_.store, kTurnPatience);
  if (!lock) ThrowBusy();
  return lock;
}

std::unique_lock<std::timed_mutex> SharedCatalog::AwaitWriters() {
  std::unique_lock lock(turns_.writers, kTurnPatience);
  if (!lock) ThrowBusy();
  return lock;
}

void SharedCatalog::GlanceAtLock() {
  struct Glance {
    Glance(catalog::Store& of, std::chrono::milliseconds patience) : store(of) {
      store.WaitForLocks(patience);
    }
    ~Glance() { store.WaitForLocks(kLockPatience); }
    catalog::Store& store;
  } const glance(store_, on_server_ ? kGlanceAtServer : kGlance);
  try {
    store_.TryToWrite(catalog::Store::Try::kLock);
  } catch (const catalog::StoreError& error) {  // readers need not find out anew
    if (error.fault() == catalog::StoreFault::kBusy) ask_again_at_ = Clock::now() + kLeaveAlone;
    throw;
  }
}

std::shared_ptr<const SharedCatalog::Published> SharedCatalog::WhatIsPublished() const {
  const std::lock_guard lock(published_mutex_);
  return published_;
}

std::optional<CatalogView> SharedCatalog::ViewMeanwhile() {
  if (const auto published = WhatIsPublished()) return published->view;
  const std::unique_lock lock(turns_.store, kTurnPatience);
  const bool kept = lock && view_.table && !has_written_ && Clock::now() < ask_again_at_;
  return kept ? std::optional(view_) : std::nullopt;
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

SharedCatalog::Writing::Writing(SharedCatalog& catalog, std::chrono::milliseconds patience)
    : catalog_(catalog) {
  catalog_.has_written_ = true;
  catalog_.store_.WaitForLocks(patience);
}

SharedCatalog::Writing::~Writing() { catalog_.store_.WaitForLocks(kLockPatience); }

// `ask` with the store when its turn comes, or `look` at what a long write has published.
template <typename Ask, typename Look>
auto SharedCatalog::AskOrLook(Ask ask, Look look) {
  std::unique_lock lock(turns_.store, std::defer_lock);
  const auto until = Clock::now() + kTurnPatience;
  while (!lock.try_lock_for(kTryEvery)) {
    if (const auto published = WhatIsPublished()) return look(*published);
    if (Clock::now() > until) ThrowBusy();
  }
  return ask();
}

const catalog::Revision& SharedCatalog::RefreshHead() {
  const FileState state = StateOfFile();
  // Of a server no file tells whether it was written.
  const bool settled = !on_server_ && NowNs() - state.written_ns > kTickNs;
  if (head_ && settled && state == head_state_) return *head_;
  const bool old_will_do = view_.table && !has_written_;
  if (old_will_do && Clock::now() < ask_again_at_) return view_.revision;
  try {
    head_ = store_.Head();
  } catch (const catalog::StoreError& error) {
    if (error.fault() != catalog::StoreFault::kBusy || !old_will_do) throw;
    ask_again_at_ = Clock::now() + kLeaveAlone;
    return view_.revision;
  }
  has_written_ = false;
  // What was read while the file may still have been changing is read again.
  head_state_ = settled ? state : FileState();
  return *head_;
}

const CatalogView& SharedCatalog::RefreshView() {
  // The whole revision counts: after a restore the same number may stand for other parts.
  if (!view_.table || view_.revision != RefreshHead()) {
    auto changed = MayFollow(view_) ? store_.ChangesTo(std::nullopt, view_.revision, kChangesMax)
                                    : std::nullopt;
    if (changed) {
      view_ = {std::move(changed->first), view_, std::move(changed->second)};
      return view_;
    }
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

std::optional<CatalogView> SharedCatalog::ViewAt(std::int64_t revision,
                                                 std::chrono::milliseconds patience) {
  return Patiently(patience, [&]() -> std::optional<CatalogView> {
    auto view = View();
    return view.revision.number == revision ? std::optional(std::move(view))
                                            : past_.ViewAt(revision, view);
  });
}

FileCheck SharedCatalog::Check() {
  const FileState now = StateOfFile();
  if (now.inode != opened_.inode || now.device != opened_.device) return FileCheck::kReplaced;
  try {
    const auto turn = AwaitTurn();
    store_.TryToWrite();
    return FileCheck::kSound;
  } catch (const catalog::StoreError& error) {
    return error.fault() == catalog::StoreFault::kBusy ? FileCheck::kBusy : FileCheck::kFailed;
  }
}

}  // namespace plenum::server
