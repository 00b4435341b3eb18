// Fronts against the non-dominated of all combinations of small random catalogues.
#include "optimizer/front/pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "optimizer/explain/conflict.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace pareto_test {

using optimizer::Amount;
using optimizer::Configuration;
using optimizer::Front;
using optimizer::Problem;
using optimizer::Status;
using Point = std::vector<double>;

#ifdef PLENUM_SANITIZED
constexpr std::uint64_t kStride = 2;
#else
constexpr std::uint64_t kStride = 1;
#endif

constexpr double kSame = 1e-6;

bool NoWorse(const Point& a, const Point& b, double tolerance = kSame) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i] * (1.0 + tolerance)) return false;
  return true;
}

bool Has(const std::vector<Point>& points, const Point& wanted) {
  return std::any_of(points.begin(), points.end(), [&](const Point& point) {
    return NoWorse(point, wanted) && NoWorse(wanted, point);
  });
}

// Amounts of every feasible combination, each with the settings that are best for it.
std::vector<Point> AllPoints(Problem problem, const std::vector<Amount>& amounts) {
  const bool energy = std::find(amounts.begin(), amounts.end(), Amount::kEnergy) != amounts.end();
  const bool cost = std::find(amounts.begin(), amounts.end(), Amount::kCost) != amounts.end();
  problem.objective = {};
  (energy ? problem.objective.energy_wh : problem.objective.mass_kg) = 1.0;
  if (cost && std::isinf(problem.cost_max_eur)) problem.cost_max_eur = 1e9;
  std::vector<Point> points;
  ForEachCombination(problem, [&](const optimizer::Candidate& candidate) {
    const optimizer::Leaf leaf = SizeAlone(problem, candidate);
    if (leaf.status != optimizer::LeafStatus::kFeasible) return;
    const optimizer::Amounts total = TotalAmounts(problem, candidate, leaf.point);
    Point point;
    for (Amount amount : amounts)
      point.push_back(amount == Amount::kMass     ? total.mass_kg
                      : amount == Amount::kVolume ? total.volume_m3 * 1e3
                      : amount == Amount::kCost   ? total.cost_eur
                                                  : leaf.objective);
    points.push_back(std::move(point));
  });
  return points;
}

std::vector<Point> NonDominated(const std::vector<Point>& points) {
  std::vector<Point> front;
  for (const Point& point : points) {
    const bool beaten = std::any_of(points.begin(), points.end(), [&](const Point& other) {
      return NoWorse(other, point) && !NoWorse(point, other);
    });
    if (!beaten && !Has(front, point)) front.push_back(point);
  }
  return front;
}

std::vector<Point> PointsOf(const Front& front) {
  std::vector<Point> points;
  for (const optimizer::Design& design : front.answer.designs) {
    Point point;
    for (Amount amount : front.amounts) point.push_back(Of(amount, design.totals));
    points.push_back(std::move(point));
  }
  return points;
}

struct Tally {
  int problems = 0, whole = 0;
  std::size_t points = 0, largest = 0;
  ~Tally() {
    std::printf("%d fronts, %d whole, %zu points, largest %zu\n", problems, whole, points, largest);
  }
};

bool Hidden(const Front& front, const Point& point) {
  const auto least_of = [&](const optimizer::Unexplored& region) {
    return std::find(front.amounts.begin(), front.amounts.end(), region.least_of) -
           front.amounts.begin();
  };
  return std::any_of(front.unexplored.begin(), front.unexplored.end(), [&](const auto& region) {
    return NoWorse(point, region.limits) &&
           point[static_cast<std::size_t>(least_of(region))] >= region.least * (1.0 - kSame);
  });
}

// Every point is there, or in a region that the answer names as not searched.
void ExpectCovered(const Front& front, const std::vector<Point>& truth) {
  const std::vector<Point> points = PointsOf(front);
  for (const Point& point : truth) {
    const bool covered = std::any_of(points.begin(), points.end(), [&](const Point& found) {
      return NoWorse(found, point, 1.01 * front.resolution);
    });
    EXPECT_TRUE(covered || Hidden(front, point)) << "missing " << point[0];
  }
}

// Designs come by the problem's own objective, and carry no requirement that it does not have.
void ExpectInOrder(const Problem& problem, const Front& front) {
  double before = -optimizer::kUnlimited;
  for (const optimizer::Design& design : front.answer.designs) {
    EXPECT_LE(before, design.objective);
    before = design.objective;
    for (const optimizer::Margin& margin : design.margins) {
      EXPECT_GE(margin.relative_margin, 0.0) << margin.requirement;
      EXPECT_TRUE(margin.requirement != "/supply/volume_l_max" ||
                  std::isfinite(problem.volume_max_l));
      EXPECT_TRUE(margin.requirement != "/supply/cost_eur_max" ||
                  std::isfinite(problem.cost_max_eur));
    }
  }
}

void Compare(const Problem& problem, const std::vector<Amount>& amounts, Tally& tally) {
  const std::vector<Point> truth = NonDominated(AllPoints(problem, amounts));
  const Front front = ParetoFront(problem, amounts, Within(60.0));
  const std::vector<Point> points = PointsOf(front);
  ExpectInOrder(problem, front);
  ExpectCovered(front, truth);
  const bool whole = front.unexplored.empty();
  EXPECT_EQ(whole, front.searches == front.proved);
  EXPECT_EQ(front.answer.status, !whole          ? Status::kFeasible
                                 : truth.empty() ? Status::kInfeasible
                                                 : Status::kOptimal);
  if (whole) {
    for (const Point& point : points) EXPECT_TRUE(Has(truth, point)) << "surplus " << point[0];
    if (front.resolution <= kSame) {
      EXPECT_EQ(points.size(), truth.size());
    }
  }
  ++tally.problems;
  tally.whole += whole;
  tally.points += points.size();
  tally.largest = std::max(tally.largest, points.size());
}

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations,
              const CatalogueSize& size) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.1 + 0.02 * static_cast<double>(seed % 20);
  draw.size = size;
  return RandomProblem(draw);
}

const std::set<Configuration> kRegulated{Configuration::kCylinder, Configuration::kCo2,
                                         Configuration::kMains};

TEST(ParetoTest, TwoAmountsOfRegulatedSupplies) {
  constexpr Amount kPairs[][2] = {
      {Amount::kMass, Amount::kVolume}, {Amount::kCost, Amount::kMass},
      {Amount::kVolume, Amount::kCost}, {Amount::kMass, Amount::kEnergy},
      {Amount::kEnergy, Amount::kCost}, {Amount::kVolume, Amount::kEnergy}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto& pair = kPairs[seed % 6];
    SCOPED_TRACE("seed " + std::to_string(seed));
    Compare(Drawn(2000 + seed, kRegulated, {1, 2, 3, 2, 2, 2, 0, 2, 0}), {pair[0], pair[1]}, tally);
  }
  EXPECT_EQ(tally.whole, tally.problems);
  EXPECT_GT(tally.largest, 2u);
}

// The mass of a tank depends on its fill.
TEST(ParetoTest, TwoAmountsOfTanks) {
  constexpr Amount kPairs[][2] = {{Amount::kMass, Amount::kVolume},
                                  {Amount::kCost, Amount::kMass},
                                  {Amount::kVolume, Amount::kCost}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const auto& pair = kPairs[seed % 3];
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(2600 + seed, {Configuration::kTank}, {2, 2, 3, 2, 0, 0, 0, 2, 4});
    problem.actuations = 1.0 + static_cast<double>(seed);
    problem.limits.reservoirs = 2;
    Compare(problem, {pair[0], pair[1]}, tally);
  }
  EXPECT_EQ(tally.whole, tally.problems);
  EXPECT_GT(tally.largest, 2u);
}

// Lighter parts are larger, by laws that bend either way, so that fronts are long and have points
// on their hull and above it.
Problem WithLongFront(std::uint64_t seed) {
  Problem problem = Drawn(2004, {Configuration::kMains}, {1, 1, 9, 9, 0, 0, 0, 0, 0});
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> scatter(0.9, 1.1), bend(0.4, 2.5);
  const auto trade = [&](auto& parts, double mass_kg, double volume_m3) {
    const double power = bend(random);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(parts.size());
      const std::string id = parts[i].basics.id;
      parts[i] = parts[0];
      parts[i].basics = {id,
                         mass_kg * share * scatter(random),
                         volume_m3 * (1.1 - std::pow(share, power)) * scatter(random),
                         20.0,
                         {}};
    }
  };
  trade(problem.parts.valves, 0.05, 60e-6);
  trade(problem.parts.regulators, 0.3, 300e-6);
  return problem;
}

TEST(ParetoTest, LongFrontsOfTwoAmounts) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Compare(WithLongFront(seed), {Amount::kMass, Amount::kVolume}, tally);
  }
  EXPECT_EQ(tally.whole, tally.problems);
  EXPECT_GT(tally.largest, 12u);
}

TEST(ParetoTest, ThreeAmounts) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Compare(Drawn(2100 + seed, kRegulated, {1, 2, 2, 2, 2, 1, 0, 2, 0}),
            {Amount::kVolume, Amount::kMass, seed % 2 == 0 ? Amount::kEnergy : Amount::kCost},
            tally);
  }
  EXPECT_EQ(tally.whole, tally.problems);
  EXPECT_GT(tally.largest, 3u);
}

TEST(ParetoTest, CompressorWithMadeReservoir) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; seed += kStride) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(2200 + seed, {Configuration::kCompressor}, {1, 1, 2, 0, 0, 0, 2, 2, 1});
    problem.limits.compressors = 1;
    Compare(problem, {Amount::kMass, Amount::kVolume}, tally);
  }
  EXPECT_GE(3 * tally.whole, tally.problems);
}

// Heavier valves are smaller here: a front of several points.
Problem LongFront() {
  Problem problem = Drawn(2004, {Configuration::kMains}, {1, 1, 6, 2, 0, 0, 0, 0, 0});
  std::vector<model::Valve>& valves = problem.parts.valves;
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const double rank = static_cast<double>(i);
    const std::string id = valves[i].basics.id;
    valves[i] = valves[0];
    valves[i].basics = {id, 0.05 + 0.01 * rank, 90e-6 - 10e-6 * rank, 20.0, {}};
  }
  return problem;
}

// Parts of equal mass: the larger ones are weakly dominated, and ties must not leave them.
TEST(ParetoTest, TiesLeaveNoWeaklyDominatedPoint) {
  Problem problem = Drawn(2301, {Configuration::kMains}, {1, 1, 3, 3, 0, 0, 0, 0, 0});
  for (model::Valve& valve : problem.parts.valves) valve.basics.mass_kg = 0.05;
  for (model::Regulator& regulator : problem.parts.regulators) regulator.basics.mass_kg = 0.2;
  Tally tally;
  Compare(problem, {Amount::kMass, Amount::kVolume}, tally);
  EXPECT_EQ(tally.points, 1u);
}

// The first valve ties with the second in mass and comes before it by its id, so it is found first,
// but the second, a little lighter, is smaller. It does not make the first superfluous, since its
// coil takes more; and only one of the regions beside the first point holds it.
TEST(ParetoTest, ThreeAmountsWithoutAPointThatALaterOneBeats) {
  Problem problem = LongFront();
  std::vector<model::Valve>& valves = problem.parts.valves;
  ASSERT_LT(valves[0].basics.id, valves[1].basics.id);
  valves[0].basics.mass_kg = valves[1].basics.mass_kg * (1.0 + 1e-7);
  valves[1].coil_power_w *= 1.1;
  Tally tally;
  Compare(problem, {Amount::kMass, Amount::kVolume, Amount::kCost}, tally);
  EXPECT_EQ(tally.whole, 1);
  EXPECT_GT(tally.points, 2u);
}

TEST(ParetoTest, LimitsOfTheProblemStay) {
  Problem problem = LongFront();
  const std::vector<Amount> amounts{Amount::kMass, Amount::kVolume};
  const Front free = ParetoFront(problem, amounts, Within(60.0));
  ASSERT_GT(free.answer.designs.size(), 1u);
  const double volume_l = Of(Amount::kVolume, free.answer.designs.front().totals);
  problem.volume_max_l = 0.999 * volume_l;
  const Front limited = ParetoFront(problem, amounts, Within(60.0));
  EXPECT_EQ(limited.answer.designs.size(), free.answer.designs.size() - 1);
  for (const optimizer::Design& design : limited.answer.designs) {
    const auto margin = std::find_if(
        design.margins.begin(), design.margins.end(),
        [](const optimizer::Margin& m) { return m.requirement == "/supply/volume_l_max"; });
    ASSERT_NE(margin, design.margins.end());
    EXPECT_EQ(margin->required, problem.volume_max_l);
  }
}

TEST(ParetoTest, ConflictsNameOnlyRequirements) {
  Problem problem = LongFront();
  problem.groups[0].rise_time_max_s = 1e-6;
  const Front front =
      ParetoFront(problem, {Amount::kMass, Amount::kCost}, Within(20.0), optimizer::FindConflicts);
  EXPECT_EQ(front.answer.status, Status::kInfeasible);
  const auto& conflicts = front.answer.infeasibility.conflicts;
  ASSERT_EQ(conflicts.size(), 1u);
  ASSERT_EQ(conflicts[0].size(), 1u);
  EXPECT_EQ(conflicts[0][0].requirement, "/actuators/0/rise_time_s_max");
}

// A front of cost needs prices; no limit on cost was given that could be dropped.
TEST(ParetoTest, MissingPricesAreNamedAsPrices) {
  Problem problem = LongFront();
  for (model::Tubing& tube : problem.parts.tubing) tube.per_metre.cost_eur.reset();
  const Front front =
      ParetoFront(problem, {Amount::kMass, Amount::kCost}, Within(20.0), optimizer::FindConflicts);
  EXPECT_EQ(front.answer.status, Status::kInfeasible);
  const optimizer::Infeasibility& why = front.answer.infeasibility;
  ASSERT_EQ(why.conflicts.size(), 1u);
  for (const optimizer::Conflict& entry : why.conflicts[0]) EXPECT_EQ(entry.requirement, "prices");
  ASSERT_EQ(why.relaxation.size(), 1u);
  EXPECT_EQ(why.relaxation[0].requirement, "prices");
  EXPECT_FALSE(why.relaxation[0].required || why.relaxation[0].value);
}

// Stopped anywhere on the way.
TEST(ParetoTest, WhatIsNotSearchedIsNamed) {
  const std::vector<Amount> amounts{Amount::kMass, Amount::kVolume};
  for (const Problem& problem : {LongFront(), WithLongFront(1), WithLongFront(2)}) {
    const Front whole = ParetoFront(problem, amounts, Within(60.0));
    ASSERT_GT(whole.searches, 2);
    int stops = 0;
    bool cancelled = true;
    for (int most = 6; cancelled; most += 1 + most / 4) {
      int asked = 0;
      optimizer::SearchOptions options = Within(60.0);
      options.cancelled = [&] { return ++asked > most; };
      const Front stopped = ParetoFront(problem, amounts, options);
      cancelled = stopped.answer.status == Status::kCancelled;
      EXPECT_EQ(stopped.unexplored.empty(), !cancelled);
      EXPECT_EQ(stopped.answer.proof.complete, !cancelled);
      ExpectCovered(stopped, PointsOf(whole));
      stops += cancelled;
    }
    EXPECT_GT(stops, 4);
  }
}

}  // namespace pareto_test
}  // namespace plenum::test
