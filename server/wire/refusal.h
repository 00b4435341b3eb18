// Why bytes are no request that is served.
#ifndef PLENUM_SERVER_WIRE_REFUSAL_H_
#define PLENUM_SERVER_WIRE_REFUSAL_H_

#include <string>

namespace plenum::server {

struct Refusal {
  int status = 0;
  std::string limit = {};  // that they exceed, if any
  std::string detail = {};
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_REFUSAL_H_
