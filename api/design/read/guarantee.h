// What a request asks to be guaranteed, and the problem that proves it.
#ifndef PLENUM_API_DESIGN_READ_GUARANTEE_H_
#define PLENUM_API_DESIGN_READ_GUARANTEE_H_

#include <optional>
#include <string>
#include <vector>

#include "api/design/read/worst_parts.h"
#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Of a group's own numbers, relative, one standard deviation.
struct GroupUncertainty {
  double rest_volume = 0.0, expansion_ratio = 0.0;
};

struct GuaranteeRequest {
  Tolerance tolerance;
  std::vector<GroupUncertainty> groups;  // one each
};

// "relative_uncertainty" of a group.
GroupUncertainty ReadGroupUncertainty(Reader& group);
// "guarantee": true, or an object with a "tolerance"; none where it is absent or false.
std::optional<GuaranteeRequest> ReadGuarantee(Reader& request,
                                              std::vector<GroupUncertainty> groups);
// Why designs of the problem cannot be guaranteed; empty where they can.
std::string WhyNotGuaranteed(const optimizer::Problem& problem, const GuaranteeRequest& guarantee);

// Whether valves that cannot hold are left out: where several groups share a source their worst is
// not known.
bool NeedsHoldingValves(const optimizer::Problem& problem);

// The problem with parts and actuators at the worst of their tolerances: its designs are the
// guaranteed ones. Volumes of actuators are the largest (more air, slower strokes). `rows` are
// those that `problem` was made of.
optimizer::Problem GuaranteedProblem(const optimizer::Problem& problem,
                                     const GuaranteeRequest& guarantee,
                                     const std::vector<catalog::Part>& rows,
                                     const Settled& settled = {});

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_GUARANTEE_H_
