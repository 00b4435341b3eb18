// Results of jobs as the texts that are stored, read once for all who ask for them.
#ifndef PLENUM_SERVER_JOBS_STORED_RESULTS_H_
#define PLENUM_SERVER_JOBS_STORED_RESULTS_H_

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "server/call/coding/gzip.h"
#include "server/call/reply.h"
#include "server/call/service_limits.h"

namespace plenum::server {

class StoredResults {
 public:
  // The text of a job, from `load` where it is not in memory; empty where that gives no JSON.
  // Throws StoreError (kBusy) where the results that are being read leave no room.
  Bytes Get(const std::string& id, const std::function<std::string()>& load);
  // The text that was just stored.
  void Put(const std::string& id, std::string text);
  void Forget(const std::string& id);
  // The text, compressed once for all who read it. Nothing while another text is being compressed:
  // who asks waits for nobody and takes the text itself.
  std::shared_ptr<const Deflated> Compressed(const Bytes& text);

 private:
  struct CompressedText {
    std::weak_ptr<const std::string> of;
    std::shared_ptr<const Deflated> deflated;
  };

  void Keep(const std::string& id, const Bytes& bytes);
  std::shared_ptr<const Deflated> FindCompressed(const Bytes& text);

  std::mutex mutex_;
  ByteBudget budget_{kAnswerBytesMax};
  std::list<std::pair<std::string, Bytes>> newest_;  // first; of kKeptBytes together
  std::unordered_map<std::string, std::weak_ptr<const std::string>> known_;
  std::mutex compressing_;                // taken before mutex_
  std::list<CompressedText> compressed_;  // newest first
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_STORED_RESULTS_H_
