// Sizing against dense scans, and evaluation against a simulator that shares no code with it.
#include "optimizer/sizing/sizing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "tests/support/brute_force.h"
#include "tests/support/mass_form.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace sizing_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Evaluation;
using optimizer::Leaf;
using optimizer::LeafStatus;
using optimizer::OperatingPoint;
using optimizer::Problem;

bool Meets(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
           const Evaluation& evaluation) {
  return evaluation.works && optimizer::StrokeExcess(problem, evaluation) <= 0.0 &&
         optimizer::SupplyMargin(problem, candidate, point, evaluation) >= 0.0;
}

// Whether any of `points` source pressures meets all, and the lowest objective among those.
struct Scan {
  bool feasible = false;
  double objective = optimizer::kUnlimited;
};
Scan ScanPressures(const Problem& problem, const Candidate& candidate, double volume_m3,
                   int points) {
  Scan scan;
  const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
  if (window.empty()) return scan;
  for (int i = 0; i <= points; ++i) {
    const OperatingPoint point{window.low_pa + (window.high_pa - window.low_pa) * i / points,
                               volume_m3, volume_m3};
    const Evaluation evaluation = optimizer::Evaluate(problem, candidate, point);
    if (!Meets(problem, candidate, point, evaluation)) continue;
    scan.feasible = true;
    scan.objective =
        std::min(scan.objective, optimizer::ObjectiveValue(problem, candidate, point, evaluation));
  }
  return scan;
}

Problem Drawn(std::uint64_t seed, Configuration configuration) {
  Draw draw;
  draw.seed = 7000 + seed;
  draw.configurations = {configuration};
  draw.severity = 0.1 * static_cast<double>(seed % 8);
  draw.size = {2, 2, 3, 2, 2, 2, 2, 2, 2};
  return RandomProblem(draw);
}

TEST(SizeAtVolumeTest, VerdictAgreesWithADenseScan) {
  Random random(1);
  int feasible = 0, infeasible = 0, undecided = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
    for (int c = 0; c < optimizer::kConfigurations; ++c) {
      // Without a setting there is nothing to scan.
      if (static_cast<Configuration>(c) == Configuration::kDirectPump) continue;
      Problem problem = Drawn(seed, static_cast<Configuration>(c));
      if (seed % 3 == 0) problem.objective = {0.0, 0.0, 0.0, 1.0};
      ForEachCombination(problem, [&](const Candidate& candidate) {
        const bool pump = candidate.compressor.index != optimizer::kNone;
        if (candidate.reservoir.index == optimizer::kCustom || !Chance(random, pump ? 0.05 : 0.1))
          return;
        const double volume_m3 = StockVolume(problem, candidate);
        const Leaf leaf = optimizer::SizeAtVolume(problem, candidate, volume_m3);
        const Scan scan = ScanPressures(problem, candidate, volume_m3, 400);
        if (scan.feasible) {
          EXPECT_EQ(leaf.status, LeafStatus::kFeasible) << "seed " << seed << " " << c;
          EXPECT_LE(leaf.lower_bound, scan.objective * (1.0 + 1e-9));
        }
        feasible += leaf.status == LeafStatus::kFeasible;
        infeasible += leaf.status == LeafStatus::kInfeasible;
        undecided += leaf.status == LeafStatus::kUndecided;
        if (leaf.status != LeafStatus::kFeasible) return;
        const Evaluation evaluation = optimizer::Evaluate(problem, candidate, leaf.point);
        EXPECT_TRUE(Meets(problem, candidate, leaf.point, evaluation));
        EXPECT_LE(leaf.lower_bound, leaf.objective);
      });
    }
  EXPECT_GT(feasible, 50);
  EXPECT_GT(infeasible, 30);
  EXPECT_LT(undecided, (feasible + infeasible) / 10);
}

// Least energy where it may have several local minima over the stop pressure.
TEST(SizeAtVolumeTest, FindsTheLeastEnergyOfPumpsWhosePowerFalls) {
  int compared = 0, above_least = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Random random(seed);
    Draw draw;
    draw.seed = 7100 + seed;
    draw.configurations = {Configuration::kCompressor};
    draw.groups = seed % 8 == 0 ? 2 : 1;
    draw.simultaneous = false;
    draw.severity = 0.05 * static_cast<double>(seed % 6);
    draw.size = {1, 1, 2, 0, 0, 0, 2, 2, 2};
    Problem problem = RandomProblem(draw);
    problem.objective = {0.0, 0.0, 0.0, 1.0};
    for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
    int here = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.reservoir.index == optimizer::kCustom || here >= draw.groups % 2 + 1 ||
          !Chance(random, 0.3))
        return;
      const double volume_m3 = StockVolume(problem, candidate);
      const Leaf leaf = optimizer::SizeAtVolume(problem, candidate, volume_m3);
      const Scan scan = ScanPressures(problem, candidate, volume_m3, 300);
      EXPECT_NE(leaf.status, LeafStatus::kUndecided) << "seed " << seed;
      EXPECT_TRUE(leaf.status == LeafStatus::kFeasible || !scan.feasible) << "seed " << seed;
      if (leaf.status != LeafStatus::kFeasible) return;
      EXPECT_LE(leaf.objective, scan.objective * (1.0 + 5e-7)) << "seed " << seed;
      EXPECT_GE(leaf.lower_bound, leaf.objective * (1.0 - 5e-7)) << "seed " << seed;
      const optimizer::NeededPressure needed =
          optimizer::NeededSourcePressure(problem, candidate, {0.0, volume_m3, volume_m3});
      above_least += leaf.point.source_pa > 1.001 * needed.source_pa;
      ++here;
      ++compared;
    });
  }
  EXPECT_GT(compared, 20);
  EXPECT_GT(above_least, 5);
}

TEST(CustomSizingTest, NoSmallerVolumeIsFeasible) {
  int found = 0, rising = 0;
  for (std::uint64_t seed = 1; seed <= 12 && found < 9; ++seed) {
    Problem problem = EasyProblem(300 + seed, {Configuration::kCompressor});
    problem.groups[0].rise_time_max_s = 0.4;
    problem.groups[0].chamber.rest_volume_m3 = 60e-6;
    problem.groups[0].count = 4;
    problem.parts.reservoirs.clear();
    problem.parts.compressors.resize(1);
    problem.parts.batteries.resize(1);
    problem.parts.valves.resize(2);
    problem.parts.fittings.resize(1);
    problem.limits = {1, 2, 1, 1, 1};
    int here = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (here >= 1) return;
      const Leaf leaf = SizeAlone(problem, candidate);
      if (leaf.status != LeafStatus::kFeasible) return;
      const double volume_m3 = leaf.point.reservoir_m3;
      if (volume_m3 < 1.5 * 10e-6) return;  // the smallest there is
      ++here;
      ++found;
      EXPECT_TRUE(Meets(problem, candidate, leaf.point,
                        optimizer::Evaluate(problem, candidate, leaf.point)));
      EXPECT_LE(leaf.lower_bound, leaf.objective);
      // Where a pump takes less energy per air at higher pressure, what the battery must bear is
      // not known to grow with it, and an interval that only the battery rules out stays open.
      if (optimizer::PumpEnergyRises(problem, candidate)) {
        ++rising;
        EXPECT_GE(leaf.lower_bound, leaf.objective * (1.0 - 1.1e-7));
      }
      std::vector<double> smaller{volume_m3 * (1.0 - 1e-5), volume_m3 * (1.0 - 1e-4)};
      for (int i = 0; i < 20; ++i)
        smaller.push_back(10e-6 * std::pow(volume_m3 * 0.999 / 10e-6, i / 19.0));
      for (double v : smaller)
        EXPECT_FALSE(ScanPressures(problem, candidate, v, 50).feasible)
            << "seed " << seed << ": " << v << " m³ works, " << volume_m3 << " was reported";
    });
  }
  EXPECT_GE(rising, 3);
}

std::vector<MassElement> Elements(const std::vector<model::FlowElement>& elements) {
  std::vector<MassElement> result;
  result.reserve(elements.size());
  for (const model::FlowElement& e : elements)
    result.push_back({e.sonic_conductance_m3_per_s_pa, e.critical_ratio, e.subsonic_index, 0.0});
  return result;
}

// First stroke of a candidate of one group, from a full reservoir.
MassRig RigOf(const Problem& problem, const Candidate& candidate, const OperatingPoint& point) {
  MassRig rig;
  rig.temperature_k = problem.ambient.temperature_k;
  rig.gas_factor = candidate.configuration == Configuration::kCo2 ? 0.79 : 1.0;
  rig.linear_ratio = 0.99999;
  rig.source_pa = point.source_pa;
  const model::Chamber& chamber = candidate.lines[0]->chamber;
  MassGroup group;
  group.count = problem.groups[0].count;
  group.operating_pa = chamber.operating_pressure_pa;
  group.volume_m3 = [chamber](double p) {
    const double x = (p - chamber.ambient_pressure_pa) /
                     (chamber.operating_pressure_pa - chamber.ambient_pressure_pa);
    return chamber.rest_volume_m3 * (1.0 + (chamber.expansion_ratio - 1.0) * x) +
           chamber.dead_volume_m3;
  };
  group.fill = Elements(candidate.lines[0]->fill);
  group.schedule = {{0.0, 1}};
  group.close_at_operating = candidate.lines[0]->holds;
  rig.groups.push_back(group);
  if (candidate.regulator.index != optimizer::kNone) {
    const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
    rig.source = MassRig::Source::kRegulated;
    rig.regulator = Elements({regulator.flow});
    rig.flow_max_m3_per_s = regulator.flow_max_m3_per_s;
    return rig;
  }
  const model::CompressorCurve& curve = problem.parts.compressors[candidate.compressor.index].curve;
  rig.source = MassRig::Source::kReservoir;
  rig.reservoir_m3 = point.reservoir_m3;
  rig.stop_pa = point.source_pa;
  for (int i = 0; i <= 200; ++i) {
    const double p = 1e5 + (curve.free_air_m3_per_s.back() - 1e5) * i / 200.0;
    rig.delivery.emplace_back(p, candidate.compressor.quantity * curve.free_air_m3_per_s(p));
  }
  return rig;
}

double FirstAt(const MassResult& result, double pressure_pa) {
  const std::vector<double>& p = result.pressure_pa[0];
  for (std::size_t i = 1; i < p.size(); ++i)
    if (p[i] >= pressure_pa)
      return result.t_s[i - 1] +
             (result.t_s[i] - result.t_s[i - 1]) * (pressure_pa - p[i - 1]) / (p[i] - p[i - 1]);
  return optimizer::kUnlimited;
}

// Fall by the masses of the actuator alone.
double FallByMasses(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    double about_s) {
  MassRig rig = RigOf(problem, candidate, point);
  rig.source = MassRig::Source::kNone;
  MassGroup& group = rig.groups[0];
  group.exhaust = Elements(candidate.lines[0]->exhaust);
  group.initial_pa = group.operating_pa;
  group.schedule = {{0.0, -1}};
  const MassResult result = SimulateMasses(rig, 1.5 * about_s, about_s / 500.0, about_s / 500.0);
  const double target_pa = 1e5 + problem.fall_fraction * (group.operating_pa - 1e5);
  const std::vector<double>& p = result.pressure_pa[0];
  for (std::size_t i = 1; i < p.size(); ++i)
    if (p[i] <= target_pa)
      return result.t_s[i - 1] +
             (result.t_s[i] - result.t_s[i - 1]) * (p[i - 1] - target_pa) / (p[i - 1] - p[i]);
  return optimizer::kUnlimited;
}

class EvaluateTest : public testing::TestWithParam<Configuration> {};

TEST_P(EvaluateTest, SizedDesignsRiseAndFallAsTheMassesSay) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Problem problem = EasyProblem(400 + seed, {GetParam()});
    problem.groups[0].rise_time_max_s = 0.15 * static_cast<double>(seed);
    int here = 0;
    Random random(seed);
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (here >= 2 || candidate.reservoir.index == optimizer::kCustom || !Chance(random, 0.1))
        return;
      const Leaf leaf =
          optimizer::SizeAtVolume(problem, candidate, StockVolume(problem, candidate));
      if (leaf.status != LeafStatus::kFeasible) return;
      const Evaluation evaluation = optimizer::Evaluate(problem, candidate, leaf.point);
      // The masses start from a full reservoir, as a cycle does in which the pumps can rest.
      if (evaluation.compressor_duty > 0.95) return;
      const optimizer::GroupPerformance& group = evaluation.groups[0];
      const double step_s = group.rise_time_s / 500.0;
      const MassResult masses = SimulateMasses(RigOf(problem, candidate, leaf.point),
                                               1.2 * group.rise_time_s, step_s, step_s);
      const double target_pa =
          1e5 + problem.rise_fraction * (problem.groups[0].chamber.operating_pressure_pa - 1e5);
      EXPECT_NEAR(FirstAt(masses, target_pa), group.rise_time_s, 0.005 * group.rise_time_s);
      EXPECT_NEAR(FallByMasses(problem, candidate, leaf.point, group.fall_time_s),
                  group.fall_time_s, 0.005 * group.fall_time_s);
      ++here;
      ++compared;
    });
  }
  EXPECT_GE(compared, 6);
}

INSTANTIATE_TEST_SUITE_P(Configurations, EvaluateTest,
                         testing::Values(Configuration::kCylinder, Configuration::kCo2,
                                         Configuration::kCompressor),
                         [](const auto& test) { return optimizer::Name(test.param); });

// The quick ways and the simulator answer the same question.
void ExpectSame(const Problem& problem, const Candidate& candidate, const OperatingPoint& point) {
  const optimizer::Strokes quick = optimizer::EvaluateStrokes(problem, candidate, point);
  const optimizer::Strokes slow = optimizer::SimulateStrokes(problem, candidate, point);
  ASSERT_TRUE(quick.works);
  ASSERT_TRUE(slow.works);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    EXPECT_GT(slow.rise_s[g], 0.0) << "group " << g;
    EXPECT_NEAR(slow.rise_s[g], quick.rise_s[g], 1e-4 * quick.rise_s[g]) << "group " << g;
    EXPECT_NEAR(slow.inflate_s[g], quick.inflate_s[g], 1e-4 * quick.inflate_s[g]) << "group " << g;
  }
  EXPECT_NEAR(slow.pump_on_s, quick.pump_on_s, 1e-4 * quick.pump_on_s);
  EXPECT_NEAR(slow.pump_energy_j, quick.pump_energy_j, 1e-4 * quick.pump_energy_j);
}

class StrokesTest : public testing::TestWithParam<int> {};

TEST_P(StrokesTest, QuickWaysAgreeWithTheSimulator) {
  for (Configuration configuration : {Configuration::kMains, Configuration::kCompressor}) {
    Problem problem = EasyProblem(5, {configuration});
    problem.frequency_hz = 0.01;
    problem.groups[0].chamber.rest_volume_m3 = 15e-6;
    for (int g = 1; g < GetParam(); ++g) problem.groups.push_back(problem.groups[0]);
    problem.simultaneous = false;
    problem.parts.tubing.resize(1);
    problem.parts.fittings.resize(1);
    problem.parts.valves.resize(2);
    int compared = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.reservoir.index == optimizer::kCustom || compared >= 4) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      const double volume_m3 = StockVolume(problem, candidate);
      const OperatingPoint point{0.3 * window.low_pa + 0.7 * window.high_pa, volume_m3, volume_m3};
      SCOPED_TRACE(optimizer::Name(configuration));
      ExpectSame(problem, candidate, point);
      ++compared;
    });
    EXPECT_GT(compared, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Groups, StrokesTest, testing::Values(1, 2, 3));

// What a staggered pair needs of the pump is twice what one group alone needs at half the time.
TEST(StaggeredTest, EveryGroupTakesItsAir) {
  Problem one = EasyProblem(5, {Configuration::kCompressor});
  Problem two = one;
  two.groups.push_back(two.groups[0]);
  two.simultaneous = false;
  one.parts.valves.resize(1);
  one.parts.tubing.resize(1);
  one.parts.fittings.resize(1);
  two.parts = one.parts;
  one.frequency_hz = 2.0 * two.frequency_hz;
  std::vector<optimizer::Strokes> alone, pair;
  const auto strokes = [](const Problem& problem, std::vector<optimizer::Strokes>& list) {
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.reservoir.index == optimizer::kCustom || list.size() >= 3) return;
      const double volume_m3 = StockVolume(problem, candidate);
      list.push_back(optimizer::SimulateStrokes(
          problem, candidate,
          {optimizer::SourceWindow(problem, candidate).high_pa, volume_m3, volume_m3}));
    });
  };
  strokes(one, alone);
  strokes(two, pair);
  ASSERT_EQ(alone.size(), pair.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_TRUE(alone[i].works && pair[i].works);
    EXPECT_NEAR(pair[i].rise_s[0], alone[i].rise_s[0], 1e-4 * alone[i].rise_s[0]);
    EXPECT_NEAR(pair[i].rise_s[1], alone[i].rise_s[0], 1e-4 * alone[i].rise_s[0]);
    EXPECT_NEAR(pair[i].pump_on_s, 2.0 * alone[i].pump_on_s, 1e-3 * pair[i].pump_on_s);
  }
}

}  // namespace sizing_test
}  // namespace plenum::test
