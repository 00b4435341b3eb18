// Room for signal handlers on a thread whose own stack overflowed.
#ifndef PLENUM_MODEL_SIMULATE_SIGNAL_STACK_H_
#define PLENUM_MODEL_SIMULATE_SIGNAL_STACK_H_

#include <signal.h>

#include <cstddef>
#include <vector>

namespace plenum::model {

// While it lives, signal handlers with SA_ONSTACK run on it in the thread that made it. A thread
// that has such a stack already keeps that one.
class SignalStack {
 public:
  SignalStack() {
    stack_t present{};
    if (sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
    bytes_.resize(kBytes);
    stack_t stack{};
    stack.ss_sp = bytes_.data();
    stack.ss_size = bytes_.size();
    sigaltstack(&stack, nullptr);
  }
  ~SignalStack() {
    if (bytes_.empty()) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  // A handler's frame holds the registers, about 11 kB with the widest of them.
  static constexpr std::size_t kBytes = 64 << 10;
  std::vector<char> bytes_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIGNAL_STACK_H_
