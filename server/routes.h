// What the service answers: one table of routes, from which requests are dispatched, 405 is decided
// and the table itself is served.
#ifndef PLENUM_SERVER_ROUTES_H_
#define PLENUM_SERVER_ROUTES_H_

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs.h"
#include "server/metrics.h"
#include "server/protection.h"
#include "server/reply.h"
#include "server/shared_catalog.h"

namespace plenum::server {

struct Route {
  std::string method;
  std::string path;  // "{id}" stands for one segment, which becomes Call::argument
  std::string summary;
  Access access;
  std::function<Reply(const Call&)> answer;
};

// What the routes work with; all of it must outlive them.
struct Services {
  SharedCatalog& catalog;
  Jobs& designs;
  Jobs& diagnoses;
  Metrics& metrics;
  JobOptions job_options;
  std::filesystem::path file;                 // the catalogue
  std::function<void()> measure_connections;  // sets their metrics
};
std::vector<Route> Routes(const Services& services);

// Whether `path` has the form of `route.path`; the segment at {id} goes to `argument`.
bool Matches(const Route& route, std::string_view path, std::string& argument);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_ROUTES_H_
