// What httplib does for the service: it accepts connections and reads heads. Bodies and answers
// never reach it (connections.h, write_answer.h).
#ifndef PLENUM_SERVER_WIRE_PROTOCOL_H_
#define PLENUM_SERVER_WIRE_PROTOCOL_H_

#include <httplib.h>

#include <functional>
#include <variant>

#include "server/wire/exchange.h"

namespace plenum::server {

class Protocol : public httplib::Server {
 public:
  Protocol();

  // Is given each connection that is accepted.
  std::function<void(int socket)> admit;

  // The request as its head is read, with its body; or the status of the refusal where it cannot be
  // read. A target in absolute form gives the Host (RFC 9112, 3.2.2).
  std::variant<httplib::Request, int> Read(Incoming request);

  // Beyond httplib's five connections that may wait to be accepted.
  void WidenBacklog();

 private:
  bool process_and_close_socket(socket_t socket) override;
};

// Whether the connection ends after the answer (RFC 9112, 9.3).
bool ClosesAfter(const httplib::Request& request);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_PROTOCOL_H_
