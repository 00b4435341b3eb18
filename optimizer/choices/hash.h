// One number of several, for tables: Fibonacci hashing, value by value.
#ifndef PLENUM_OPTIMIZER_CHOICES_HASH_H_
#define PLENUM_OPTIMIZER_CHOICES_HASH_H_

#include <bit>
#include <cstddef>

namespace plenum::optimizer {

class Hash {
 public:
  template <typename Value>
  void Add(Value value) {
    static_assert(sizeof(Value) <= sizeof(value_));
    if constexpr (sizeof(Value) == sizeof(value_))
      value_ = (value_ ^ std::bit_cast<std::size_t>(value)) * 0x9e3779b97f4a7c15u;
    else
      Add(static_cast<std::size_t>(value));
  }
  std::size_t value() const { return value_; }
  // With the high bits, which are mixed best, in the low ones too, by which tables choose a place.
  std::size_t place() const { return value_ ^ (value_ >> 32); }

 private:
  std::size_t value_ = 1;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_HASH_H_
