// The program that sizes a made-to-measure reservoir: its derivatives against differences of the
// evaluation, and Ipopt and NLopt on the same set of programs against each other and against the
// branch and bound that the search trusts.
#include "optimizer/sizing/sizing_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/physics/storage.h"
#include "optimizer/sizing/custom_sizing.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace sizing_program_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Nlp;
using optimizer::NlpDerivatives;
using optimizer::NlpValues;
using optimizer::OperatingPoint;
using optimizer::Problem;
using optimizer::SizingProgram;

#ifdef PLENUM_SANITIZED
constexpr std::uint64_t kSeeds = 24;
#else
constexpr std::uint64_t kSeeds = 60;
#endif

Problem Drawn(std::uint64_t seed, int groups, bool simultaneous) {
  Draw draw;
  draw.seed = 9300 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  draw.severity = 0.0;
  draw.size = {1, 1, 3, 0, 0, 0, 2, 2, 1};
  Problem problem = RandomProblem(draw);
  problem.objective = {1.0, 0.1, 0.0, seed % 2 == 0 ? 0.05 : 0.0};
  return problem;
}

struct Leaf {
  std::vector<optimizer::Line> lines;
  Candidate candidate;
};

// Some parts of each family with a reservoir to be made.
Leaf Assembled(const Problem& problem, Random& random) {
  Leaf leaf;
  const int valve = Pick(random, 0, static_cast<int>(problem.parts.valves.size()) - 1);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    leaf.lines.push_back(AssembleLine(
        problem, g, 0, problem.groups[g].fittings_per_line > 0 ? 0 : -1, valve, model::Gas::kAir));
  leaf.candidate.configuration = Configuration::kCompressor;
  leaf.candidate.compressor =
      MakeOption(problem, optimizer::Family::kCompressor, Pick(random, 0, 1), Pick(random, 1, 2));
  leaf.candidate.battery =
      MakeOption(problem, optimizer::Family::kBattery, Pick(random, 0, 1), Pick(random, 1, 3));
  leaf.candidate.reservoir.index = optimizer::kCustom;
  leaf.candidate.reservoir.quantity = 1;
  return leaf;
}

std::vector<double> Flat(const NlpValues& values) {
  std::vector<double> flat = values.constraints;
  flat.push_back(values.objective);
  return flat;
}

// Differences of fourth order over two steps: where both agree the function is smooth there, and
// they say what the derivative is.
struct Difference {
  double value, doubt;
};
std::vector<Difference> Differences(const Nlp& nlp, const std::vector<double>& x, int i) {
  const auto at = [&](double step) {
    std::vector<std::vector<double>> f;
    for (double k : {-2.0, -1.0, 1.0, 2.0}) {
      std::vector<double> shifted = x;
      shifted[i] += k * step;
      NlpValues values;
      if (!nlp.evaluate(shifted, values)) return std::vector<double>();
      f.push_back(Flat(values));
    }
    std::vector<double> slopes;
    for (std::size_t c = 0; c < f[0].size(); ++c)
      slopes.push_back((f[0][c] - 8.0 * f[1][c] + 8.0 * f[2][c] - f[3][c]) / (12.0 * step));
    return slopes;
  };
  const std::vector<double> fine = at(1e-3), coarse = at(2e-3);
  std::vector<Difference> differences;
  for (std::size_t c = 0; c < fine.size() && c < coarse.size(); ++c)
    differences.push_back({fine[c], std::abs(fine[c] - coarse[c])});
  return differences;
}

struct Tally {
  int compared = 0, doubtful = 0, met = 0;
  double worst = 0.0;
};

void CompareDerivatives(const Problem& problem, std::uint64_t seed, double tolerance,
                        Tally& tally) {
  Random random(seed);
  const Leaf leaf = [&] { return Assembled(problem, random); }();
  Candidate candidate = leaf.candidate;
  for (const optimizer::Line& line : leaf.lines) candidate.lines.push_back(&line);
  const optimizer::Window window = SourceWindow(problem, candidate);
  if (window.empty()) return;
  const double volume_m3 = LogUniform(random, 5e-5, 5e-3);
  const OperatingPoint point{
      window.low_pa + Uniform(random, 0.1, 0.9) * (window.high_pa - window.low_pa), volume_m3,
      volume_m3};
  const auto program = SizingProgram::At(problem, candidate, point);
  if (!program) return;
  const Nlp nlp = program->MakeNlp();
  NlpDerivatives exact;
  ASSERT_TRUE(nlp.differentiate(nlp.start, exact));
  tally.met += !Evaluate(problem, candidate, point).from_full;
  for (int i : {0, 1}) {
    const std::vector<Difference> differences = Differences(nlp, nlp.start, i);
    for (std::size_t c = 0; c < differences.size(); ++c) {
      const double slope = c < exact.jacobian.size() ? exact.jacobian[c][i] : exact.gradient[i];
      const double scale = std::max(1e-2, std::abs(slope));
      if (differences[c].doubt > 1e-3 * scale) {
        ++tally.doubtful;
        continue;
      }
      EXPECT_NEAR(slope, differences[c].value, tolerance * scale + 2.0 * differences[c].doubt)
          << "seed " << seed << " number " << c << " along " << i;
      tally.worst = std::max(tally.worst, std::abs(slope - differences[c].value) / scale);
      ++tally.compared;
    }
  }
}

void Print(const char* what, const Tally& tally) {
  std::printf("%s: %d derivatives, %d at kinks, %d draws where groups meet; worst %.2g\n", what,
              tally.compared, tally.doubtful, tally.met, tally.worst);
}

TEST(SizingProgramTest, DerivativesAreThoseOfOneGroup) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    CompareDerivatives(Drawn(seed, 1, true), seed, 2e-3, tally);
  Print("one group", tally);
  EXPECT_GT(tally.compared, 4 * static_cast<int>(kSeeds));
  EXPECT_LT(5 * tally.doubtful, tally.compared);
}

TEST(SizingProgramTest, DerivativesAreThoseOfGroupsInTurnsAndTogether) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= kSeeds / 3; ++seed) {
    CompareDerivatives(Drawn(seed, 2, false), seed, 5e-3, tally);
    CompareDerivatives(Drawn(seed, 2, true), seed, 5e-3, tally);
  }
  Print("two groups", tally);
  EXPECT_GT(tally.compared, 4 * static_cast<int>(kSeeds) / 3);
  EXPECT_GT(tally.met, static_cast<int>(kSeeds) / 6);
  EXPECT_LT(5 * tally.doubtful, tally.compared);
}

// Both solvers from the same start, a tenth of the volume away from the best point.
TEST(SizingProgramTest, IpoptAndNloptAgreeAndClaimNoMoreThanTheBound) {
  int both = 0, ipopt_only = 0, nlopt_only = 0, neither = 0, as_good = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds / 3; ++seed) {
    const Problem problem = Drawn(seed, 1, true);
    Random random(seed);
    const Leaf leaf = Assembled(problem, random);
    Candidate candidate = leaf.candidate;
    for (const optimizer::Line& line : leaf.lines) candidate.lines.push_back(&line);
    if (SourceWindow(problem, candidate).empty()) continue;
    optimizer::CustomSizing sizing(problem, candidate);
    for (int round = 0; round < 30 && !sizing.Refine(); ++round) {
    }
    const optimizer::Leaf& best = sizing.leaf();
    if (!std::isfinite(best.objective)) continue;
    const double volume_m3 =
        std::min(1.08 * best.point.reservoir_m3, model::kMadeReservoirLargestM3);
    const auto program =
        SizingProgram::At(problem, candidate, {best.point.source_pa, volume_m3, volume_m3});
    if (!program) continue;
    const Nlp nlp = program->MakeNlp();
    const optimizer::NlpResult ipopt = SolveWithIpopt(nlp), nlopt = SolveWithNlopt(nlp);
    const bool a = ipopt.status == optimizer::NlpStatus::kSolved;
    const bool b = nlopt.status == optimizer::NlpStatus::kSolved;
    ++(a && b ? both : a ? ipopt_only : b ? nlopt_only : neither);
    if (a && b) {
      EXPECT_NEAR(ipopt.objective, nlopt.objective, 1e-5) << "seed " << seed;
    }
    for (const optimizer::NlpResult* result : {&ipopt, &nlopt}) {
      if (result->status != optimizer::NlpStatus::kSolved) continue;
      const OperatingPoint point = program->PointOf(result->x);
      const double objective =
          ObjectiveValue(problem, candidate, point, Evaluate(problem, candidate, point));
      EXPECT_GE(objective, best.lower_bound * (1.0 - 1e-6)) << "seed " << seed;
      as_good += objective <= best.objective * (1.0 + 1e-5);
    }
  }
  std::printf(
      "%d solved by both, %d by Ipopt alone, %d by NLopt alone, %d by neither; %d of the "
      "points as good as the proved best\n",
      both, ipopt_only, nlopt_only, neither, as_good);
  EXPECT_GT(both, static_cast<int>(kSeeds) / 10);
  EXPECT_LE(4 * neither, both);
}

}  // namespace sizing_program_test
}  // namespace plenum::test
