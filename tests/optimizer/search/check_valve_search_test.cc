// Pumps of each actuator that let air back, with check valves: against plain enumeration, beside
// pumps that need none, and before the verifier.
#include <gtest/gtest.h>

#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/pumps/direct_problems.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace check_valve_search_test {

using optimizer::Answer;
using optimizer::Choice;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Problem;

model::CheckValve RandomCheckValve(Random& random, int number) {
  model::CheckValve row;
  row.basics.id = "check valve " + std::to_string(number);
  row.basics.mass_kg = LogUniform(random, 1e-3, 3e-2);
  row.basics.body_volume_m3 = LogUniform(random, 1e-6, 3e-5);
  if (Chance(random, 0.7)) row.basics.cost_eur = Uniform(random, 1.0, 9.0);
  row.sonic_conductance_m3_per_s_pa = LogUniform(random, 1e-9, 5e-8);
  row.cracking_pressure_pa = Uniform(random, 0.0, 0.2) * kBar;
  row.pressure_max_pa = kAmbientPa + Uniform(random, 0.8, 4.0) * kBar;
  return row;
}

// Before check valves are fitted: of pumps that let air back their cracking pressure is 0.
Problem Raw(std::uint64_t seed, int groups = 1) {
  Problem problem = DirectPumpProblem(21000 + seed, 0.01 * static_cast<double>(seed % 10), groups);
  Random random(seed);
  for (model::Compressor& pump : problem.parts.compressors) {
    pump.curve.voltage_v = 12.0;
    if (Chance(random, 0.6)) pump.check_valve_cracking_pa = 0.0;
  }
  for (model::Battery& pack : problem.parts.batteries) pack.nominal_voltage_v = 11.1;
  for (model::Valve& valve : problem.parts.valves) {
    if (Chance(random, 0.8)) valve.kind = model::ValveKind::kPair;
    valve.pressure_min_pa = kAmbientPa;
  }
  for (int i = 0; i < 4; ++i) problem.parts.check_valves.push_back(RandomCheckValve(random, i));
  problem.limits.batteries = 2;
  return WithFeed(std::move(problem), optimizer::PumpFeed::kPerActuator);
}

Problem Drawn(std::uint64_t seed, int groups = 1) {
  Problem problem = Raw(seed, groups);
  FitCheckValves(problem, problem.parts);
  return problem;
}

const Choice* CheckValveOf(const Design& design) {
  for (const Choice& row : design.parts)
    if (row.family == Family::kCheckValve) return &row;
  return nullptr;
}

TEST(CheckValveSearch, ListsWhatEnumerationLists) {
  constexpr optimizer::Objective kObjectives[] = {
      {1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {1.0, 0.0, 0.0, 0.5}};
  int feasible = 0, with = 0, without = 0;
  for (int seed = 1; seed <= Draws(40); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Raw(seed, seed % 3 == 0 ? 2 : 1);
    problem.simultaneous = seed % 2 == 0;
    problem.objective = kObjectives[seed % 4];
    FitCheckValves(problem, problem.parts);
    if (problem.parts.compressors.empty()) continue;
    feasible += ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
      const Choice* row = CheckValveOf(design);
      ++(row ? with : without);
      if (!row) return;
      int actuators = 0;
      for (const optimizer::ActuatorGroup& group : problem.groups) actuators += group.count;
      EXPECT_EQ(row->quantity, actuators);
    });
  }
  EXPECT_GT(feasible, Draws(10));
  EXPECT_GT(with, Draws(10));
  EXPECT_GT(without, Draws(10));
}

TEST(CheckValveSearch, PumpsWorkAgainstItsCrackingPressure) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Problem raw = Raw(seed);
    const Problem fitted = Drawn(seed);
    for (const model::Compressor& pump : fitted.parts.compressors) {
      if (!pump.check_valve_cracking_pa) continue;
      const int part = optimizer::FindPart(raw.parts, Family::kCompressor, pump.basics.id);
      const model::CompressorCurve& alone = raw.parts.compressors[part].curve;
      const double by_pa = *pump.check_valve_cracking_pa;
      for (double share : {0.0, 0.2, 0.5, 0.9}) {
        const double pa = kAmbientPa + share * (alone.free_air_m3_per_s.back() - kAmbientPa);
        EXPECT_NEAR(model::FreeAirDelivery(pump.curve, pa - by_pa),
                    model::FreeAirDelivery(alone, pa), 1e-15);
        EXPECT_NEAR(model::ElectricalPower(pump.curve, pa - by_pa),
                    model::ElectricalPower(alone, pa), 1e-9);
      }
      EXPECT_NEAR(model::HighestPressure(pump.curve), model::HighestPressure(alone) - by_pa, 1e-6);
      ++looked_at;
    }
    Problem again = fitted;  // nothing is shifted twice
    FitCheckValves(again, again.parts);
    EXPECT_EQ(again.parts.compressors, fitted.parts.compressors);
  }
  EXPECT_GT(looked_at, 10);
}

double Best(Problem problem) {
  problem.count = 1;
  const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
  return answer.designs.empty() ? optimizer::kUnlimited : answer.designs[0].objective;
}

// One that weighs nothing and opens at once is none; one that weighs more, or opens later, is never
// better.
TEST(CheckValveSearch, Relations) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem raw = Raw(50 + seed);
    raw.parts.check_valves.resize(1);
    model::CheckValve& row = raw.parts.check_valves[0];
    row = {};
    row.basics.id = "nothing";
    row.sonic_conductance_m3_per_s_pa = 1.0;
    row.pressure_max_pa = kAmbientPa + 9.0 * kBar;
    for (model::Compressor& pump : raw.parts.compressors) pump.check_valve_cracking_pa = 0.0;
    Problem none = raw;
    for (model::Compressor& pump : none.parts.compressors) pump.check_valve_cracking_pa.reset();
    const auto best_with = [&](double mass_kg, double cracking_pa) {
      Problem problem = raw;
      problem.parts.check_valves[0].basics.mass_kg = mass_kg;
      problem.parts.check_valves[0].cracking_pressure_pa = cracking_pa;
      FitCheckValves(problem, problem.parts);
      return Best(problem);
    };
    const double least = Best(none);
    if (!std::isfinite(least)) continue;
    EXPECT_NEAR(best_with(0.0, 0.0), least, 1e-9 * least);
    const double heavier = best_with(0.01, 0.0);
    EXPECT_GE(heavier, least);
    EXPECT_GE(best_with(0.01, 0.1 * kBar), heavier * (1.0 - 1e-9));
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

TEST(CheckValveSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 40 && looked_at < 3; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(100 + seed);
    if (problem.parts.compressors.empty()) continue;
    const Answer answer = Recorded(problem);
    if (answer.designs.empty() || !CheckValveOf(answer.designs.front())) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    const auto on_row = [](const auto& change) {
      return [change](Design& design) {
        for (Choice& row : design.parts)
          if (row.family == Family::kCheckValve) change(row);
      };
    };
    EXPECT_TRUE(refused(on_row([](Choice& row) { row.quantity += 1; })));
    EXPECT_TRUE(refused(on_row([](Choice& row) { row.mass_kg *= 0.99; })));
    EXPECT_TRUE(refused(on_row([](Choice& row) { row.id = "another"; })));
    EXPECT_TRUE(refused([](Design& design) {
      std::erase_if(design.parts,
                    [](const Choice& row) { return row.family == Family::kCheckValve; });
    }));
    // As if the pumps had not been shifted.
    Problem unshifted = problem;
    for (model::Compressor& pump : unshifted.parts.compressors)
      if (pump.check_valve_cracking_pa) *pump.check_valve_cracking_pa += 1.0;
    EXPECT_FALSE(Accepts(unshifted, answer));
    ++looked_at;
  }
  EXPECT_GE(looked_at, 2);
}

}  // namespace check_valve_search_test
}  // namespace plenum::test
