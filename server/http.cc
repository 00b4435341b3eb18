#include "server/http.h"

#include <malloc.h>

#include <csignal>
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
#include "server/wire/listener.h"

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
                 routes, tokens, metrics, [this] { connections.Wake(); }),
        connections(HandlersOfConnections()) {
    // Large blocks go back to the system when they are freed.
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
    mallopt(M_ARENA_MAX, 4);
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
        [this](const RequestHead& head, const std::string& peer) {
          return requests.RefusalOf(head, peer);
        },
        [this](const Refusal& refusal, const std::string& peer) {
          return requests.RefusalText(refusal, peer);
        },
        [](const RequestHead& head) { return head.path == "/healthz" || head.path == "/readyz"; }};
  }

  static catalog::JobsKept KeptOf(const HttpOptions& given) {
    return catalog::IsServer(given.catalog) ? kSharedJobsKept : given.kept;
  }

  int Bind() {
    const int bound = listener.Bind(options.host, options.port);
    if (bound <= 0) {
      throw ListenError("cannot listen at " + options.host + " port " +
                        std::to_string(options.port) + ": is it taken by another program?");
    }
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
  Listener listener;
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

// A client, or whoever reads the log, that has gone is an error of one write, not of the process.
HttpService::HttpService(const HttpOptions& options) : impl_(std::make_unique<Impl>(options)) {
  std::signal(SIGPIPE, SIG_IGN);
}
HttpService::~HttpService() = default;

int HttpService::port() const { return impl_->port; }

void HttpService::Run() {
  impl_->connections.Start(kRequestThreads);
  impl_->listener.Run([this](int socket) { impl_->connections.Admit(socket); });
  impl_->connections.Stop();
}

void HttpService::Stop() {
  impl_->jobs->Stop();
  impl_->listener.Stop();
}

}  // namespace plenum::server
