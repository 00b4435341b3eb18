#include "server/call/reply_cache.h"

namespace plenum::server {
namespace {

constexpr std::size_t kBytesMax = 8 << 20;
constexpr std::size_t kOverheadBytes = 512;  // of one answer: headers, nodes

// After a restore the same number may stand for other parts, and the same parts for another number.
std::string NameOf(const catalog::Revision& revision) {
  return std::to_string(revision.number) + " " + revision.hash;
}

}  // namespace

std::shared_ptr<const Reply> ReplyCache::Find(const catalog::Revision& revision,
                                              const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (revision_ != NameOf(revision)) return nullptr;
  const auto found = replies_.find(key);
  return found == replies_.end() ? nullptr : found->second;
}

void ReplyCache::Keep(const catalog::Revision& revision, const std::string& key,
                      const Reply& reply) {
  const std::string name = NameOf(revision);
  const std::size_t bytes = reply.body.size() + key.size() + kOverheadBytes;
  const std::lock_guard lock(mutex_);
  if (revision_ != name || bytes_ + bytes > kBytesMax) {
    replies_.clear();
    bytes_ = 0;
    revision_ = name;
  }
  if (replies_.emplace(key, std::make_shared<const Reply>(reply)).second) bytes_ += bytes;
}

}  // namespace plenum::server
