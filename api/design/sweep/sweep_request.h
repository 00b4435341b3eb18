// sweep/1: requirements and patches of them, each patch a design request of its own.
#ifndef PLENUM_API_DESIGN_SWEEP_SWEEP_REQUEST_H_
#define PLENUM_API_DESIGN_SWEEP_SWEEP_REQUEST_H_

#include <optional>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"

namespace plenum::api {

// One patch laid over the requirements (JSON Merge Patch, RFC 7396).
struct SweptRequest {
  std::string patch;  // its name
  Json requirements;  // the merged document, which POST /v1/designs would take
  std::string name;   // that the merged document gives itself
  std::optional<catalog::ModelRevision> model;
};

struct SweepRequest {
  std::string name;
  std::vector<SweptRequest> requests;  // in the order of the patches
  // What the table says of the requests beside their answers: { name, objective, varied, patches:
  // [{ name, values }] }. `varied` are pointers to the values that differ between the merged
  // documents or from the requirements, at most kSweepFieldsMax; `objective` is null where it
  // differs.
  Json plan;
};

// Every merged document is read as POST /v1/designs reads it. Errors point into
// /patches/i/merge/… where the patch says the value, into /requirements/… where the requirements
// alone have the same error, and else to /patches/i/merge, with the field in the detail.
Parsed<SweepRequest> ParseSweep(const Json& document, const std::vector<catalog::Part>& parts,
                                const std::vector<catalog::ModelRevision>& models);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SWEEP_SWEEP_REQUEST_H_
