// One zoo of small programs with answers by hand, on both solvers.
#include "optimizer/sizing/nlp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

#include "model/flow/scalar.h"

namespace plenum::optimizer {
namespace nlp_test {

struct Sample {
  std::string name;
  Nlp nlp;
  std::vector<double> answer;
};

// `f` sets objective and constraints, in doubles and in dual numbers.
template <class Function>
Nlp Program(std::vector<double> low, std::vector<double> high, std::vector<double> start,
            int constraints, Function f) {
  Nlp nlp{std::move(low), std::move(high), std::move(start), constraints, {}, {}, {}};
  nlp.evaluate = [f](const std::vector<double>& x, NlpValues& v) {
    return f(x, v.objective, v.constraints);
  };
  nlp.differentiate = [f](const std::vector<double>& x, NlpDerivatives& derivatives) {
    std::vector<model::Dual> lifted, constraints_at;
    for (std::size_t i = 0; i < x.size(); ++i) lifted.emplace_back(x[i], static_cast<int>(i));
    model::Dual objective;
    if (!f(lifted, objective, constraints_at)) return false;
    const auto slopes = [&](const model::Dual& value) {
      return std::vector<double>(value.v.data(), value.v.data() + x.size());
    };
    derivatives.gradient = slopes(objective);
    derivatives.jacobian.clear();
    for (const model::Dual& value : constraints_at) derivatives.jacobian.push_back(slopes(value));
    return true;
  };
  return nlp;
}

std::vector<Sample> Zoo() {
  std::vector<Sample> zoo;
  zoo.push_back({"bound active",
                 Program({0.0}, {1.0}, {0.3}, 0,
                         [](const auto& x, auto& objective, auto&) {
                           objective = (x[0] - 2.0) * (x[0] - 2.0);
                           return true;
                         }),
                 {1.0}});
  zoo.push_back({"constraint active",
                 Program({0.1, 0.1}, {10.0, 10.0}, {3.0, 2.0}, 1,
                         [](const auto& x, auto& objective, auto& constraints) {
                           objective = x[0] + 4.0 * x[1];
                           constraints = {x[0] * x[1] - 1.0};
                           return true;
                         }),
                 {2.0, 0.5}});
  zoo.push_back({"largest of the smallest margin",
                 Program({0.0, -10.0}, {1.0, 10.0}, {0.1, 0.0}, 2,
                         [](const auto& x, auto& objective, auto& constraints) {
                           objective = -x[1];
                           constraints = {x[0] - x[1], 2.0 * (1.0 - x[0]) - x[1]};
                           return true;
                         }),
                 {2.0 / 3.0, 2.0 / 3.0}});
  zoo.push_back({"infeasible start",
                 Program({-2.0, -2.0}, {2.0, 2.0}, {0.0, 0.0}, 1,
                         [](const auto& x, auto& objective, auto& constraints) {
                           objective = x[0] * x[0] + x[1] * x[1];
                           constraints = {x[0] + x[1] - 1.0};
                           return true;
                         }),
                 {0.5, 0.5}});
  return zoo;
}

// Not defined from x = 0.7 on; a full step from the start lands there.
Nlp PartlyDefined() {
  return Program({0.0}, {1.0}, {0.1}, 0, [](const auto& x, auto& objective, auto&) {
    if (x[0] >= 0.7) return false;
    using std::log;
    objective = -x[0] - 0.1 * log(0.7 - x[0]);
    return true;
  });
}

Nlp Infeasible() {
  return Program({0.0}, {1.0}, {0.5}, 1, [](const auto& x, auto& objective, auto& constraints) {
    objective = x[0];
    constraints = {x[0] - 2.0};
    return true;
  });
}

// The smaller of two margins as one constraint, which has a kink where it is largest: Ipopt's steps
// come to no end there.
Nlp KinkedMargin() {
  Nlp nlp{{0.0, -10.0}, {1.0, 10.0}, {0.1, 0.0}, 1, {}, {}, {}};
  nlp.evaluate = [](const std::vector<double>& x, NlpValues& values) {
    values = {-x[1], {std::min(x[0], 2.0 * (1.0 - x[0])) - x[1]}};
    return true;
  };
  nlp.differentiate = [](const std::vector<double>& x, NlpDerivatives& derivatives) {
    derivatives = {{0.0, -1.0}, {{x[0] < 2.0 * (1.0 - x[0]) ? 1.0 : -2.0, -1.0}}};
    return true;
  };
  return nlp;
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
  threads.reserve(4);
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

TEST(NlpTest, NloptTakesOverWhereIpoptDoesNotConverge) {
  ASSERT_NE(SolveWithIpopt(KinkedMargin()).status, NlpStatus::kSolved);
  ExpectSolved(Solve(KinkedMargin(), NlpSolver::kIpopt), {2.0 / 3.0, 2.0 / 3.0}, "kinked margin");
}

TEST(NlpTest, IpoptIsEnoughWhereItConverges) {
  for (const Sample& sample : Zoo())
    EXPECT_EQ(Solve(sample.nlp, NlpSolver::kIpopt).x, SolveWithIpopt(sample.nlp).x);
  EXPECT_NE(Solve(Infeasible(), NlpSolver::kIpopt).status, NlpStatus::kSolved);
}

TEST(NlpTest, NloptIsAskedFirstWhereItsOpinionIsWanted) {
  for (const Sample& sample : Zoo()) {
    const NlpResult nlopt = SolveWithNlopt(sample.nlp);
    if (nlopt.status == NlpStatus::kSolved) {
      EXPECT_EQ(Solve(sample.nlp, NlpSolver::kNlopt).x, nlopt.x);
    }
  }
  EXPECT_NE(Solve(Infeasible(), NlpSolver::kNlopt).status, NlpStatus::kSolved);
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
  const Nlp nlp = Program({0.0}, {1.0}, {0.5}, 0, [](const auto&, auto&, auto&) { return false; });
  EXPECT_NE(SolveWithIpopt(nlp).status, NlpStatus::kSolved);
  EXPECT_NE(SolveWithNlopt(nlp).status, NlpStatus::kSolved);
}

}  // namespace nlp_test
}  // namespace plenum::optimizer
