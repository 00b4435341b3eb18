// What every rival reports of an instance.
#ifndef PLENUM_BENCH_SEARCH_RIVAL_H_
#define PLENUM_BENCH_SEARCH_RIVAL_H_

#include <sys/resource.h>

#include <chrono>
#include <functional>
#include <string>

#include "bench/search/base_instance.h"

namespace plenum::bench {

// Processor time of this process and of its children that have ended, so that other load on the
// machine does not count.
struct ProcessorClock {
  using duration = std::chrono::microseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<ProcessorClock>;
  static constexpr bool is_steady = true;
  static time_point now() {
    duration sum{0};
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
      rusage usage{};
      getrusage(who, &usage);
      for (const timeval& time : {usage.ru_utime, usage.ru_stime})
        sum += std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
    }
    return time_point(sum);
  }
};

struct Outcome {
  bool found = false;    // `best` holds a selection
  bool claimed = false;  // it is said to be optimal
  Selection best{};
  double find_s = 0.0;   // until `best` was known
  double total_s = 0.0;  // until the proof, or the end
  std::string note;
};

struct Rival {
  std::string name, formulation, options;
  std::function<Outcome(const BaseInstance&, std::uint64_t seed, double time_limit_s)> solve;
};

Rival Plenum();
Rival Cbc(bool lifted);
Rival Bonmin(const std::string& algorithm);
Rival GeneticAlgorithm();
Rival RandomSearch();

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SEARCH_RIVAL_H_
