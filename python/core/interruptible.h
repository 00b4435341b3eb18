// Long work on a thread of its own, while the thread of Python hears signals and tells progress.
#ifndef PLENUM_PYTHON_CORE_INTERRUPTIBLE_H_
#define PLENUM_PYTHON_CORE_INTERRUPTIBLE_H_

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "api/json/worker_stack.h"

namespace plenum::python {

// Shared by the work and who waits for it.
class Watch {
 public:
  bool cancelled() const { return cancelled_; }
  void Cancel() { cancelled_ = true; }
  // The newest progress, a JSON document; older ones that nobody took are forgotten.
  void Tell(std::string progress) {
    const std::lock_guard lock(mutex_);
    news_ = std::move(progress);
  }
  std::optional<std::string> TakeNews() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, std::nullopt);
  }

 private:
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::optional<std::string> news_;
};

// Gives `to_python` of what `work(watch)` gives. `progress` is None or called with each news. An
// exception of Python (Ctrl-C; one that `progress` raises) cancels the work; once that has ended
// the exception goes on, with what the work gave in its attribute "answer".
template <typename Work, typename ToPython>
pybind11::object RunWatched(const pybind11::object& progress, const Work& work,
                            const ToPython& to_python) {
  constexpr std::chrono::milliseconds kStep{50};
  Watch watch;
  std::optional<pybind11::error_already_set> stopped;
  auto future = std::async(std::launch::async, [&] {
    const api::SignalStack stack;
    return work(watch);
  });
  const auto wait = [&] {
    const pybind11::gil_scoped_release released;
    return future.wait_for(kStep) == std::future_status::ready;
  };
  while (!wait()) {
    if (stopped) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (progress.is_none()) continue;
      if (const auto news = watch.TakeNews()) progress(*news);
    } catch (pybind11::error_already_set& error) {
      stopped.emplace(error);
      watch.Cancel();
    }
  }
  const pybind11::object answer = to_python(future.get());
  if (!stopped) return answer;
  stopped->value().attr("answer") = answer;
  throw pybind11::error_already_set(*stopped);
}

template <typename Work>
pybind11::object RunWatched(const pybind11::object& progress, const Work& work) {
  return RunWatched(progress, work, [](const auto& answer) { return pybind11::cast(answer); });
}

}  // namespace plenum::python

#endif  // PLENUM_PYTHON_CORE_INTERRUPTIBLE_H_
