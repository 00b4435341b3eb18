// Work on several threads.
#ifndef PLENUM_CALIBRATION_PARALLEL_H_
#define PLENUM_CALIBRATION_PARALLEL_H_

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace plenum::calibration {

// Runs work(i) for all i below count, each once, in no fixed order.
template <class Work>
void ForAll(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> pool;
  for (int k = 1; k < threads && static_cast<std::size_t>(k) < count; ++k) pool.emplace_back(run);
  run();
  for (std::thread& thread : pool) thread.join();
}

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_PARALLEL_H_
