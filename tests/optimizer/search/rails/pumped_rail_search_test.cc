// Vacuum pumps beside a pressure supply, in the search: against plain enumeration, against looser
// problems, before the verifier, and by the balance of mass of their reservoirs.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/strokes/stroke.h"
#include "optimizer/evaluate/pumped_rail.h"
#include "optimizer/problem/family_specs.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/packs/packs_by_hand.h"
#include "tests/support/rail_problems.h"

namespace plenum::test {
namespace pumped_rail_search_test {

using optimizer::Answer;
using optimizer::Choice;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Problem;

constexpr Configuration kAll[] = {Configuration::kCylinder, Configuration::kCo2,
                                  Configuration::kMains};

Problem Drawn(std::uint64_t seed, int groups = 1, bool simultaneous = true) {
  Draw draw;
  draw.seed = 61000 + seed;
  draw.configurations = groups == 1 ? std::set<Configuration>{kAll[seed % 3]}
                                    : std::set<Configuration>{kAll[seed % 3], kAll[(seed + 1) % 3]};
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = groups == 1 || simultaneous;
  draw.size = groups == 1 ? CatalogueSize{2, 2, 3, 2, 2, 2, 3, 2, 3}
                          : CatalogueSize{2, 1, 2, 2, 1, 1, 2, 2, 2};
  return PumpedRailProblem(draw);
}

// The rise of the reservoirs by the air that actuators and tubes hand over, and the pumps' time by
// small steps of pressure.
void ExpectBalanced(const Problem& problem, const Design& design) {
  ASSERT_TRUE(design.settings.rail);
  const optimizer::RailSettings& rail = *design.settings.rail;
  const auto row = [&](Family family, int group) {
    return *std::find_if(design.parts.begin(), design.parts.end(), [&](const Choice& one) {
      return one.family == family && one.group == group;
    });
  };
  const auto index = [&](const Choice& one) { return FindPart(problem.parts, one.family, one.id); };
  double handed_pa_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const model::Chamber& chamber = group.chamber;
    if (!(chamber.low_pressure_pa > 0.0)) continue;
    EXPECT_LE(rail.pressure_pa, chamber.low_pressure_pa * (1.0 + 1e-9));
    const double bore_m = problem.parts.tubing[index(row(Family::kTubing, g))].inner_diameter_m;
    const auto content = [&](double pa) {
      const double x = (pa - kAmbientPa) / (chamber.operating_pressure_pa - kAmbientPa);
      return pa * (chamber.rest_volume_m3 * (1.0 + (chamber.expansion_ratio - 1.0) * x) +
                   M_PI / 4.0 * bore_m * bore_m * group.tube_length_m);
    };
    handed_pa_m3 += group.count * group.gait.strokes_per_period *
                    (content(chamber.operating_pressure_pa) - content(chamber.low_pressure_pa));
  }
  EXPECT_NEAR(rail.volume_m3 * (rail.pressure_pa - rail.stop_pa), handed_pa_m3,
              1e-9 * handed_pa_m3);
  const Choice pumps = row(Family::kVacuumPump, -1);
  const model::Compressor& pump = problem.parts.vacuum_pumps[index(pumps)];
  const double m3_per_pa = rail.volume_m3 / 1e5 * (293.15 / problem.ambient.temperature_k);
  constexpr int kSteps = 20000;
  const double step_pa = (rail.pressure_pa - rail.stop_pa) / kSteps;
  double on_s = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double image_pa = 2.0 * kAmbientPa - rail.pressure_pa + (i + 0.5) * step_pa;
    on_s += m3_per_pa * step_pa / (pumps.quantity * FreeAirDelivery(pump.curve, image_pa));
  }
  EXPECT_NEAR(rail.duty, on_s * problem.frequency_hz, 1e-4 * rail.duty);
  EXPECT_LE(rail.duty, pump.duty_max * (1.0 + 1e-6));
  EXPECT_GE(rail.stop_pa, problem.rail_floor_pa * (1.0 - 1e-9));
}

void Compare(const Problem& problem, Compared& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
    ++tally.designs;
    ExpectBalanced(problem, design);
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(PumpedRailSearch, ListsWhatEnumerationLists) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed), tally);
  }
  EXPECT_GT(tally.feasible, 15);
  EXPECT_GT(tally.infeasible, 3);
  EXPECT_GT(tally.designs, 80);
}

TEST(PumpedRailSearch, GroupsAtOnceAndOneAfterAnother) {
  Compared tally;
  for (int seed = 1; seed <= Draws(16); ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(300 + seed, 2, seed % 2 == 0), tally);
  }
  EXPECT_GT(tally.feasible, Draws(3));
}

TEST(PumpedRailSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.5}};
  Compared tally;
  for (int seed = 1; seed <= Draws(24); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed);
    problem.objective = kObjectives[seed % 4];
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(5));
}

// Cost counts whole packs of pumps and reservoirs as of all else.
TEST(PumpedRailSearch, PumpsAndReservoirsInPacks) {
  Compared tally;
  int packs = 0;
  for (int seed = 1; seed <= Draws(24); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(1200 + seed);
    problem.objective = {seed % 2 == 0 ? 1.0 : 0.0, 0.0, seed % 2 == 0 ? 0.02 : 1.0, 0.0};
    SellInPacks(static_cast<std::uint64_t>(seed), false, problem);
    const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
      for (const optimizer::PackRow& row : design.packs)
        packs += row.family == Family::kVacuumPump || row.family == Family::kVacuumReservoir;
    });
    ++(found ? tally.feasible : tally.infeasible);
  }
  EXPECT_GT(tally.feasible, Draws(5));
  EXPECT_GT(packs, Draws(10));
}

TEST(PumpedRailSearch, ListsOfKinds) {
  Compared tally;
  for (int seed = 1; seed <= Draws(12); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(800 + seed);
    problem.list = optimizer::ListOf::kKinds;
    problem.count = 3;
    const Answer answer = Recorded(problem);
    EXPECT_EQ(answer.proof.undecided, 0);
    ExpectVerified(problem, answer);
    ++(answer.designs.empty() ? tally.infeasible : tally.feasible);
  }
  EXPECT_GT(tally.feasible, Draws(3));
}

TEST(PumpedRailSearch, EachGroupBehindItsOwnRegulator) {
  Compared tally;
  for (int seed = 1; seed <= Draws(6); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(1000 + seed, 2, true);
    problem.regulation = optimizer::Regulation::kPerGroup;
    const Answer answer = Recorded(problem);
    EXPECT_EQ(answer.proof.undecided, 0);
    ExpectVerified(problem, answer);
    ++(answer.designs.empty() ? tally.infeasible : tally.feasible);
  }
  EXPECT_GT(tally.feasible, 0);
}

// A deeper vacuum allowed, more time, pumps that may run longer, larger packs, more reservoirs.
TEST(PumpedRailSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (int seed = 1; seed <= Draws(48); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(700 + seed, 1 + seed % 2, false);
    problem.count = 1;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(5, problem);
    optimizer::SetRailFloor(std::max(model::kDeepestVacuumPa, problem.rail_floor_pa - 10e3),
                            looser[0]);
    for (optimizer::ActuatorGroup& group : looser[1].groups) group.fall_time_max_s *= 1.3;
    for (model::Compressor& pump : looser[2].parts.vacuum_pumps)
      pump.duty_max = std::min(1.0, 1.2 * pump.duty_max);
    for (model::Battery& battery : looser[3].parts.batteries) battery.capacity_ah *= 1.2;
    looser[4].limits.reservoirs += 1;
    ExpectNeverWorse(answer, looser);
    ++compared;
  }
  EXPECT_GT(compared, Draws(5));
}

TEST(PumpedRailSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int refused = 0;
  for (int seed = 1; seed <= 30 && refused < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(900 + seed);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    EXPECT_TRUE(Accepts(problem, answer));
    const auto refuses = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    EXPECT_TRUE(refuses([](Design& d) { d.performance.groups[0].fall_time_s *= 0.99; }));
    EXPECT_TRUE(refuses([](Design& d) { d.settings.rail->stop_pa *= 0.99; }));
    EXPECT_TRUE(refuses([](Design& d) { d.settings.rail->pressure_pa *= 1.02; }));
    EXPECT_TRUE(refuses([](Design& d) { d.settings.rail->duty *= 0.98; }));
    EXPECT_TRUE(refuses([](Design& d) { d.settings.rail->volume_m3 *= 1.01; }));
    EXPECT_TRUE(refuses([](Design& d) { d.settings.rail.reset(); }));
    EXPECT_TRUE(refuses([](Design& d) { d.totals.energy_j *= 0.98; }));
    EXPECT_TRUE(refuses([](Design& d) {
      std::erase_if(d.parts, [](const Choice& row) { return row.family == Family::kVacuumPump; });
    }));
    Problem other = problem;
    for (model::Compressor& pump : other.parts.vacuum_pumps) pump.duty_max *= 0.2;
    if (answer.designs.front().settings.rail->duty > other.parts.vacuum_pumps.front().duty_max) {
      EXPECT_FALSE(Accepts(other, answer));
    }
    ++refused;
  }
  EXPECT_EQ(refused, 4);
}

}  // namespace pumped_rail_search_test
}  // namespace plenum::test
