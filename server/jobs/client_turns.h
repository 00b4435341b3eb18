// Whose job begins next.
#ifndef PLENUM_SERVER_JOBS_CLIENT_TURNS_H_
#define PLENUM_SERVER_JOBS_CLIENT_TURNS_H_

#include <map>
#include <string>
#include <tuple>

namespace plenum::server {

// Clients take turns: the next is the one with the fewest jobs at work and, of these, the one who
// has waited longest for a turn.
class ClientTurns {
 public:
  // Less is earlier. `at_work`: jobs of the client.
  std::tuple<int, long long> RankOf(const std::string& client, int at_work) const {
    const auto last = last_.find(client);
    return {at_work, last == last_.end() ? 0 : last->second};
  }
  // A job of the client begins.
  void Take(const std::string& client) { last_[client] = ++turn_; }
  // Who has no job begins anew.
  template <typename HasJob>
  void Forget(const HasJob& has_job) {
    std::erase_if(last_, [&](const auto& one) { return !has_job(one.first); });
  }

 private:
  std::map<std::string, long long> last_;
  long long turn_ = 0;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_CLIENT_TURNS_H_
