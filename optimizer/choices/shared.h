// A value that copies share until one of them changes it.
#ifndef PLENUM_OPTIMIZER_CHOICES_SHARED_H_
#define PLENUM_OPTIMIZER_CHOICES_SHARED_H_

#include <memory>
#include <utility>

namespace plenum::optimizer {

template <typename Value>
class Shared {
 public:
  const Value& operator*() const { return value_ ? *value_ : kFirst; }
  const Value* operator->() const { return &**this; }
  // To change it: of this copy alone.
  Value& Own() {
    if (value_.use_count() != 1) value_ = std::make_shared<Value>(**this);
    return *value_;
  }

 private:
  inline static const Value kFirst{};
  std::shared_ptr<Value> value_;  // none: kFirst
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_SHARED_H_
