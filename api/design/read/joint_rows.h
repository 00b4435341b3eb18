// Manifolds, tees and check valves (optimizer/problem/joints.h) of a request and of a given design.
#ifndef PLENUM_API_DESIGN_READ_JOINT_ROWS_H_
#define PLENUM_API_DESIGN_READ_JOINT_ROWS_H_

#include <functional>
#include <string>

#include "optimizer/problem/problem.h"

namespace plenum::api {

// What joins the lines of each group should pass.
void SetJoints(optimizer::Problem& problem);
// Warns where several lines meet and nothing joins them, or only what passes less.
void WarnOfJoints(const optimizer::Problem& problem);

// Says of each row of a design, by its number, that is a manifold and not what joins its lines or
// pieces, or a check valve and not what its pumps need, or a pump that lacks one, of which field
// and why. The problem has all parts that the design may have.
using FailRow = std::function<void(std::size_t row, const char* field, const std::string& detail)>;
void CheckJointRows(const optimizer::Design& design, const optimizer::Problem& problem,
                    const FailRow& fail);

// Warns where lines of a given design meet and it names nothing that joins them.
void WarnOfMissingJoints(const optimizer::Design& design, const optimizer::Problem& problem,
                         const std::string& pointer);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_JOINT_ROWS_H_
