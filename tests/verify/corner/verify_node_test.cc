// What groups leave each other of the pressure behind a regulator, against the simulator.
#include "verify/corner/verify_node.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "model/flow/tube.h"
#include "model/simulate/simulate.h"
#include "tests/support/small_catalogue.h"
#include "verify/design/verify_families.h"

namespace plenum::test {
namespace verify_node_test {

struct Case {
  optimizer::Problem problem;
  std::vector<std::array<int, 3>> lines;  // tube, fitting, valve of each group
  double source_pa;
};

// Two groups that inflate at once, one of them larger.
Case Drawn(std::uint64_t seed) {
  Random random(seed);
  Case drawn{EasyProblem(seed, {optimizer::Configuration::kMains}), {}, 0.0};
  optimizer::ActuatorGroup other = drawn.problem.groups[0];
  other.name = "other";
  other.chamber.rest_volume_m3 *= Uniform(random, 0.5, 3.0);
  other.tube_length_m *= Uniform(random, 0.5, 2.0);
  drawn.problem.groups.push_back(other);
  drawn.problem.simultaneous = true;
  double operating_pa = 0.0;
  for (const auto& group : drawn.problem.groups) {
    drawn.lines.push_back({Pick(random, 0, 2), Pick(random, 0, 2), Pick(random, 0, 2)});
    operating_pa = std::max(operating_pa, group.chamber.operating_pressure_pa);
  }
  drawn.source_pa = operating_pa * Uniform(random, 1.02, 2.5);
  // A regulator that matters.
  model::FlowElement& regulator = drawn.problem.parts.regulators[0].flow;
  regulator.sonic_conductance_m3_per_s_pa *= LogUniform(random, 0.05, 1.0);
  return drawn;
}

// Rise times of both.
std::optional<std::vector<double>> Simulated(const Case& drawn) {
  const optimizer::Problem& problem = drawn.problem;
  model::Rig rig;
  rig.ambient = problem.ambient;
  rig.source = model::RegulatedSource{drawn.source_pa, problem.parts.regulators[0].flow};
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const auto& [tube, fitting, valve] = drawn.lines[g];
    model::GroupRig rig_group;
    rig_group.count = group.count;
    rig_group.chamber = group.chamber;
    const double bore_m = problem.parts.tubing[tube].inner_diameter_m;
    rig_group.chamber.dead_volume_m3 += model::BoreVolume(bore_m, group.tube_length_m);
    const model::FlowElement ends = problem.parts.fittings[fitting].flow;
    rig_group.fill = {problem.parts.valves[valve].fill, ends,
                      model::TubeElement(bore_m, group.tube_length_m), ends};
    rig_group.exhaust = rig_group.fill;
    rig_group.schedule = {{0.0, model::ValveState::kInflate}};
    rig_group.close_at_operating = true;
    rig_group.initial_pressure_pa = problem.ambient.pressure_pa;
    rig.groups.push_back(rig_group);
  }
  model::SimulateOptions options;
  options.end_s = 0.5 / problem.frequency_hz;
  options.rise_fraction = problem.rise_fraction;
  const model::Response response = model::Simulate(rig, options);
  EXPECT_EQ(response.status, model::SimulateStatus::kDone);
  std::vector<double> rise_s(problem.groups.size());
  for (const auto& stroke : response.strokes) {
    if (!std::isfinite(stroke.to_operating_s)) return std::nullopt;
    rise_s[stroke.group] = stroke.to_target_s;
  }
  return rise_s;
}

// None where a line by itself is no choice on any source.
std::optional<bool> TooSlow(Case drawn, const std::vector<double>& limits_s) {
  optimizer::Problem& problem = drawn.problem;
  for (std::size_t g = 0; g < limits_s.size(); ++g) problem.groups[g].rise_time_max_s = limits_s[g];
  verify::ProofPlan plan = verify::EmptyPlan(problem, {optimizer::Configuration::kMains});
  for (auto& slot : plan.slots) {
    if (slot.group < 0) {
      slot.choices = {{0, 1}};
      continue;
    }
    const std::array<int, 3>& line = drawn.lines[slot.group];
    slot.choices = {{slot.family == optimizer::Family::kTubing    ? line[0]
                     : slot.family == optimizer::Family::kFitting ? line[1]
                                                                  : line[2],
                     1}};
  }
  const verify::Ranges all(plan.slots.size(), {0, 1});
  std::vector<verify::BestLine> lines;
  lines.reserve(problem.groups.size());
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    lines.push_back(verify::BestOf(problem, plan, all, g));
    if (!lines.back().works) return std::nullopt;
    lines.back().least_means = verify::LeastMeans(problem, g, lines.back());
  }
  const double factor = model::FlowFactor(model::Gas::kAir) *
                        std::sqrt(model::kReferenceTemperatureK / problem.ambient.temperature_k);
  return verify::TooSlowTogether(problem,
                                 {problem.parts.regulators[0].flow, factor, drawn.source_pa,
                                  std::numeric_limits<double>::infinity()},
                                 {&lines[0], &lines[1]});
}

TEST(VerifyNodeTest, NothingThatIsInTimeIsTooSlow) {
  int in_time = 0, told = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Case drawn = Drawn(seed);
    const auto rise_s = Simulated(drawn);
    if (!rise_s) continue;
    const auto at_both = TooSlow(drawn, {(*rise_s)[0] * 1.0001, (*rise_s)[1] * 1.0001});
    if (!at_both) continue;
    ++in_time;
    EXPECT_FALSE(*at_both);
    EXPECT_FALSE(TooSlow(drawn, {(*rise_s)[0] * 1.0001, 1e3}).value_or(false));
    told += TooSlow(drawn, {(*rise_s)[0] * 0.7, (*rise_s)[1] * 0.7}).value_or(true) ? 1 : 0;
  }
  EXPECT_GT(in_time, 200);
  EXPECT_GT(told, in_time / 2) << "of those that take a third longer than they may";
}

}  // namespace verify_node_test
}  // namespace plenum::test
