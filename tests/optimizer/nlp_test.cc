// One zoo of small programs with answers by hand, on both solvers.
#include "optimizer/nlp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>

namespace plenum::optimizer {
namespace {

struct Sample {
  std::string name;
  Nlp nlp;
  std::vector<double> answer;
};

Nlp Program(std::vector<double> low, std::vector<double> high, std::vector<double> start,
            int constraints, std::function<bool(const std::vector<double>&, NlpValues&)> evaluate) {
  return {std::move(low), std::move(high), std::move(start), constraints, std::move(evaluate), {}};
}

std::vector<Sample> Zoo() {
  std::vector<Sample> zoo;
  zoo.push_back({"bound active",
                 Program({0.0}, {1.0}, {0.3}, 0,
                         [](const auto& x, NlpValues& v) {
                           v.objective = (x[0] - 2.0) * (x[0] - 2.0);
                           return true;
                         }),
                 {1.0}});
  zoo.push_back({"constraint active",
                 Program({0.1, 0.1}, {10.0, 10.0}, {3.0, 2.0}, 1,
                         [](const auto& x, NlpValues& v) {
                           v.objective = x[0] + 4.0 * x[1];
                           v.constraints = {x[0] * x[1] - 1.0};
                           return true;
                         }),
                 {2.0, 0.5}});
  zoo.push_back({"largest of the smallest margin",
                 Program({0.0, -10.0}, {1.0, 10.0}, {0.1, 0.0}, 2,
                         [](const auto& x, NlpValues& v) {
                           v.objective = -x[1];
                           v.constraints = {x[0] - x[1], 2.0 * (1.0 - x[0]) - x[1]};
                           return true;
                         }),
                 {2.0 / 3.0, 2.0 / 3.0}});
  zoo.push_back({"infeasible start",
                 Program({-2.0, -2.0}, {2.0, 2.0}, {0.0, 0.0}, 1,
                         [](const auto& x, NlpValues& v) {
                           v.objective = x[0] * x[0] + x[1] * x[1];
                           v.constraints = {x[0] + x[1] - 1.0};
                           return true;
                         }),
                 {0.5, 0.5}});
  return zoo;
}

// Not defined from x = 0.7 on; a full step from the start lands there.
Nlp PartlyDefined() {
  return Program({0.0}, {1.0}, {0.1}, 0, [](const auto& x, NlpValues& v) {
    if (x[0] >= 0.7) return false;
    v.objective = -x[0] - 0.1 * std::log(0.7 - x[0]);
    return true;
  });
}

Nlp Infeasible() {
  return Program({0.0}, {1.0}, {0.5}, 1, [](const auto& x, NlpValues& v) {
    v.objective = x[0];
    v.constraints = {x[0] - 2.0};
    return true;
  });
}

void ExpectSolved(const NlpResult& result, const std::vector<double>& answer,
                  const std::string& name) {
  EXPECT_EQ(result.status, NlpStatus::kSolved) << name;
  ASSERT_EQ(result.x.size(), answer.size()) << name;
  for (std::size_t i = 0; i < answer.size(); ++i) EXPECT_NEAR(result.x[i], answer[i], 2e-4) << name;
  EXPECT_GT(result.evaluations, 0) << name;
}

TEST(NlpTest, IpoptSolvesTheZoo) {
  for (const Sample& sample : Zoo())
    ExpectSolved(SolveWithIpopt(sample.nlp), sample.answer, sample.name);
}

// As when several jobs of a service size their reservoirs.
TEST(NlpTest, IpoptSolvesTheZooInManyThreadsAtATime) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([] {
      for (int round = 0; round < 20; ++round)
        for (const Sample& sample : Zoo())
          ExpectSolved(SolveWithIpopt(sample.nlp), sample.answer, sample.name);
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(NlpTest, NloptSolvesTheZoo) {
  for (const Sample& sample : Zoo())
    ExpectSolved(SolveWithNlopt(sample.nlp), sample.answer, sample.name);
}

TEST(NlpTest, IpoptStepsBackFromWhereTheModelIsNotDefined) {
  ExpectSolved(SolveWithIpopt(PartlyDefined()), {0.6}, "partly defined");
}

TEST(NlpTest, NloptClaimsNothingWrongWhereTheModelIsNotDefined) {
  const NlpResult result = SolveWithNlopt(PartlyDefined());
  ASSERT_EQ(result.x.size(), 1u);
  if (result.status == NlpStatus::kSolved) {
    EXPECT_NEAR(result.x[0], 0.6, 1e-4);
  } else {
    EXPECT_EQ(result.status, NlpStatus::kFailed);
  }
}

TEST(NlpTest, NoSolverClaimsToHaveSolvedAnInfeasibleProgram) {
  EXPECT_NE(SolveWithIpopt(Infeasible()).status, NlpStatus::kSolved);
  EXPECT_NE(SolveWithNlopt(Infeasible()).status, NlpStatus::kSolved);
}

// What is stopped is not solved.
TEST(NlpTest, StopEndsBothSolvers) {
  for (const Sample& sample : Zoo()) {
    Nlp nlp = sample.nlp;
    nlp.stop = [] { return true; };
    EXPECT_NE(SolveWithIpopt(nlp).status, NlpStatus::kSolved) << sample.name;
    EXPECT_NE(SolveWithNlopt(nlp).status, NlpStatus::kSolved) << sample.name;
  }
}

TEST(NlpTest, NeverDefinedFails) {
  const Nlp nlp = Program({0.0}, {1.0}, {0.5}, 0, [](const auto&, NlpValues&) { return false; });
  EXPECT_NE(SolveWithIpopt(nlp).status, NlpStatus::kSolved);
  EXPECT_NE(SolveWithNlopt(nlp).status, NlpStatus::kSolved);
}

TEST(NlpTest, DifferencesAgreeWithDerivatives) {
  const Nlp nlp = Program({0.0, -1.0}, {1.0, 2.0}, {0.5, 0.5}, 2, [](const auto& x, NlpValues& v) {
    v.objective = std::exp(x[0]) * x[1];
    v.constraints = {x[0] * x[0] - x[1], std::sin(3.0 * x[1])};
    return true;
  });
  for (const std::vector<double>& x : std::vector<std::vector<double>>{
           {0.5, 0.5}, {0.3, -0.2}, {0.0, 1.0}, {1.0, 2.0}, {1.0, -1.0}}) {
    NlpDerivatives at;
    ASSERT_TRUE(Differentiate(nlp, x, at));
    // One-sided at a bound: the error is half a step times the second derivative (9 at most here).
    const bool inside = x[0] > 0.0 && x[0] < 1.0;
    const double tolerance = inside ? 1e-8 : 1e-5;
    EXPECT_DOUBLE_EQ(at.values.objective, std::exp(x[0]) * x[1]);
    EXPECT_NEAR(at.gradient[0], std::exp(x[0]) * x[1], tolerance);
    EXPECT_NEAR(at.gradient[1], std::exp(x[0]), tolerance);
    EXPECT_NEAR(at.jacobian[0][0], 2.0 * x[0], tolerance);
    EXPECT_NEAR(at.jacobian[0][1], -1.0, tolerance);
    EXPECT_NEAR(at.jacobian[1][0], 0.0, tolerance);
    EXPECT_NEAR(at.jacobian[1][1], 3.0 * std::cos(3.0 * x[1]), tolerance);
  }
}

}  // namespace
}  // namespace plenum::optimizer
