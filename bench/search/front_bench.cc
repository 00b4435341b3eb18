// Processor time to whole fronts in two and three amounts on synthetic catalogues, one thread.
//   front_bench [parts per family]… [--first I] [--requirements N] [--time-limit S] [--each]
//     [--pairs]
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "bench/search/synthetic.h"
#include "optimizer/front/pareto.h"

namespace plenum::bench {
namespace {

using optimizer::Amount;

std::string Names(const std::vector<Amount>& amounts) {
  std::string names;
  for (Amount amount : amounts) names += (names.empty() ? "" : ", ") + std::string(Name(amount));
  return names;
}

void Run(int size, int first, int requirements, double time_limit_s, bool each,
         const std::vector<Amount>& amounts) {
  const model::Parts parts = SyntheticParts(1, size);
  std::vector<double> seconds;
  std::size_t points = 0, largest = 0;
  int whole = 0;
  for (int i = first; i < first + requirements; ++i) {
    optimizer::Problem problem = SyntheticRequirements(static_cast<std::uint64_t>(i));
    problem.parts = parts;
    optimizer::SearchOptions options;
    options.time_limit_s = time_limit_s;
    const std::clock_t before = std::clock();
    const optimizer::Front front = optimizer::ParetoFront(problem, amounts, options);
    const double used_s = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    seconds.push_back(used_s);
    points += front.answer.designs.size();
    largest = std::max(largest, front.answer.designs.size());
    whole += front.answer.proof.complete;
    if (each)
      std::printf("  %3d: %.3f s, %zu points%s\n", i, used_s, front.answer.designs.size(),
                  front.answer.proof.complete ? "" : ", not whole");
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf(
      "%7d parts per family, %s: median %.3f s, max %.3f s; %d of %d whole; %zu points, "
      "largest front %zu\n",
      size, Names(amounts).c_str(), seconds[seconds.size() / 2], seconds.back(), whole,
      requirements, points, largest);
  std::fflush(stdout);
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  using plenum::optimizer::Amount;
  std::vector<int> sizes;
  int first = 0, requirements = 10;
  bool each = false, pairs = false;
  double time_limit_s = 60.0;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--requirements") == 0 && i + 1 < argc)
      requirements = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--first") == 0 && i + 1 < argc)
      first = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--each") == 0)
      each = true;
    else if (std::strcmp(argv[i], "--pairs") == 0)
      pairs = true;
    else if (std::strcmp(argv[i], "--time-limit") == 0 && i + 1 < argc)
      time_limit_s = std::stod(argv[++i]);
    else
      sizes.push_back(std::stoi(argv[i]));
  }
  if (sizes.empty()) sizes = {1000, 10000};
  const std::vector<std::vector<Amount>> fronts = {{Amount::kMass, Amount::kCost},
                                                   {Amount::kMass, Amount::kVolume},
                                                   {Amount::kMass, Amount::kVolume, Amount::kCost}};
  for (int size : sizes)
    for (const std::vector<Amount>& amounts : fronts)
      if (!pairs || amounts.size() == 2)
        plenum::bench::Run(size, first, requirements, time_limit_s, each, amounts);
}
