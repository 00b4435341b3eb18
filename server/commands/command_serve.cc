#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "api/catalogue/stores.h"
#include "server/call/protection.h"
#include "server/call/tokens.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/interrupt.h"
#include "server/commands/memory_patience.h"
#include "server/http.h"
#include "server/resources/pages/docs_resource.h"

namespace plenum::server {
namespace {

struct ServeOptions {
  std::string catalog = catalog::DefaultCatalog();
  std::string docs = DocsFolder();
  std::string host = "127.0.0.1";
  int port = 8080;
  int workers = JobOptions().workers;
  std::vector<std::string> allow_hosts;
  bool log = true;
};

std::unique_ptr<HttpService> Listen(const ServeOptions& options) {
  OpenCatalog(options.catalog, catalog::Access::kRead);  // says what is wrong with the file
  if (options.docs != DocsFolder() &&
      !std::filesystem::exists(std::filesystem::path(options.docs) / "index.html"))
    throw BadInput("--docs " + options.docs + " has no index.html");
  HttpOptions http;
  http.catalog = options.catalog;
  http.docs = options.docs;
  http.seed = catalog::InstalledSeed();
  http.host = options.host;
  http.port = options.port;
  http.allow_hosts = options.allow_hosts;
  http.log = options.log;
  http.jobs.workers = options.workers;
  if (options.workers == 0 && !catalog::IsServer(options.catalog))
    throw BadInput("--workers 0: nobody else does the jobs of a catalogue in a file");
  if (NeedsToken(http) && ReadTokens(TokenFile(options.catalog)).empty())
    throw BadInput(
        "other machines can reach this service, so it needs tokens: make one with "
        "plenum token create");
  try {
    return std::make_unique<HttpService>(http);
  } catch (const ListenError& error) {
    throw BadInput(error.what());
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

void Serve(const ServeOptions& options) {
  BlockInterrupts();
  WaitForMemory();
  // A write past the limit on the size of files then fails, as on a full disk, and ends nothing.
  std::signal(SIGXFSZ, SIG_IGN);
  const auto service = Listen(options);
  std::fprintf(stderr, "plenum listens at http://%s:%d/\n",
               options.host == "::1" ? "[::1]" : options.host.c_str(), service->port());
  std::thread thread([&] { service->Run(); });
  WaitForInterrupt();
  std::fputs("stopping\n", stderr);
  service->Stop();
  thread.join();
}

}  // namespace

Command ServeCommand() {
  auto options = std::make_shared<ServeOptions>();
  return {
      "serve",
      "The HTTP service with its page",
      "plenum serve --port 8080",
      {{"--host",
        "Address; any but a loopback one needs tokens",
        &options->host,
        {.shows_default = true}},
       {"--port",
        "0 takes any free one",
        &options->port,
        {.shows_default = true, .allowed = Within{0, 65535}}},
       {"--allow-host", "Name by which a proxy makes the service known; needs tokens",
        &options->allow_hosts},
       {"--workers",
        "Jobs at a time, of designs and as many of diagnoses; on a server of both together, and "
        "0 leaves them to plenum worker",
        &options->workers,
        {.value_name = "N", .shows_default = true, .allowed = Within{0, 1024}}},
       {"!--no-log", "No line a request on standard error", &options->log},
       {"--docs",
        "Folder of the documentation that /docs/ shows; without it the one that was "
        "built or installed with this program",
        &options->docs,
        {.value_name = "DIR"}},
       CatalogOption(options->catalog)},
      [options] {
        Serve(*options);
        return kAnswered;
      }};
}

}  // namespace plenum::server
