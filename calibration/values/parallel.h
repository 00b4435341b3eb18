// Work on several threads.
#ifndef PLENUM_CALIBRATION_VALUES_PARALLEL_H_
#define PLENUM_CALIBRATION_VALUES_PARALLEL_H_

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "model/simulate/signal_stack.h"

namespace plenum::calibration {

// Cores that this process may run on, which may be fewer than the machine has (taskset,
// containers).
inline int UsableCores() {
  cpu_set_t usable;
  if (sched_getaffinity(0, sizeof usable, &usable) == 0) return CPU_COUNT(&usable);
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Runs work(i) for all i below count, each once, in no fixed order. The threads have the name and
// the niceness of the one that calls, by which the service knows what they work for.
template <class Work>
void ForAll(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> pool;
  for (int k = 1; k < threads && static_cast<std::size_t>(k) < count; ++k)
    pool.emplace_back([&run] {
      const model::SignalStack stack;
      run();
    });
  run();
  for (std::thread& thread : pool) thread.join();
}

// How many threads item i of those may use within itself: the last ones leave no others to begin.
inline int ThreadsWithin(std::size_t i, std::size_t count, int threads) {
  return i + 2 * static_cast<std::size_t>(threads) >= count ? threads : 1;
}

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_PARALLEL_H_
