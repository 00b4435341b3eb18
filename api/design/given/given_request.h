// evaluation/1 read: requirements and a given design, which fit each other.
#ifndef PLENUM_API_DESIGN_GIVEN_GIVEN_REQUEST_H_
#define PLENUM_API_DESIGN_GIVEN_GIVEN_REQUEST_H_

#include <functional>
#include <optional>
#include <vector>

#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"

namespace plenum::api {

struct GivenRequest {
  DesignRequest asked;
  optimizer::Design design;
  std::optional<optimizer::Design> beside;
  Remarks remarks;
};

Parsed<GivenRequest> ReadGivenRequest(const Json& request, const std::vector<catalog::Part>& parts,
                                      const std::vector<catalog::ModelRevision>& models);

// Says when so many seconds are over.
std::function<bool()> After(double seconds);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_GIVEN_REQUEST_H_
