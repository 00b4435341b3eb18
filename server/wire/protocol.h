// What httplib does for the service: it reads heads and writes answers. Connections and bodies
// never reach it (connections.h).
#ifndef PLENUM_SERVER_WIRE_PROTOCOL_H_
#define PLENUM_SERVER_WIRE_PROTOCOL_H_

#include <httplib.h>

#include <functional>

#include "server/wire/connections.h"

namespace plenum::server {

class Protocol : public httplib::Server {
 public:
  Protocol();

  // Is given each connection that is accepted.
  std::function<void(int socket)> admit;

  // Answers one request; false when its connection is to be closed.
  bool Answer(Incoming request, Outgoing& out);

  // Beyond httplib's five connections that may wait to be accepted.
  void WidenBacklog();

 private:
  bool process_and_close_socket(socket_t socket) override;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_PROTOCOL_H_
