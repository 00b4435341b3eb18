#include "api/design/read/joint_rows.h"

#include <algorithm>

#include "api/json/remarks.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"
#include "optimizer/problem/pump_feed.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

using optimizer::Family;
using optimizer::Joint;
using optimizer::Problem;

// Among the parts of a design, or the joints that it needs.
bool HasFamily(const auto& rows, Family family) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const auto& row) { return row.family == family; });
}

std::string WhyNoCheckValve(const Problem& problem, const std::string& id) {
  if (problem.pump_feed != optimizer::PumpFeed::kPerActuator)
    return " keeps nothing here: check valves are for pumps of each actuator (supply.pumps)";
  return optimizer::FindPart(problem.parts, Family::kCheckValve, id) < 0
             ? " cannot be counted: its row does not say its mass, volume, conductance, cracking "
               "pressure and pressure"
             : " keeps nothing here: the pumps let no air back, or another row is lighter, or it "
               "does not stand the pressure or passes less than is asked";
}

// Whether the row is a pump of the problem that needs a check valve behind it.
bool NeedsCheckValve(const optimizer::Choice& row, const Problem& problem) {
  if (!optimizer::IsPump(row.family)) return false;
  const int part = optimizer::FindPart(problem.parts, row.family, row.id);
  return part >= 0 &&
         optimizer::PumpsIn(problem.parts, row.family)[part].check_valve_cracking_pa.has_value();
}

// Each feed of pumps that let air back has a check valve, and no other has. `own`: with the parts
// of the design alone.
void CheckCheckValves(const optimizer::Design& design, const Problem& problem, const Problem& own,
                      const std::vector<Joint>& needed, const FailRow& fail) {
  const auto joint = std::find_if(needed.begin(), needed.end(), [](const Joint& one) {
    return one.family == Family::kCheckValve;
  });
  const std::string feeds = std::to_string(optimizer::FeedsOf(problem));
  for (std::size_t i = 0; i < design.parts.size(); ++i) {
    const optimizer::Choice& row = design.parts[i];
    if (NeedsCheckValve(row, problem) && !HasFamily(design.parts, Family::kCheckValve))
      fail(i, "/id",
           Quoted(row.id) +
               " lets air back while it is off (check_valve: no), and the design has "
               "no check_valve: it needs " +
               feeds + ", one for each actuator");
    if (row.family != Family::kCheckValve) continue;
    if (joint == needed.end() || joint->part != optimizer::FindPart(own.parts, row.family, row.id))
      fail(i, "/id", Quoted(row.id) + WhyNoCheckValve(own, row.id));
    else if (joint->quantity != row.quantity)
      fail(i, "/quantity",
           "must be " + feeds + ", one for each actuator, not " + Decimal(row.quantity));
  }
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
  const model::Manifold& row = problem.parts.manifolds[joint->part];
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
  CheckCheckValves(design, problem, own, needed, fail);
  for (std::size_t i = 0; i < design.parts.size(); ++i) {
    const optimizer::Choice& row = design.parts[i];
    if (row.family != Family::kManifold) continue;
    const int part = optimizer::FindPart(own.parts, row.family, row.id);
    const auto joint = std::find_if(needed.begin(), needed.end(), [&](const Joint& candidate) {
      return candidate.family == row.family && candidate.part == part;
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
  if (HasFamily(design.parts, Family::kManifold)) return;
  if (HasFamily(optimizer::JointsOf(problem, design.parts), Family::kManifold))
    Warn(pointer + "/parts", Meet(problem) +
                                 ", and the design has no manifold or tee: what joins them is not "
                                 "counted");
}

}  // namespace plenum::api
