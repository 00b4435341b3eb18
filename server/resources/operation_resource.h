// What those ask who run the service: is it alive, can it take work, what did it do.
#ifndef PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_

#include "server/call/reply.h"
#include "server/resources/route.h"

namespace plenum::server {

// 200 with { "status": "ready", "checks" }, or 503 and what is not: the catalogue can be written,
// its disk has room, both queues take jobs.
Reply GetReadiness(const Services& services, const Call& call);
// Prometheus text format 0.0.4.
Reply GetMetrics(const Services& services, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_
