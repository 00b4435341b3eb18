// Jobs from their file, and sweeps, for people and as JSON.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_JOBS_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_JOBS_H_

#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/json.h"

namespace plenum::server {

// A table of at most 100 columns, and below it why those that failed did.
std::string JobsText(const std::vector<catalog::JobRecord>& jobs);

// As over HTTP (server/resources/jobs_resource.h) and its kind, without progress, result and links.
api::Json RenderJob(const catalog::JobRecord& job);

// sweep_table/1 as a table with a line for each patch, and below it why patches have no design.
std::string SweepText(const api::Json& table);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_JOBS_H_
