// When a search has to stop: cancelled, at any time, or at its time limit; its dives before that.
// For how long after that the designs found before are still confirmed.
#ifndef PLENUM_OPTIMIZER_SEARCH_WATCH_H_
#define PLENUM_OPTIMIZER_SEARCH_WATCH_H_

#include <algorithm>
#include <chrono>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

class Watch {
 public:
  using Clock = std::chrono::steady_clock;

  Watch(const SearchOptions& options, Clock::time_point start) : options_(options), start_(start) {}

  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double looked_s() const { return looked_s_; }  // when the clock was looked at last
  bool cancelled() const { return cancelled_; }

  // Whether it has stopped, without a look at the clock and with one.
  bool stopped() const { return cancelled_ || late_; }
  bool Stopped() {
    if (cancelled_) return true;
    cancelled_ = options_.cancelled && options_.cancelled();
    if (late_ && !cancelled_) return true;
    looked_s_ = Seconds();
    late_ = late_ || looked_s_ > options_.time_limit_s;
    if (stopped()) stopped_s_ = looked_s_;
    return stopped();
  }

  // Whether the grace is over as well: the same short one after a cancel, whatever is listed, and
  // after the limit for designs behind a first. A list's first design, without which there would be
  // no answer, gets more.
  bool OutOfGrace(bool has_first) {
    constexpr double kGraceS = 0.1, kFirstGraceS = 1.0, kFirstGrace = 0.1;  // of the time limit
    if (!Stopped()) return false;
    const double grace_s = cancelled_ || has_first
                               ? kGraceS
                               : std::max(kFirstGraceS, kFirstGrace * options_.time_limit_s);
    return Seconds() > stopped_s_ + grace_s;
  }

  // Dives for a share of the time limit, as long as it asks DiveStopped().
  void DiveFor(double share, const auto& dive) {
    dive_until_s_ = Seconds() + share * options_.time_limit_s;
    dive();
    dive_until_s_ = kUnlimited;
  }
  bool DiveStopped() { return Stopped() || Seconds() > dive_until_s_; }

 private:
  const SearchOptions& options_;
  Clock::time_point start_;
  double looked_s_ = 0.0, stopped_s_ = 0.0, dive_until_s_ = kUnlimited;
  bool cancelled_ = false, late_ = false;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_WATCH_H_
