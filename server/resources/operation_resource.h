// What those ask who run the service: is it alive, can it take work, what did it do.
#ifndef PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_

#include <mutex>

#include "server/call/reply.h"
#include "server/resources/route.h"

namespace plenum::server {

// What the last look found, for those who ask during another.
struct LastReadiness {
  LastReadiness();
  std::mutex looking, mutex;
  Reply reply;
};

// Whether it can take work: the file is the one that was opened, can be read and written, the disk
// has room. 200 or 503, with each check as "ok", "busy" or "failed". It takes less than a second.
Reply GetReadiness(const Services& services, LastReadiness& last);
// Prometheus text format 0.0.4.
Reply GetMetrics(const Services& services, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_OPERATION_RESOURCE_H_
