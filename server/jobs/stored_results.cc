#include "server/jobs/stored_results.h"

#include "api/catalogue/stores.h"
#include "api/json/json.h"

namespace plenum::server {
namespace {

constexpr std::size_t kKeptBytes = 16 << 20;
constexpr std::size_t kCompressedKeptBytes = 8 << 20;

}  // namespace

Bytes StoredResults::Get(const std::string& id, const std::function<std::string()>& load) {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(id);
  if (known != known_.end())
    if (Bytes bytes = known->second.lock()) return bytes;
  std::string text = load();
  if (text.empty() || !api::Json::accept(text)) return nullptr;
  Bytes bytes = budget_.Hold(std::move(text));
  if (!bytes && !newest_.empty()) {  // what nobody reads makes room
    newest_.clear();
    bytes = budget_.Hold(load());
  }
  if (!bytes)
    throw catalog::StoreError("too many results are being read", catalog::StoreFault::kBusy);
  Keep(id, bytes);
  return bytes;
}

void StoredResults::Put(const std::string& id, std::string text) {
  const std::lock_guard lock(mutex_);
  known_.erase(id);
  if (text.size() > kKeptBytes) return;
  if (const Bytes bytes = budget_.Hold(std::move(text))) Keep(id, bytes);
}

void StoredResults::Forget(const std::string& id) {
  const std::lock_guard lock(mutex_);
  known_.erase(id);
}

std::shared_ptr<const Deflated> StoredResults::FindCompressed(const Bytes& text) {
  const std::lock_guard lock(mutex_);
  std::erase_if(compressed_, [](const CompressedText& one) { return one.of.expired(); });
  for (const CompressedText& one : compressed_)
    if (one.of.lock() == text) return one.deflated;
  return nullptr;
}

std::shared_ptr<const Deflated> StoredResults::Compressed(const Bytes& text) {
  if (auto known = FindCompressed(text)) return known;
  const std::unique_lock turn(compressing_, std::try_to_lock);
  if (!turn) return nullptr;
  if (auto known = FindCompressed(text)) return known;  // another was faster
  auto deflated = std::make_shared<const Deflated>(Deflate(*text));
  const std::lock_guard lock(mutex_);
  compressed_.push_front({text, deflated});
  std::size_t kept = 0;
  std::erase_if(compressed_, [&](const CompressedText& one) {
    kept += one.deflated->blocks.size();
    return kept > kCompressedKeptBytes;
  });
  return deflated;
}

void StoredResults::Keep(const std::string& id, const Bytes& bytes) {
  newest_.emplace_front(id, bytes);
  std::size_t kept = 0;
  for (auto it = newest_.begin(); it != newest_.end();) {
    kept += it->second->size();
    it = kept > kKeptBytes ? newest_.erase(it) : std::next(it);
  }
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  known_[id] = bytes;
}

}  // namespace plenum::server
