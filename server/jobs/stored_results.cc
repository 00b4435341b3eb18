#include "server/jobs/stored_results.h"

#include "api/catalogue/stores.h"
#include "api/json/json.h"

namespace plenum::server {
namespace {

constexpr std::size_t kKeptBytes = 16 << 20;

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
