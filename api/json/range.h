// The range that a number of a request must lie in.
#ifndef PLENUM_API_JSON_RANGE_H_
#define PLENUM_API_JSON_RANGE_H_

#include <string>

namespace plenum::api {

// Allowed range of a number; bounds are inclusive unless open.
struct Range {
  double low = 0.0, high = 0.0;
  bool low_open = false, high_open = false;

  bool Contains(double value) const;
  std::string Text() const;  // "> 0 and ≤ 1e6"
};
inline Range Above(double low, double high) { return {low, high, true, false}; }
inline Range Below(double low, double high) { return {low, high, false, true}; }

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_RANGE_H_
