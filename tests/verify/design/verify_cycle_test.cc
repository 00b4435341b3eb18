// The two ways of the verifier to a cycle, the simulator and the quadratures, against each other
// where it is hardest: a reservoir that falls to the operating pressure, so that pumps lift it
// together with the actuators and a pascal of lead is a millisecond of inflating.
#include "verify/design/cycle/verify_cycle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace verify_cycle_test {

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

// Others only empty the reservoir: in the simulated cycle of two groups no stroke is faster than by
// itself, and where the reservoir is large they hardly differ.
TEST(VerifyCycleTest, NoStrokeIsFasterBesideOthersThanAlone) {
  int compared = 0, close = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = EasyProblem(seed, {optimizer::Configuration::kCompressor});
    Random random(seed);
    problem.frequency_hz = LogUniform(random, 0.02, 0.5);
    problem.groups.push_back(problem.groups[0]);
    problem.groups[1].name = "other";
    problem.groups[1].count = Pick(random, 1, 4);
    const std::size_t valves = problem.parts.valves.size();
    verify::Assembly assembly;
    assembly.configuration = optimizer::Configuration::kCompressor;
    for (const std::uint64_t choice : {seed, seed / 3})
      assembly.lines.push_back({&problem.parts.tubing[0], &problem.parts.fittings[0],
                                &problem.parts.valves[choice % valves]});
    assembly.compressor = &problem.parts.compressors[seed % problem.parts.compressors.size()];
    assembly.compressors = 1;
    optimizer::Settings settings;
    settings.source_pressure_pa =
        problem.groups[0].chamber.operating_pressure_pa * Uniform(random, 1.02, 1.5);
    settings.reservoir_volume_m3 = LogUniform(random, 1e-4, 2e-2);
    if (settings.source_pressure_pa > model::HighestPressure(assembly.compressor->curve)) continue;
    const std::optional<Cycle> alone =
        verify::QuickCycles(problem, assembly).EachAlone(settings, *settings.reservoir_volume_m3);
    const std::optional<Cycle> together = SimulateCycle(problem, settings, assembly);
    ASSERT_TRUE(alone);
    if (!together) continue;
    for (int g = 0; g < 2; ++g) {
      if (!std::isfinite(together->rise_s[g])) continue;
      ++compared;
      EXPECT_LE(alone->rise_s[g], together->rise_s[g] * (1.0 + 1e-5));
      EXPECT_LE(alone->inflate_s[g], together->inflate_s[g] * (1.0 + 1e-5));
      close += alone->rise_s[g] > 0.95 * together->rise_s[g];
    }
  }
  EXPECT_GT(compared, 15);
  EXPECT_GT(close, compared / 3);
}

}  // namespace verify_cycle_test
}  // namespace plenum::test
