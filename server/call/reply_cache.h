// Answers that stay the same while the catalogue does.
#ifndef PLENUM_SERVER_CALL_REPLY_CACHE_H_
#define PLENUM_SERVER_CALL_REPLY_CACHE_H_

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "api/catalogue/stores.h"
#include "server/call/reply.h"

namespace plenum::server {

class ReplyCache {
 public:
  // The answer kept under `key` for this revision; none if there is none.
  std::shared_ptr<const Reply> Find(const catalog::Revision& revision, const std::string& key);
  // Forgets those of other revisions, and all where they take too much.
  void Keep(const catalog::Revision& revision, const std::string& key, const Reply& reply);

 private:
  std::mutex mutex_;
  std::string revision_;  // number and hash
  std::unordered_map<std::string, std::shared_ptr<const Reply>> replies_;
  std::size_t bytes_ = 0;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_REPLY_CACHE_H_
