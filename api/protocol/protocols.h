// Which test of a part gives which of its numbers.
#ifndef PLENUM_API_PROTOCOL_PROTOCOLS_H_
#define PLENUM_API_PROTOCOL_PROTOCOLS_H_

#include <string_view>
#include <vector>

namespace plenum::api {

// What one test of a part gives.
struct Protocol {
  std::string_view name;  // "bottle_test", …
  std::string_view family;
  std::vector<std::string_view> numbers;  // fields of the catalogue, or "free_air", "current"
};
const std::vector<Protocol>& Protocols();

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_PROTOCOLS_H_
