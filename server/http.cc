#include "server/http.h"

#include <malloc.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "api/json/problem_document.h"
#include "server/call/request_log.h"
#include "server/call/service_limits.h"
#include "server/jobs/crash_marks.h"
#include "server/jobs/job_recovery.h"
#include "server/resources/designs_resource.h"
#include "server/resources/diagnoses_resource.h"
#include "server/resources/routes.h"
#include "server/wire/connections.h"
#include "server/wire/protocol.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kGoOn = 204;  // of a head that is not refused: no refusal has this status

std::string StatusLine(int status) {
  return "HTTP/1.1 " + std::to_string(status) + " " +
         api::ProblemDocument(status, "")["title"].get<std::string>() + "\r\n";
}

void Send(const Reply& reply, httplib::Response& response) {
  response.status = reply.status;
  response.set_header("Accept-Ranges", "none");
  for (const auto& [name, value] : reply.headers) response.set_header(name.c_str(), value);
  if (reply.stream) {
    response.set_chunked_content_provider(
        reply.content_type, [stream = reply.stream](std::size_t, httplib::DataSink& sink) {
          const auto write = [&](std::string_view text) {
            return sink.is_writable() && sink.write(text.data(), text.size());
          };
          if (!stream(write)) sink.done();
          return sink.is_writable();
        });
  } else if (!reply.content_type.empty() && !reply.body.empty()) {
    response.set_content(reply.body, reply.content_type);
  }
}

Header HeadersOf(const httplib::Request& request) {
  return [&request](const char* name) -> std::optional<std::string> {
    if (!request.has_header(name)) return std::nullopt;
    return request.get_header_value(name);
  };
}

// The log gets all of it, the client what it can act on.
Reply FaultReply(const httplib::Request& request, const std::exception_ptr& fault) {
  std::string what = "unknown";
  auto store_fault = catalog::StoreFault::kOther;
  try {
    std::rethrow_exception(fault);
  } catch (const catalog::StoreError& error) {
    what = error.what();
    store_fault = error.fault();
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {
  }
  Log({{"level", "error"}, {"method", request.method}, {"path", request.path}, {"fault", what}});
  if (store_fault == catalog::StoreFault::kStorage)
    return ProblemReply(507,
                        "the catalogue cannot be written or read: its disk is full or fails; "
                        "nothing was changed");
  if (store_fault == catalog::StoreFault::kOther)
    return ProblemReply(500, "a fault of the program; its log says more");
  auto reply = ProblemReply(
      503, "the catalogue is being written by another for too long; nothing was changed");
  reply.headers.emplace_back("Retry-After", "5");
  return reply;
}

// Whether the answer takes much memory to make.
bool IsLarge(const Route& route, const Call& call) {
  if (call.body.size() > kLargeBodyBytes || route.path == "/v1/parts/export") return true;
  api::Errors ignored;
  const bool facets = ReadFlag(call, "facets", ignored);
  const std::string limit = QueryValue(call, "limit").value_or("");
  return facets || limit.size() > 3 || std::atoi(limit.c_str()) > kLargePageParts;
}

// What a refusal by RequestFrame is worth in numbers.
api::Json ValueOf(const std::string& limit, const HttpOptions& options) {
  return RenderLimits(QuotaOf(options.jobs), options.kept).value(limit, api::Json());
}

}  // namespace

bool NeedsToken(const HttpOptions& options) {
  return !IsLoopback(options.host) || !options.allow_hosts.empty();
}

struct HttpService::Impl {
  enum class Part { kHead, kWhole };
  struct Asked {
    const Route* route = nullptr;
    std::string argument;
  };
  // An answer that goes nowhere yet.
  struct Text final : Outgoing {
    void Write(std::string_view bytes) override { text += bytes; }
    bool Flush() override { return true; }
    std::string text;
  };

  // The port first: without it no job is begun.
  explicit Impl(const HttpOptions& given)
      : options(given),
        port(Bind()),
        tokens(TokenFile(given.catalog)),
        catalog(given.catalog),
        jobs(given.catalog.string() + "-jobs", given.kept),
        marks(Recovered(CrashFile(given.catalog))),
        designs(jobs, turns, "design", DesignWork(catalog), given.jobs),
        diagnoses(jobs, turns, "diagnosis", DiagnosisWork(catalog), given.jobs),
        routes(Routes({catalog, designs, diagnoses, metrics, given.jobs, given.kept, given.catalog,
                       [this] { MeasureConnections(); }})),
        connections([this](Incoming request,
                           Outgoing& out) { return protocol.Answer(std::move(request), out); },
                    [this](const std::string& head, const std::string& peer) {
                      return Examined(head, peer);
                    },
                    [this](const Refusal& refusal, const std::string& peer) {
                      return RefusalText(refusal, peer);
                    }) {
    // Large blocks go back to the system when they are freed.
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
    mallopt(M_ARENA_MAX, 4);
    if (options.host != "localhost" && !IsLoopback(options.host))
      options.allow_hosts.push_back(options.host);
    SetHandlers();
  }

  // The file of crash marks, once the jobs know what it says.
  std::filesystem::path Recovered(const std::filesystem::path& crash_file) {
    RecoverJobs(jobs, crash_file);
    return crash_file;
  }

  int Bind() {
    protocol.set_tcp_nodelay(true);
    // The default shares a port with whoever listens there already.
    protocol.set_socket_options([](socket_t socket) {
      const int on = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    const bool any = options.port == 0;
    const int bound = any ? protocol.bind_to_any_port(options.host)
                      : protocol.bind_to_port(options.host, options.port) ? options.port
                                                                          : -1;
    if (bound <= 0) {
      throw ListenError("cannot listen at " + options.host + " port " +
                        std::to_string(options.port) + ": is it taken by another program?");
    }
    protocol.WidenBacklog();
    return bound;
  }

  void SetHandlers() {
    protocol.admit = [this](int socket) { connections.Admit(socket); };
    protocol.set_keep_alive_timeout(kIdleSecondsMax);
    protocol.set_pre_routing_handler([this](const auto& request, auto& response) {
      Answer(request, response, Part::kWhole);
      return httplib::Server::HandlerResponse::Handled;
    });
    examiner.set_pre_routing_handler([this](const auto& request, auto& response) {
      Answer(request, response, Part::kHead);
      return httplib::Server::HandlerResponse::Handled;
    });
    for (Protocol* reader : {&protocol, &examiner}) {
      // What httplib itself refuses has no body yet.
      reader->set_error_handler([](const auto&, auto& response) {
        if (!response.body.empty() || response.content_provider_) return;
        Send(ProblemReply(response.status, "the request could not be read"), response);
      });
    }
  }

  // The refusal of a request whose body is still to come, if its head is enough for one.
  std::string Examined(const std::string& head, const std::string& peer) {
    Text answer;
    examiner.Answer({head, "", peer, true}, answer);
    return answer.text.starts_with("HTTP/1.1 " + std::to_string(kGoOn)) ? "" : answer.text;
  }

  void Answer(const httplib::Request& request, httplib::Response& response, Part part) {
    const auto start = Clock::now();
    const std::size_t bytes_in = request.body.size();
    std::string route = "none", user;
    Reply reply;
    try {
      auto asked = Examine(request, route, user);
      if (auto* refused = std::get_if<Reply>(&asked))
        reply = *std::move(refused);
      else if (part == Part::kHead)
        reply.status = kGoOn;
      else
        reply = Run(std::get<Asked>(std::move(asked)), request, user);
    } catch (...) {
      reply = FaultReply(request, std::current_exception());
    }
    Send(reply, response);
    if (reply.status == kGoOn && part == Part::kHead) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    metrics.Count(request.method, route, reply.status, seconds, bytes_in, reply.body.size());
    if (bytes_in > kLargeBodyBytes) malloc_trim(0);
    if (!options.log) return;
    Log({{"level", "info"},
         {"peer", request.remote_addr},
         {"user", user},
         {"method", request.method},
         {"path", request.path.substr(0, kPathBytesMax)},
         {"route", route},
         {"status", reply.status},
         {"bytes_in", bytes_in},
         {"bytes_out", reply.body.size()},
         {"seconds", api::Number(seconds)}});
  }

  // What a head asks for, or why it gets no answer. Sets the pattern of the route that it names,
  // and whose token was shown.
  std::variant<Asked, Reply> Examine(const httplib::Request& request, std::string& route,
                                     std::string& user) {
    const Header header = HeadersOf(request);
    if (auto refused = RefuseForeign(header, options.allow_hosts)) return *std::move(refused);
    if (request.path.size() > kPathBytesMax)
      return LimitReply(414, "path_bytes_max", kPathBytesMax, "the path is too long");
    if (request.has_header("Content-Encoding") || request.is_multipart_form_data())
      return ProblemReply(415, "send the body itself: no Content-Encoding, no form");

    const std::string method = request.method == "HEAD" ? "GET" : request.method;
    std::string allowed;
    for (const Route& candidate : routes) {
      std::string argument;
      if (!Matches(candidate, request.path, argument)) continue;
      route = candidate.path;
      if (candidate.method != method) {
        allowed += (allowed.empty() ? "" : ", ") + candidate.method;
        continue;
      }
      if (NeedsToken(options) && candidate.access != Access::kOpen) {
        auto token = Authorize(header, candidate.access, tokens);
        if (auto* refused = std::get_if<Reply>(&token)) return *std::move(refused);
        user = std::get<Token>(token).name;
      }
      return Asked{&candidate, std::move(argument)};
    }
    if (allowed.empty()) return ProblemReply(404, "there is no " + request.path);
    auto reply = ProblemReply(405, request.path + " takes " + allowed);
    reply.headers.emplace_back("Allow", allowed);
    return reply;
  }

  Reply Run(const Asked& asked, const httplib::Request& request, const std::string& user) {
    const Route& route = *asked.route;
    const Call call{asked.argument, request.params, HeadersOf(request),
                    request.body,   request.path,   user};
    const bool large = IsLarge(route, call);
    const auto turn =
        large ? large_requests.Enter(std::chrono::seconds(kLargeWaitSeconds)) : nullptr;
    if (large && !turn)
      return BusyReply("large_requests_max", kLargeMax, "other large requests are being worked on",
                       1);
    Reply reply = route.answer(call);
    if (reply.stream && NeedsToken(options) && route.access != Access::kOpen)
      reply.stream = WhileAuthorized(std::move(reply.stream), route.access, call);
    return reply;
  }

  // A stream may be open for an hour: it ends when its token is revoked.
  std::function<bool(const Write&)> WhileAuthorized(std::function<bool(const Write&)> stream,
                                                    Access access, const Call& call) {
    const auto given = call.header("Authorization");
    const Header header = [given](const char*) { return given; };
    return [this, stream = std::move(stream), access, header](const Write& write) {
      return std::holds_alternative<Token>(Authorize(header, access, tokens)) && stream(write);
    };
  }

  // A whole answer without httplib, for what never became a request.
  std::string RefusalText(const Refusal& refusal, const std::string& peer) {
    const Reply reply =
        refusal.limit.empty() ? ProblemReply(refusal.status, refusal.detail)
        : refusal.status == 429
            ? BusyReply(refusal.limit, ValueOf(refusal.limit, options), refusal.detail, 10)
            : LimitReply(refusal.status, refusal.limit, ValueOf(refusal.limit, options),
                         refusal.detail);
    std::string headers;
    for (const auto& [name, value] : reply.headers) headers += name + ": " + value + "\r\n";
    metrics.Count("none", "none", refusal.status, 0.0, 0, reply.body.size());
    if (options.log)
      Log({{"level", "info"},
           {"peer", peer},
           {"status", refusal.status},
           {"detail", refusal.detail}});
    return StatusLine(refusal.status) + headers + "Content-Type: " + reply.content_type +
           "\r\nContent-Length: " + std::to_string(reply.body.size()) +
           "\r\nConnection: close\r\n\r\n" + reply.body;
  }

  void MeasureConnections() {
    metrics.Set("plenum_connections", "Open connections.", double(connections.open()));
    metrics.Set("plenum_buffered_bytes", "Of requests and answers on their way.",
                double(connections.buffered_bytes()));
    metrics.Set("plenum_connections_closed_early", "Closed for being slow or to make room.",
                double(connections.closed_early()));
    metrics.Set("plenum_log_lines_dropped", "Where the log was not read fast enough.",
                double(DroppedLogLines()));
  }

  HttpOptions options;
  Protocol protocol;
  Protocol examiner;  // of heads alone; takes no connections
  const int port;
  TokenKeeper tokens;
  Metrics metrics;
  SharedCatalog catalog;
  catalog::JobStore jobs;
  CrashMarks marks;
  JobTurns turns;
  Jobs designs, diagnoses;
  const std::vector<Route> routes;
  Gate large_requests{kLargeMax, kLargeWaitingMax};
  Connections connections;
};

HttpService::HttpService(const HttpOptions& options) : impl_(std::make_unique<Impl>(options)) {}
HttpService::~HttpService() = default;

int HttpService::port() const { return impl_->port; }

void HttpService::Run() {
  impl_->connections.Start(kRequestThreads);
  impl_->protocol.listen_after_bind();
  impl_->connections.Stop();
}

void HttpService::Stop() {
  impl_->designs.Stop();
  impl_->diagnoses.Stop();
  // A stop before the listening has begun would be lost.
  while (!impl_->protocol.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  impl_->protocol.stop();
}

}  // namespace plenum::server
