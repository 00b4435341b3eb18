// What the service does with one request: finds its route and who asks, gives it its turn, has it
// answered, says so in the log. A request that waits, for its job, its turn or the catalogue, holds
// no thread: it is resumed (server/wire/exchange.h).
#ifndef PLENUM_SERVER_REQUEST_HANDLER_H_
#define PLENUM_SERVER_REQUEST_HANDLER_H_

#include <memory>
#include <string>
#include <vector>

#include "server/call/metrics.h"
#include "server/call/service_limits.h"
#include "server/call/tokens.h"
#include "server/resources/route.h"
#include "server/wire/exchange.h"
#include "server/wire/refusal.h"
#include "server/wire/request_head.h"

namespace plenum::server {

struct HandlerOptions {
  std::vector<std::string> allow_hosts;
  bool needs_token = false;
  bool log = true;
  api::Json limits;  // by name, for refusals
};

class RequestHandler {
 public:
  // `wake` is called when a request that waits for its turn may have it.
  RequestHandler(HandlerOptions options, const std::vector<Route>& routes, TokenKeeper& tokens,
                 Metrics& metrics, std::function<void()> wake);

  Handled Take(Incoming request, Outgoing& out);
  // The refusal of a request whose body is still to come, if its head is enough for one.
  std::string RefusalOf(const RequestHead& head, const std::string& peer);
  // A whole answer to what never became a request.
  std::string RefusalText(const Refusal& refusal, const std::string& peer);
  // Of large answers on their way.
  std::size_t answer_bytes() const { return answers_.held(); }

 private:
  struct Exchange;
  using ExchangePtr = std::shared_ptr<Exchange>;

  static ExchangePtr Open(Incoming request);
  std::optional<Reply> Refuse(Exchange& exchange);
  std::optional<Reply> FindRoute(Exchange& exchange);
  Handled Proceed(const ExchangePtr& exchange, Outgoing& out);
  std::optional<Reply> Try(Exchange& exchange);
  std::optional<Reply> Run(Exchange& exchange);
  static void LogFault(const Exchange& exchange, const std::string& what);
  static Reply UncertainReply(const Exchange& exchange, const std::string& what);
  Reply FaultReply(const Exchange& exchange, const std::string& what, catalog::StoreFault fault);
  Reply WithinBudget(Reply reply);
  Produce WhileAuthorized(Produce produce, const Exchange& exchange);
  void Finish(Exchange& exchange, Reply reply, Outgoing& out);
  void Record(const Exchange& exchange, const Reply& reply);

  const HandlerOptions options_;
  const std::vector<Route>& routes_;
  TokenKeeper& tokens_;
  Metrics& metrics_;
  Gate large_;
  ByteBudget answers_{kAnswerBytesMax};
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_REQUEST_HANDLER_H_
