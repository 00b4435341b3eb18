// The peak of a valve that closes late: physics.md 2.17, a second integrator, the simulator, and
// what dominance rests on.
#include "optimizer/evaluate/closing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/flow/scalar.h"
#include "model/flow/tube.h"
#include "optimizer/problem/part_tables.h"
#include "tests/support/late_closing.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace closing_test {

using model::FlowElement;
using optimizer::Closing;
using optimizer::Problem;

constexpr double kC = 1e-8;  // 1 dm³/(s·bar)

Problem OneActuator(double limit_pa) {
  Problem problem = EasyProblem(1, {optimizer::Configuration::kMains});
  optimizer::ActuatorGroup& group = problem.groups.front();
  group.chamber = {};
  group.chamber.rest_volume_m3 = 50e-6;
  group.chamber.expansion_ratio = 2.0;
  group.chamber.operating_pressure_pa = 2e5;
  group.chamber.ambient_pressure_pa = 1e5;
  group.pressure_max_pa = limit_pa;
  return problem;
}

TEST(Closing, GivesThePeaksOfTheOracle) {
  const Problem problem = OneActuator(2.05e5);
  const std::vector<FlowElement> fill{{0.3 * kC, 0.3}};
  const model::Chamber& chamber = problem.groups.front().chamber;
  constexpr double kOracle[][2] = {{5e-3, 102.850e3}, {10e-3, 105.651e3}, {20e-3, 111.115e3}};
  for (const auto& [late_s, peak_gauge_pa] : kOracle)
    EXPECT_NEAR(optimizer::PeakPa(problem, 0, 1.0, {fill, chamber, late_s}, 4e5) - 1e5,
                peak_gauge_pa, 1.0);
}

TEST(Closing, FindsTheSourceWhosePeakIsTheLimit) {
  const Problem problem = OneActuator(2.05e5);
  const std::vector<FlowElement> fill{{0.3 * kC, 0.3}};
  const Closing closing{fill, problem.groups.front().chamber, 10e-3};
  const double source_pa = optimizer::HighestSourcePa(problem, 0, 1.0, closing, 8e5, 1e-10).low;
  EXPECT_GT(source_pa, 3e5);
  EXPECT_LT(source_pa, 4e5);  // of which the oracle's peak is 105.651 kPa gauge
  EXPECT_NEAR(optimizer::PeakPa(problem, 0, 1.0, closing, source_pa), 2.05e5, 1e-4);
  // A weaker source, or one that cannot come to the limit, is as it is.
  EXPECT_EQ(optimizer::HighestSourcePa(problem, 0, 1.0, closing, 0.9 * source_pa, 1e-10).high,
            0.9 * source_pa);
  EXPECT_EQ(optimizer::HighestSourcePa(problem, 0, 1.0, closing, 2.04e5, 1e-10).high, 2.04e5);
}

// Lines of drawn elements, chambers, times and sources.
struct DrawnLine {
  std::vector<FlowElement> fill;
  double late_s, source_pa;
};

DrawnLine Draw(Random& random) {
  DrawnLine drawn;
  for (int i = Pick(random, 1, 4); i > 0; --i)
    drawn.fill.push_back({LogUniform(random, 0.05, 5.0) * kC, Uniform(random, 0.05, 0.6)});
  drawn.late_s = LogUniform(random, 1e-3, 5e-2);
  drawn.source_pa = Uniform(random, 2.01e5, 9e5);
  return drawn;
}

TEST(Closing, AgreesWithASecondIntegrator) {
  Random random(17);
  const Problem problem = OneActuator(2.05e5);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const DrawnLine drawn = Draw(random);
    const model::Chamber& chamber = problem.groups.front().chamber;
    const double peak_pa =
        optimizer::PeakPa(problem, 0, 1.0, {drawn.fill, chamber, drawn.late_s}, drawn.source_pa);
    const double integrated_pa =
        LatePeakPa({drawn.fill, chamber, drawn.late_s, 1.0, 293.15}, drawn.source_pa);
    EXPECT_NEAR(peak_pa, integrated_pa, 1e-5 * peak_pa);
  }
}

// What part_tables.h says of two valves in the same line.
TEST(Closing, IsNoHigherOfAValveThatLetsByNoMore) {
  Random random(18);
  const Problem problem = OneActuator(2.05e5);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    DrawnLine drawn = Draw(random);
    model::Valve a, b;
    a.kind = b.kind = model::ValveKind::kPair;
    b.fill = drawn.fill.front();
    a.fill = {b.fill.sonic_conductance_m3_per_s_pa * LogUniform(random, 1.0, 3.0),
              Uniform(random, b.fill.critical_ratio, 0.7)};
    b.closing_scatter_s = drawn.late_s;
    a.closing_scatter_s = drawn.late_s * LogUniform(random, 0.2, 1.0);
    if (optimizer::read::LetBy(a) > optimizer::read::LetBy(b)) continue;
    ++compared;
    const auto peak_pa = [&](const model::Valve& valve) {
      drawn.fill.front() = valve.fill;
      return optimizer::PeakPa(
          problem, 0, 1.0, {drawn.fill, problem.groups.front().chamber, valve.closing_scatter_s},
          drawn.source_pa);
    };
    const double high_pa = peak_pa(b);
    EXPECT_LE(peak_pa(a), high_pa * (1.0 + 1e-9)) << i;
  }
  EXPECT_GT(compared, 200);
}

}  // namespace closing_test
}  // namespace plenum::test
