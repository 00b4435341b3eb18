#include "server/http.h"

#include <malloc.h>
#include <sys/socket.h>

#include <chrono>
#include <thread>
#include <utility>

#include "server/call/protection.h"
#include "server/call/request_log.h"
#include "server/call/service_limits.h"
#include "server/jobs/catalogue_hold.h"
#include "server/jobs/job_memory.h"
#include "server/jobs/service_jobs.h"
#include "server/jobs/shared_jobs.h"
#include "server/request_handler.h"
#include "server/resources/designs_resource.h"
#include "server/resources/diagnoses_resource.h"
#include "server/resources/routes.h"
#include "server/wire/connections.h"
#include "server/wire/protocol.h"

namespace plenum::server {

bool NeedsToken(const HttpOptions& options) {
  return !IsLoopback(options.host) || !options.allow_hosts.empty();
}

struct HttpService::Impl {
  // The port first: without it no job is begun.
  explicit Impl(const HttpOptions& given)
      : options(given),
        port(Bind()),
        tokens(TokenFile(given.catalog)),
        hold(given.catalog),
        catalog(given.catalog),
        jobs(OpenServiceJobs(given.catalog, {DesignWork(catalog, memory), DiagnosisWork(catalog)},
                             given.jobs, given.kept)),
        routes(Routes({catalog, jobs->designs(), jobs->diagnoses(),
                       [this] { return jobs->Queue(); }, metrics, given.jobs, KeptOf(given),
                       given.catalog, given.docs, given.seed, [this] { MeasureConnections(); }})),
        requests({HostsOf(given), NeedsToken(given), given.log,
                  RenderLimits(QuotaOf(given.jobs), KeptOf(given))},
                 routes, tokens, metrics, protocol, [this] { connections.Wake(); }),
        connections(HandlersOfConnections()) {
    // Large blocks go back to the system when they are freed.
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
    mallopt(M_ARENA_MAX, 4);
    protocol.admit = [this](int socket) { connections.Admit(socket); };
    jobs->OnChange([this] { connections.Wake(); });
  }

  // Jobs may change after the connections are gone.
  ~Impl() { jobs->OnChange({}); }

  static std::vector<std::string> HostsOf(const HttpOptions& given) {
    auto hosts = given.allow_hosts;
    if (given.host != "localhost" && !IsLoopback(given.host)) hosts.push_back(given.host);
    return hosts;
  }

  Handlers HandlersOfConnections() {
    return {
        [this](Incoming request, Outgoing& out) { return requests.Take(std::move(request), out); },
        [this](const std::string& head, const std::string& peer) {
          return requests.RefusalOf(head, peer);
        },
        [this](const Refusal& refusal, const std::string& peer) {
          return requests.RefusalText(refusal, peer);
        },
        [](const std::string& head) {
          return head.starts_with("GET /healthz ") || head.starts_with("GET /readyz ");
        }};
  }

  static catalog::JobsKept KeptOf(const HttpOptions& given) {
    return catalog::IsServer(given.catalog) ? kSharedJobsKept : given.kept;
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

  void MeasureConnections() {
    metrics.Set("plenum_connections", "Open connections.", double(connections.open()));
    metrics.Set("plenum_buffered_bytes", "Of requests on their way.",
                double(connections.buffered_bytes()));
    metrics.Set("plenum_answer_bytes", "Of large answers on their way.",
                double(requests.answer_bytes()));
    metrics.Set("plenum_connections_closed_early", "Closed for being slow or to make room.",
                double(connections.closed_early()));
    metrics.Set("plenum_log_lines_dropped", "Where the log was not read fast enough.",
                double(DroppedLogLines()));
  }

  const HttpOptions options;
  Protocol protocol;
  const int port;
  TokenKeeper tokens;
  Metrics metrics;
  CatalogueHold hold;
  SharedCatalog catalog;
  JobMemory memory{kJobMemoryBytesMax};
  const std::unique_ptr<ServiceJobs> jobs;
  const std::vector<Route> routes;
  RequestHandler requests;
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
  impl_->jobs->Stop();
  // A stop before the listening has begun would be lost.
  while (!impl_->protocol.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  impl_->protocol.stop();
}

}  // namespace plenum::server
