#include "server/resources/schemas/operations.h"

#include <map>
#include <stdexcept>

namespace plenum::server {
namespace {

constexpr char kCsv[] = "text/csv", kBytes[] = "application/octet-stream",
               kEvents[] = "text/event-stream";

const std::vector<std::string> kJobPost = {"validate_only", "priority", "Prefer", "Idempotency-Key",
                                           "From"};

const std::map<std::string, Operation>& Operations() {
  static const std::vector<std::string> kPage = {"limit", "cursor"};
  static const std::vector<std::string> kSensor = {"sensor_noise_kpa", "sensor_resolution_kpa",
                                                   "sampling_hz", "bottle_l", "bottle_uncertainty"};
  static const std::vector<std::string> kWrite = {"Idempotency-Key", "From"};
  static const std::map<std::string, Operation> kOperations = {
      {"POST /v1/designs",
       {kJobPost,
        "Requirements",
        {{200, "DesignsOrValid"}, {202, "JobAccepted"}},
        {400, 422, 429}}},
      {"POST /v1/diagnoses",
       {{"priority", "Prefer", "Idempotency-Key", "From"},
        "Measurement",
        {{200, "Diagnosis"}, {202, "JobAccepted"}},
        {400, 422, 429}}},
      {"POST /v1/simulations",
       {{}, "SimulationOrCurves", {{200, "ResponseOrCurves"}}, {400, 422, 429}}},
      {"POST /v1/evaluations", {{}, "Evaluation", {{200, "EvaluationAnswer"}}, {400, 422, 429}}},
      {"POST /v1/fmus", {{}, "Evaluation", {{200, "Unit", kBytes}}, {400, 422, 429}}},
      {"GET /v1/designs/{id}/{rank}/fmu",
       {{"rank"}, "", {{200, "Unit", kBytes}}, {404, 409, 422, 429}}},
      {"POST /v1/measurements", {{}, "Recording", {{200, "Recorded"}}, {400, 422, 429}}},
      {"POST /v1/maps", {{}, "Map", {{200, "MapAnswer"}}, {400, 422, 429}}},
      {"GET /v1/parts", {{"If-None-Match"}, "", {{200, "PartsPage"}, {304, ""}}, {404, 422}}},
      {"POST /v1/parts", {kWrite, "Part", {{201, "StoredPart"}}, {400, 409, 422}}},
      {"GET /v1/parts/export", {{"family"}, "", {{200, "Csv", kCsv}}, {422}}},
      {"POST /v1/parts/import",
       {{"family", "dry_run", "encoding", "delimiter", "decimal", "header_row", "column", "set",
         "Idempotency-Key", "From"},
        "csv",
        {{200, "Import"}},
        {422}}},
      {"GET /v1/parts/compare", {{"ids"}, "", {{200, "Comparison"}}, {404, 422}}},
      {"GET /v1/parts/check", {{}, "", {{200, "CatalogCheck"}}, {422}}},
      {"GET /v1/parts/{id}",
       {{"revision", "If-None-Match"}, "", {{200, "StoredPart"}, {304, ""}}, {404, 422}}},
      {"PUT /v1/parts/{id}",
       {{"If-Match", "From"}, "Part", {{200, "StoredPart"}}, {400, 404, 412, 422}}},
      {"DELETE /v1/parts/{id}", {{"If-Match", "From"}, "", {{204, ""}}, {404, 412}}},
      {"GET /v1/parts/{id}/protocol", {kSensor, "", {{200, "Protocol"}}, {404, 422}}},
      {"GET /v1/parts/{id}/history", {kPage, "", {{200, "History"}}, {404, 422}}},
      {"GET /v1/families", {{}, "", {{200, "Families"}}, {}}},
      {"GET /v1/queue", {{}, "", {{200, "Queue"}}, {}}},
      {"GET /v1/limits", {{}, "", {{200, "Limits"}}, {}}},
      {"POST /v1/catalog/update", {{"dry_run", "From"}, "", {{200, "SeedUpdate"}}, {404, 422}}},
      {"GET /v1/revisions", {kPage, "", {{200, "Revisions"}}, {422}}},
      {"GET /v1/revisions/{id}", {kPage, "", {{200, "RevisionWithChanges"}}, {404, 422}}},
      {"POST /v1/revisions/{id}/undo", {kWrite, "", {{200, "Undone"}}, {404, 409, 422}}},
      {"GET /v1/models", {{}, "", {{200, "Models"}}, {}}},
      {"POST /v1/models", {kWrite, "NamedModel", {{201, "ModelRevision"}}, {400, 422}}},
      {"GET /v1/models/{id}", {{}, "", {{200, "ModelVersions"}}, {404}}},
      {"GET /v1", {{}, "", {{200, "RouteTable"}}, {}}},
      {"GET /healthz", {{}, "", {{200, "Health"}}, {}}},
      {"GET /readyz", {{}, "", {{200, "Readiness"}}, {503}}},
      {"GET /metrics", {{}, "", {{200, "Text", "text/plain"}}, {}}},
      {"GET /openapi.json", {{}, "", {{200, "Anything"}}, {}}},
  };
  return kOperations;
}

const std::map<std::string, Operation>& DocumentOperations() {
  static const std::map<std::string, Operation> kOperations = {
      {"GET /v1/parts/{id}/documents", {{"revision"}, "", {{200, "Documents"}}, {404, 422}}},
      {"POST /v1/parts/{id}/documents",
       {{"link", "sha256", "Idempotency-Key", "From"},
        "file",
        {{200, "DocumentOfPart"}, {201, "DocumentOfPart"}},
        {404, 422}}},
      {"GET /v1/parts/{id}/documents/{sha256}",
       {{"sha256_of", "revision", "If-None-Match"},
        "",
        {{200, "Unit", "*/*"}, {304, ""}},
        {404, 422}}},
      {"DELETE /v1/parts/{id}/documents/{sha256}",
       {{"sha256_of", "From"}, "", {{204, ""}}, {404, 422}}},
  };
  return kOperations;
}

const std::map<std::string, Operation>& SweepOperations() {
  static const std::map<std::string, Operation> kOperations = {
      {"POST /v1/sweeps",
       {kJobPost, "Sweep", {{200, "SweepTableOrValid"}, {202, "SweepAccepted"}}, {400, 422, 429}}},
      {"GET /v1/sweeps", {{}, "", {{200, "Sweeps"}}, {}}},
      {"GET /v1/sweeps/{id}", {{}, "", {{200, "SweepWithJobs"}}, {404}}},
      {"DELETE /v1/sweeps/{id}", {{}, "", {{200, "SweepAccepted"}}, {404}}},
      {"GET /v1/sweeps/{id}/table",
       {{"format"}, "", {{200, "SweepTable"}, {200, "Csv", kCsv}}, {404, 422}}},
  };
  return kOperations;
}

// Of what people read in a browser.
const std::map<std::string, Operation>& PageOperations() {
  static const std::map<std::string, Operation> kOperations = {
      {"GET /openapi", {{}, "", {{200, "Text", "text/html"}}, {}}},
      {"GET /docs", {{}, "", {{308, ""}}, {}}},
      {"GET /docs/{path}",
       {{"path", "If-None-Match"}, "", {{200, "Text", "*/*"}, {304, ""}}, {404}}},
      {"GET /", {{"If-None-Match"}, "", {{200, "Text", "text/html"}, {304, ""}}, {}}},
      {"GET /assets/{id}", {{}, "", {{200, "Text", "*/*"}}, {404}}},
  };
  return kOperations;
}

}  // namespace

// Those of both kinds of jobs are alike.
const Operation& OperationOf(const std::string& method, const std::string& path) {
  static const std::map<std::string, Operation> kJobs = {
      {"GET ", {{}, "", {{200, "Jobs"}}, {}}},
      {"GET /{id}", {{"If-None-Match"}, "", {{200, "Job"}, {304, ""}}, {404}}},
      {"DELETE /{id}", {{}, "", {{200, "JobAccepted"}}, {404}}},
      {"POST /{id}/again", {{}, "", {{202, "JobAccepted"}}, {404, 409, 429}}},
      {"GET /{id}/events", {{}, "", {{200, "Text", kEvents}}, {404, 429}}},
  };
  const std::string name = method + " " + path;
  for (const auto* operations :
       {&Operations(), &DocumentOperations(), &SweepOperations(), &PageOperations()})
    if (const auto found = operations->find(name); found != operations->end()) return found->second;
  for (const std::string jobs : {"/v1/designs", "/v1/diagnoses"})
    if (path.starts_with(jobs)) return kJobs.at(method + " " + path.substr(jobs.size()));
  throw std::logic_error("no description of " + method + " " + path);
}

}  // namespace plenum::server
