#include "api/design/read/joint_rows.h"

#include <algorithm>

#include "api/json/remarks.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

using optimizer::Family;
using optimizer::Joint;
using optimizer::Problem;

bool HasJointRow(const optimizer::Design& design) {
  return std::any_of(design.parts.begin(), design.parts.end(),
                     [](const auto& row) { return row.family == Family::kManifold; });
}

void Warn(const std::string& pointer, const std::string& detail) {
  if (RemarkRecorder* remarks = RemarkRecorder::Current()) remarks->Warn(pointer, detail);
}

std::string Meet(const Problem& problem) {
  return std::to_string(optimizer::LineCount(problem)) + " lines meet";
}

std::string Dm3PerSBar(double conductance_m3_per_s_pa) {
  return Decimal(Rounded(conductance_m3_per_s_pa / kM3PerSPaPerDm3PerSBar)) + " dm³/(s·bar)";
}

}  // namespace

void SetJoints(Problem& problem) {
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    problem.groups[g].joint_conductance_m3_per_s_pa = optimizer::JointConductance(problem, g);
}

void WarnOfJoints(const Problem& problem) {
  if (optimizer::LineCount(problem) < 2 || problem.regulation == optimizer::Regulation::kPerGroup ||
      problem.pump_feed != optimizer::PumpFeed::kShared)
    return;
  const double asked = optimizer::JointConductance(problem);
  const std::optional<Joint> joint = optimizer::JointOfLines(problem);
  if (!joint)
    return Warn("/actuators", Meet(problem) +
                                  ", and no manifold or tee that may be used joins them: what does "
                                  "is not counted");
  const model::Manifold& row = problem.parts.manifolds[joint->manifold];
  if (row.sonic_conductance_m3_per_s_pa < asked)
    Warn("/actuators", Meet(problem) + ", and the widest manifold, " + Quoted(row.basics.id) +
                           ", passes " + Dm3PerSBar(row.sonic_conductance_m3_per_s_pa) +
                           ", less than " + Dm3PerSBar(asked) +
                           ", four times what the rise times ask: by how much it slows them is "
                           "not counted");
}

void CheckJointRows(const optimizer::Design& design, const Problem& problem, const FailRow& fail) {
  const Problem own = optimizer::WithPartsOf(problem, design);
  const std::vector<Joint> needed = optimizer::JointsOf(own, design.parts);
  for (std::size_t i = 0; i < design.parts.size(); ++i) {
    const optimizer::Choice& row = design.parts[i];
    if (row.family != Family::kManifold) continue;
    const int part = optimizer::FindPart(own.parts, row.family, row.id);
    const auto joint = std::find_if(needed.begin(), needed.end(), [&](const Joint& candidate) {
      return candidate.manifold == part;
    });
    if (part < 0)
      fail(i, "/id",
           Quoted(row.id) +
               " joins no lines: it has one station, is a base for valves of one series, or its "
               "row does not say its mass, volume, conductance and pressure");
    else if (joint == needed.end())
      fail(i, "/id",
           Quoted(row.id) +
               " joins nothing here: lines and pieces are few, or another row is lighter, or it "
               "does not stand the pressure or passes less than is asked");
    else if (joint->quantity != row.quantity)
      fail(i, "/quantity",
           "must be " + std::to_string(joint->quantity) + ", as " + Meet(problem) +
               " and each piece has " + std::to_string(own.parts.manifolds[part].stations) +
               " stations, not " + Decimal(row.quantity));
  }
}

void WarnOfMissingJoints(const optimizer::Design& design, const Problem& problem,
                         const std::string& pointer) {
  if (!HasJointRow(design) && !optimizer::JointsOf(problem, design.parts).empty())
    Warn(pointer + "/parts", Meet(problem) +
                                 ", and the design has no manifold or tee: what joins them is not "
                                 "counted");
}

}  // namespace plenum::api
