// One request that has arrived, and where its answer goes.
#ifndef PLENUM_SERVER_WIRE_EXCHANGE_H_
#define PLENUM_SERVER_WIRE_EXCHANGE_H_

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "server/call/reply.h"
#include "server/wire/request_head.h"

namespace plenum::server {

// One whole request.
struct Incoming {
  RequestHead head;
  std::string body;
  std::string peer;      // the client's address
  bool is_last = false;  // the connection closes after it
};

// Takes an answer. Nothing blocks: it leaves as the client reads.
class Outgoing {
 public:
  virtual ~Outgoing() = default;
  virtual void Write(std::string bytes) = 0;
  virtual void Give(Bytes bytes) = 0;        // without a copy
  virtual void Follow(Produce produce) = 0;  // the rest, after all else
};

// What became of a request.
struct Handled {
  bool keeps = false;  // the connection goes on after the answer
  // Set where the request waits for something and is not answered: it holds no thread until it is
  // resumed, after `patience` or, with `on_change`, when Connections::Wake is called.
  std::function<Handled(Outgoing&)> resume = {};
  std::chrono::milliseconds patience{1000};
  bool on_change = false;
  std::size_t held_bytes = 0;  // what it holds meanwhile
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_EXCHANGE_H_
