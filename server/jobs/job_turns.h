// Which jobs may run at the same time, over all kinds of jobs of a service.
#ifndef PLENUM_SERVER_JOBS_JOB_TURNS_H_
#define PLENUM_SERVER_JOBS_JOB_TURNS_H_

#include <mutex>

namespace plenum::server {

// Jobs that must run alone go before all others, one at a time.
class JobTurns {
 public:
  // A job that must run alone waits from now on, until it leaves or is withdrawn.
  void Announce() {
    const std::lock_guard lock(mutex_);
    ++announced_;
  }
  void Withdraw() {
    const std::lock_guard lock(mutex_);
    --announced_;
  }
  // Whether a job may begin now. If so, it leaves when it has ended.
  bool Enter(bool alone) {
    const std::lock_guard lock(mutex_);
    const bool free = alone ? running_ == 0 : announced_ == 0;
    running_ += free;
    return free;
  }
  void Leave(bool alone) {
    const std::lock_guard lock(mutex_);
    --running_;
    announced_ -= alone;
  }

 private:
  std::mutex mutex_;
  int announced_ = 0;  // that wait or run
  int running_ = 0;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_TURNS_H_
