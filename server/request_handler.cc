#include "server/request_handler.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "api/json/problem_document.h"
#include "server/call/protection.h"
#include "server/call/request_log.h"
#include "server/jobs/job_memory.h"
#include "server/resources/routes.h"
#include "server/wire/write_answer.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

// Between two tries at a catalogue that another process writes.
constexpr milliseconds kTryAgainFirst{50}, kTryAgainMost{2000};

// Whether the answer takes much memory to build.
bool IsLarge(const Call& call) {
  if (call.body.size() > kLargeBodyBytes) return true;
  api::Errors ignored;
  const bool facets = ReadFlag(call, "facets", ignored);
  const std::string limit = QueryValue(call, "limit").value_or("");
  return facets || limit.size() > 3 || std::atoi(limit.c_str()) > kLargePageParts;
}

bool HasBody(const RequestHead& head) {
  return head.Field("Transfer-Encoding") ||
         head.Field("Content-Length").value_or("").find_first_not_of('0') != std::string::npos;
}

// What a resource that takes `methods` answers to OPTIONS, and says with 405 (RFC 9110, 10.2.1).
std::string WithImplied(std::string methods) {
  if (methods.find("GET") != std::string::npos) methods += ", HEAD";
  return methods + ", OPTIONS";
}

Reply OptionsReply(const std::string& methods) {
  Reply reply{204, "", "", {{"Allow", methods}}, {}};
  return reply;
}

}  // namespace

struct RequestHandler::Exchange {
  Header header() const {
    return [this](const char* name) { return request.head.Field(name); };
  }

  Incoming request;
  AnswerForm form;
  Clock::time_point start = Clock::now();
  std::size_t bytes_in = 0;
  std::string pattern = "none";  // of the route
  const Route* route = nullptr;
  std::string argument, user, client;

  // While it waits: what gives its answer, or its place among large requests, or that another
  // process writes.
  std::function<std::optional<Reply>()> later;
  Gate::Ticket ticket;
  bool busy = false;
  milliseconds pause = kTryAgainFirst;
};

RequestHandler::RequestHandler(HandlerOptions options, const std::vector<Route>& routes,
                               TokenKeeper& tokens, Metrics& metrics, std::function<void()> wake)
    : options_(std::move(options)),
      routes_(routes),
      tokens_(tokens),
      metrics_(metrics),
      large_(kLargeMax, kLargeWaitingMax, std::move(wake)) {}

Handled RequestHandler::Take(Incoming request, Outgoing& out) {
  return Proceed(Open(std::move(request)), out);
}

std::string RequestHandler::RefusalOf(const RequestHead& head, const std::string& peer) {
  const auto exchange = Open({head, "", peer, true});
  std::optional<Reply> refused;
  try {
    refused = Refuse(*exchange);
  } catch (const std::exception&) {  // which the whole request will be told
  }
  if (!refused) return "";
  Record(*exchange, *refused);
  return AnswerText(*refused);
}

RequestHandler::ExchangePtr RequestHandler::Open(Incoming request) {
  auto exchange = std::make_shared<Exchange>();
  exchange->request = std::move(request);
  const RequestHead& head = exchange->request.head;
  exchange->client = exchange->request.peer;
  exchange->bytes_in = exchange->request.body.size();
  exchange->form = {head.method == "HEAD", head.minor_version > 0,
                    exchange->request.is_last || ClosesAfter(head)};
  return exchange;
}

// Why what a head asks for gets no answer. Sets the route and who asks.
std::optional<Reply> RequestHandler::Refuse(Exchange& exchange) {
  const RequestHead& head = exchange.request.head;
  const Header header = exchange.header();
  if (auto refused = RefuseForeign(header, options_.allow_hosts)) {
    exchange.form.closes = true;
    return refused;
  }
  if (head.path.size() > kPathBytesMax)
    return LimitReply(414, "path_bytes_max", kPathBytesMax, "the path is too long");
  if (head.Field("Content-Encoding") ||
      head.Field("Content-Type").value_or("").starts_with("multipart/form-data"))
    return ProblemReply(415, "send the body itself: no Content-Encoding, no form");
  if (auto refused = FindRoute(exchange)) return refused;
  const Access access = exchange.route->access;
  if (options_.needs_token && access != Access::kOpen) {
    auto token = Authorize(header, access, tokens_);
    if (auto* refused = std::get_if<Reply>(&token)) return std::move(*refused);
    exchange.user = std::get<Token>(token).name;
    exchange.client = std::get<Token>(token).id;
  }
  const bool takes_body = head.method == "POST" || head.method == "PUT";
  if (takes_body && HasBody(head)) return RefuseContentType(header, exchange.route->types);
  return std::nullopt;
}

std::optional<Reply> RequestHandler::FindRoute(Exchange& exchange) {
  const RequestHead& head = exchange.request.head;
  if (head.path == "*") return OptionsReply("GET, HEAD, POST, PUT, DELETE, OPTIONS");
  const std::string method = head.method == "HEAD" ? "GET" : head.method;
  std::string allowed;
  for (const Route& candidate : routes_) {
    std::string argument;
    if (!Matches(candidate, head.path, argument)) continue;
    exchange.pattern = candidate.path;
    if (candidate.method == method) {
      exchange.route = &candidate;
      exchange.argument = std::move(argument);
      return std::nullopt;
    }
    allowed += (allowed.empty() ? "" : ", ") + candidate.method;
  }
  if (allowed.empty()) return ProblemReply(404, "there is no " + head.path);
  allowed = WithImplied(std::move(allowed));
  if (head.method == "OPTIONS") return OptionsReply(allowed);
  auto reply = ProblemReply(405, head.path + " takes " + allowed);
  reply.headers.emplace_back("Allow", allowed);
  return reply;
}

// Answers it, or has it wait.
Handled RequestHandler::Proceed(const ExchangePtr& exchange, Outgoing& out) {
  if (auto reply = Try(*exchange)) {
    Finish(*exchange, *std::move(reply), out);
    Handled answered;
    answered.keeps = !exchange->form.closes;
    return answered;
  }
  Handled waits;
  waits.resume = [this, exchange](Outgoing& to) { return Proceed(exchange, to); };
  waits.on_change = !exchange->busy;
  if (exchange->busy) {
    waits.patience = exchange->pause;
    exchange->pause = std::min(2 * exchange->pause, kTryAgainMost);
  }
  waits.held_bytes = exchange->request.body.size();
  return waits;
}

// The answer, or nothing where it is not to be had yet.
std::optional<Reply> RequestHandler::Try(Exchange& exchange) {
  std::string what = "unknown";
  bool uncertain = false;
  auto fault = catalog::StoreFault::kOther;
  exchange.busy = false;
  try {
    return Run(exchange);
  } catch (const catalog::UncertainWrite& error) {
    what = error.what();
    uncertain = true;
  } catch (const catalog::StoreError& error) {
    what = error.what();
    fault = error.fault();
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {
  }
  // Nothing was changed, so all of it can be done again.
  exchange.busy = fault == catalog::StoreFault::kBusy &&
                  Clock::now() - exchange.start < seconds(kCatalogueWaitSeconds);
  if (exchange.busy) return std::nullopt;
  return uncertain ? UncertainReply(exchange, what) : FaultReply(exchange, what, fault);
}

std::optional<Reply> RequestHandler::Run(Exchange& exchange) {
  if (exchange.later) return exchange.later();
  if (auto refused = Refuse(exchange)) return refused;
  const Incoming& request = exchange.request;
  const Call call{exchange.argument, request.head.query, exchange.header(), request.body,
                  request.head.path, exchange.user,      exchange.client};
  if (IsLarge(call)) {
    call.turn = large_.Enter(exchange.ticket);
    const bool waits =
        exchange.ticket && Clock::now() - exchange.start < seconds(kLargeWaitSeconds);
    if (!call.turn && waits) return std::nullopt;
    if (!call.turn)
      return BusyReply("large_requests_max", kLargeMax, "other large requests are being worked on",
                       1);
  }
  Reply reply = exchange.route->answer(call);
  if (!reply.later) return reply;
  exchange.later = std::move(reply.later);
  exchange.request.body = {};
  return exchange.later();
}

void RequestHandler::LogFault(const Exchange& exchange, const std::string& what) {
  Log({{"level", "error"},
       {"method", exchange.request.head.method},
       {"path", exchange.request.head.path},
       {"fault", what}});
}

Reply RequestHandler::UncertainReply(const Exchange& exchange, const std::string& what) {
  LogFault(exchange, what);
  return ProblemReply(
      503,
      "the catalogue's server was lost while it confirmed what was asked for, so it "
      "may or may not have been done; with an Idempotency-Key it can be asked for "
      "again and acts once, else look first");
}

// The log gets all of it, the client what it can act on.
Reply RequestHandler::FaultReply(const Exchange& exchange, const std::string& what,
                                 catalog::StoreFault fault) {
  LogFault(exchange, what);
  if (fault == catalog::StoreFault::kStorage)
    return ProblemReply(
        507,
        "the catalogue cannot be written or read: its disk is full or fails; nothing was changed");
  if (fault == catalog::StoreFault::kOther)
    return ProblemReply(500, "a fault of the program; its log says more");
  auto reply = ProblemReply(
      503, fault == catalog::StoreFault::kAway
               ? "the catalogue's server cannot be reached; nothing was changed"
               : "the catalogue is being written by another for too long; nothing was changed");
  reply.headers.emplace_back("Retry-After", "5");
  return reply;
}

// A large body that was built for this answer alone counts until it has left.
Reply RequestHandler::WithinBudget(Reply reply) {
  if (reply.body.size() <= kLargeBodyBytes) return reply;
  auto held = answers_.Hold(std::exchange(reply.body, {}));
  if (!held)
    return BusyReply("answer_bytes_max", kAnswerBytesMax, "other large answers are being read", 5);
  reply.tail.insert(reply.tail.begin(), std::move(held));
  return reply;
}

// What waits may be open for an hour: it ends when its token is revoked.
Produce RequestHandler::WhileAuthorized(Produce produce, const Exchange& exchange) {
  const auto given = exchange.header()("Authorization");
  const Header header = [given](const char*) { return std::optional<std::string>(given); };
  return [this, produce = std::move(produce), header, access = exchange.route->access,
          waited = false](std::string& piece) mutable {
    if (waited && std::holds_alternative<Reply>(Authorize(header, access, tokens_)))
      return Flow::kEnds;
    const Flow flow = produce(piece);
    waited = flow == Flow::kWaits;
    return flow;
  };
}

void RequestHandler::Finish(Exchange& exchange, Reply reply, Outgoing& out) {
  reply = WithinBudget(std::move(reply));
  if (reply.produce && options_.needs_token && exchange.route->access != Access::kOpen)
    reply.produce = WhileAuthorized(std::move(reply.produce), exchange);
  if (reply.produce && !exchange.form.may_chunk) exchange.form.closes = true;
  Record(exchange, reply);
  WriteAnswer(std::move(reply), exchange.form, out);
  exchange.request.body = {};
  if (exchange.bytes_in > kLargeBodyBytes) ReturnFreeMemory();
}

void RequestHandler::Record(const Exchange& exchange, const Reply& reply) {
  const double seconds = std::chrono::duration<double>(Clock::now() - exchange.start).count();
  const std::size_t bytes_out = reply.body_size();
  metrics_.Count(exchange.request.head.method, exchange.pattern, reply.status, seconds,
                 exchange.bytes_in, bytes_out);
  if (!options_.log) return;
  Log({{"level", "info"},
       {"peer", exchange.request.peer},
       {"user", exchange.user},
       {"method", exchange.request.head.method},
       {"path", exchange.request.head.path.substr(0, kPathBytesMax)},
       {"route", exchange.pattern},
       {"status", reply.status},
       {"bytes_in", exchange.bytes_in},
       {"bytes_out", bytes_out},
       {"seconds", api::Number(seconds)}});
}

std::string RequestHandler::RefusalText(const Refusal& refusal, const std::string& peer) {
  const auto value = [&] { return options_.limits.value(refusal.limit, api::Json()); };
  const Reply reply = refusal.limit.empty() ? ProblemReply(refusal.status, refusal.detail)
                      : refusal.status == 429
                          ? BusyReply(refusal.limit, value(), refusal.detail, 10)
                          : LimitReply(refusal.status, refusal.limit, value(), refusal.detail);
  metrics_.Count("none", "none", refusal.status, 0.0, 0, reply.body.size());
  if (options_.log)
    Log({{"level", "info"},
         {"peer", peer},
         {"status", refusal.status},
         {"detail", refusal.detail}});
  return AnswerText(reply);
}

}  // namespace plenum::server
