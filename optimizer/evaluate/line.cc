#include "optimizer/evaluate/line.h"

#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {

namespace {

constexpr double kDiameterToleranceM = 0.05e-3;

}  // namespace

bool DiametersMate(double tube_outer_m, double fitting_outer_m) {
  return std::abs(tube_outer_m - fitting_outer_m) <= kDiameterToleranceM;
}

bool PartsMate(const Problem& problem, int tubing, int fitting, int valve) {
  if (fitting < 0) return true;
  const model::Fitting& part = problem.parts.fittings[fitting];
  return DiametersMate(problem.parts.tubing[tubing].outer_diameter_m, part.tube_outer_diameter_m) &&
         part.thread == problem.parts.valves[valve].port;
}

Amounts operator*(double quantity, const model::PartBasics& basics) {
  return {quantity * basics.mass_kg, quantity * basics.body_volume_m3,
          quantity * basics.cost_eur.value_or(0.0), quantity * basics.mass_slack_kg,
          quantity * basics.body_volume_slack_m3};
}

Amounts Bought(double quantity, const model::PartBasics& basics) {
  Amounts amounts = quantity * basics;
  amounts.cost_eur = PackCost(quantity, basics);
  return amounts;
}

Amounts JointAmounts(const Problem& problem, const std::optional<Joint>& joint) {
  if (!joint) return {};
  return joint->quantity * BasicsOf(problem.parts, joint->family, joint->part);
}

Amounts LineJointShare(const Problem& problem, int group, bool own_regulators) {
  if (problem.pump_feed == PumpFeed::kPerActuator) return {};  // in SourceJoint
  if (own_regulators || problem.pump_feed == PumpFeed::kPerGroup)
    return JointAmounts(problem, JointOfLines(problem, group));
  const Amounts all = JointAmounts(problem, JointOfLines(problem));
  const double share = static_cast<double>(problem.groups[group].count) / LineCount(problem);
  return {share * all.mass_kg, share * all.volume_m3, share * all.cost_eur,
          share * all.mass_slack_kg, share * all.volume_slack_m3};
}

std::vector<Joint> SourceJoints(const Problem& problem, Family family, int part, int quantity,
                                bool own_regulators) {
  const bool source = SpecOf(family).kind_role == KindRole::kSource;
  if (problem.pump_feed != PumpFeed::kShared && source)
    return JointsOfFeeds(problem, family, part, quantity);
  std::vector<Joint> joints;
  if (const auto joint = JointOfPieces(problem, family, part, quantity)) joints.push_back(*joint);
  if (own_regulators && source)
    if (const auto joint = JointOfOwnRegulators(problem, family, part)) joints.push_back(*joint);
  return joints;
}

Amounts SourceJoint(const Problem& problem, Family family, int part, int quantity,
                    bool own_regulators) {
  Amounts amounts;
  for (const Joint& joint : SourceJoints(problem, family, part, quantity, own_regulators))
    amounts += JointAmounts(problem, joint);
  return amounts;
}

Amounts OwnRegulatorJointAtMains(const Problem& problem, Configuration configuration, int group) {
  if (configuration != Configuration::kMains || group != 0) return {};
  return JointAmounts(problem, JointOfOwnRegulators(problem, Family::kRegulator, 0));
}

double FlowFactor(const Problem& problem, model::Gas gas) {
  return model::FlowFactor(gas) *
         std::sqrt(model::kReferenceTemperatureK / problem.ambient.temperature_k);
}

double CoilSeconds(const Problem& problem, int group, bool holds) {
  const double window_s = holds ? DeflateWindow(problem, group) : InflateWindow(problem, group);
  return problem.groups[group].gait.strokes_per_period * window_s +
         (holds ? HeldOpenSeconds(problem, group) : 0.0);
}

double CoilSeconds(const Problem& problem, int group, const Line& line) {
  if (line.holds == line.all_hold) return CoilSeconds(problem, group, line.holds);
  return std::min(CoilSeconds(problem, group, false), CoilSeconds(problem, group, true));
}

double LeastCoilSeconds(const Problem& problem) {
  double least_s = kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    least_s = std::min({least_s, CoilSeconds(problem, g, false), CoilSeconds(problem, g, true)});
  return least_s;
}

template <class T>
T AirPerStroke(const Problem& problem, int group, const Line& line, const T& filled_pa) {
  const double value_pa = model::ValueOf(filled_pa);
  const T full = model::Chain(filled_pa, model::Content(line.chamber, value_pa),
                              model::ContentSlope(line.chamber, value_pa));
  const T content = full - model::Content(line.chamber, model::RestPa(line.chamber));
  return static_cast<double>(problem.groups[group].count) * content *
         model::StandardVolume(1.0, problem.ambient.temperature_k);
}

double LeastAirPerStroke(const Problem& problem, int group, const Line& line) {
  return AirPerStroke(problem, group, line, line.chamber.operating_pressure_pa);
}

template double AirPerStroke(const Problem&, int, const Line&, const double&);
template model::Dual AirPerStroke(const Problem&, int, const Line&, const model::Dual&);

}  // namespace plenum::optimizer
