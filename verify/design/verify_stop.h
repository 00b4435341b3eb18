// Whether somebody wants a check to end before it has looked at all.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_STOP_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_STOP_H_

#include <functional>

namespace plenum::verify {

// May be empty; true from some time on. What is not looked at by then stays open.
using Stop = std::function<bool()>;
inline bool Stopped(const Stop& stop) { return stop && stop(); }

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_STOP_H_
