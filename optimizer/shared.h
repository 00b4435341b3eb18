// A value that copies share until one of them changes it.
#ifndef PLENUM_OPTIMIZER_SHARED_H_
#define PLENUM_OPTIMIZER_SHARED_H_

#include <memory>
#include <utility>

namespace plenum::optimizer {

template <typename Value>
class Shared {
 public:
  Shared() : value_(std::make_shared<Value>()) {}
  const Value& operator*() const { return *value_; }
  const Value* operator->() const { return value_.get(); }
  // To change it: of this copy alone.
  Value& Own() {
    if (value_.use_count() > 1) value_ = std::make_shared<Value>(*value_);
    return *value_;
  }

 private:
  std::shared_ptr<Value> value_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SHARED_H_
