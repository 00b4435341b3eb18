// One row of the table of routes, and what routes work with.
#ifndef PLENUM_SERVER_RESOURCES_ROUTE_H_
#define PLENUM_SERVER_RESOURCES_ROUTE_H_

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/call/metrics.h"
#include "server/call/protection.h"
#include "server/call/reply.h"
#include "server/call/shared_catalog.h"
#include "server/jobs/job_queue.h"

namespace plenum::server {

struct Route {
  std::string method;
  std::string path;  // "{id}" stands for one segment, which becomes Call::argument, "{id}/{rank}"
                     // for two, joined by "/"; "{path}", at the end, for all that is left, which
                     // may be nothing
  std::string summary;
  Access access;
  std::function<Reply(const Call&)> answer;
  std::vector<std::string_view> types = {"application/json"};  // of its body
};

// What the routes work with.
struct Services {
  SharedCatalog& catalog;
  JobQueue& designs;
  JobQueue& diagnoses;
  std::function<catalog::QueueState()> queue;  // of all kinds of jobs
  Metrics& metrics;
  JobOptions job_options;
  catalog::JobsKept jobs_kept;
  std::filesystem::path file;                 // the catalogue
  std::filesystem::path docs;                 // the built documentation
  std::filesystem::path seed;                 // the installed catalogue; may be empty
  std::function<void()> measure_connections;  // sets their metrics
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_ROUTE_H_
