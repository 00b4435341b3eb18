// When the search of a front has to end, and its progress now and then. Internal to front_*.cc.
#ifndef PLENUM_OPTIMIZER_FRONT_FRONT_CLOCK_H_
#define PLENUM_OPTIMIZER_FRONT_FRONT_CLOCK_H_

#include <chrono>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

class FrontClock {
 public:
  explicit FrontClock(const SearchOptions& options) : options_(options) {}

  bool cancelled() const { return cancelled_; }

  // Cancelled, or out of time.
  bool Stopped() {
    cancelled_ = cancelled_ || (options_.cancelled && options_.cancelled());
    return cancelled_ || Seconds() > options_.time_limit_s;
  }

  // Fills in the seconds. Most calls do nothing.
  void Report(Progress progress) {
    constexpr double kIntervalS = 0.2;
    const double seconds = Seconds();
    if (!options_.progress || seconds - reported_s_ < kIntervalS) return;
    reported_s_ = progress.seconds = seconds;
    options_.progress(progress);
  }

 private:
  using Clock = std::chrono::steady_clock;

  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const SearchOptions& options_;
  const Clock::time_point start_ = Clock::now();
  double reported_s_ = 0.0;
  bool cancelled_ = false;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_FRONT_CLOCK_H_
