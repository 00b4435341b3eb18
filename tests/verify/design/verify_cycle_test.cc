// The two ways of the verifier to a cycle, the simulator and the quadratures, against each other
// where it is hardest: a reservoir that falls to the operating pressure, so that pumps lift it
// together with the actuators and a pascal of lead is a millisecond of inflating.
#include "verify/design/cycle/verify_cycle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace {

using optimizer::Problem;
using verify::Cycle;

TEST(VerifyCycleTest, SimulatorAndQuadraturesAgreeOnSlowEndsOfStrokes) {
  constexpr double kAgree = 2e-5;  // a fifth of what verify allows
  int slow = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = EasyProblem(seed, {optimizer::Configuration::kCompressor});
    problem.frequency_hz = 0.005;
    Random random(seed);
    const double operating_pa = problem.groups[0].chamber.operating_pressure_pa;
    verify::Assembly assembly;
    assembly.configuration = optimizer::Configuration::kCompressor;
    assembly.lines = {{&problem.parts.tubing[0], &problem.parts.fittings[0],
                       &problem.parts.valves[seed % problem.parts.valves.size()]}};
    assembly.compressor = &problem.parts.compressors[seed % problem.parts.compressors.size()];
    assembly.compressors = 1;
    optimizer::Settings settings;
    settings.source_pressure_pa = operating_pa * (1.0 + LogUniform(random, 2e-3, 0.1));
    settings.reservoir_volume_m3 = LogUniform(random, 1e-4, 2e-2);
    if (settings.source_pressure_pa > model::HighestPressure(assembly.compressor->curve)) continue;
    const std::optional<Cycle> quick =
        verify::QuickCycles(problem, assembly).At(settings, *settings.reservoir_volume_m3);
    // Longer than half of the period the stroke is cut short in one and not in the other.
    if (!quick || !(quick->inflate_s[0] < 0.4 / problem.frequency_hz)) continue;
    if (quick->pump_on_s > 0.9 / problem.frequency_hz) continue;
    const std::optional<Cycle> simulated = SimulateCycle(problem, settings, assembly);
    ASSERT_TRUE(simulated);
    EXPECT_NEAR(simulated->rise_s[0] / quick->rise_s[0], 1.0, kAgree);
    EXPECT_NEAR(simulated->inflate_s[0] / quick->inflate_s[0], 1.0, kAgree);
    slow += quick->inflate_s[0] > 3.0 * quick->rise_s[0];
  }
  EXPECT_GE(slow, 5);
}

}  // namespace
}  // namespace plenum::test
