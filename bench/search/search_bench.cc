// Processor time to the proof on synthetic catalogues; a search is one thread.
//   search_bench [parts per family]… [--seed S] [--first I] [--requirements N] [--time-limit S]
//     [--each]
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "bench/search/synthetic.h"
#include "optimizer/search/tree_search.h"

namespace plenum::bench {
namespace {

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double position = share * static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(position + 0.5)];
}

double PeakGigabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024.0 * 1024.0);
}

void Run(int size, int seed, int first, int requirements, double time_limit_s, bool each) {
  const auto start = std::chrono::steady_clock::now();
  const model::Parts parts = SyntheticParts(static_cast<std::uint64_t>(seed), size);
  const double made_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::vector<double> seconds, boxes;
  int proved = 0, infeasible = 0, worst = 0;
  long long undecided = 0;
  for (int i = first; i < first + requirements; ++i) {
    optimizer::Problem problem = SyntheticRequirements(static_cast<std::uint64_t>(i));
    problem.parts = parts;
    optimizer::SearchOptions options;
    options.time_limit_s = time_limit_s;
    const std::clock_t before = std::clock();
    const optimizer::Answer answer = optimizer::SearchTrees(problem, options);
    const double used_s = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    proved += answer.proof.complete;
    infeasible += answer.status == optimizer::Status::kInfeasible;
    undecided += answer.proof.undecided;
    if (seconds.empty() || used_s > *std::max_element(seconds.begin(), seconds.end())) worst = i;
    seconds.push_back(used_s);
    boxes.push_back(static_cast<double>(answer.proof.boxes));
    if (each) {
      std::printf("  %3d: %.4f s, %lld boxes, %s, %zu designs", i, used_s, answer.proof.boxes,
                  optimizer::Name(answer.status), answer.designs.size());
      if (!answer.designs.empty())
        std::printf(", %s, %.6g to %.6g", optimizer::Name(answer.designs.front().configuration),
                    answer.designs.front().objective, answer.designs.back().objective);
      std::printf("\n");
    }
  }
  std::printf(
      "%7d parts per family (made in %.1f s), %d requirements: median %.4f s, p90 %.4f, p99 %.4f, "
      "max %.4f (number %d); boxes median %.0f, max %.0f; proved %d, infeasible %d, undecided "
      "leaves %lld; peak %.2f GB\n",
      size, made_s, requirements, Quantile(seconds, 0.5), Quantile(seconds, 0.9),
      Quantile(seconds, 0.99), Quantile(seconds, 1.0), worst, Quantile(boxes, 0.5),
      Quantile(boxes, 1.0), proved, infeasible, undecided, PeakGigabytes());
  std::fflush(stdout);
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  std::vector<int> sizes;
  int seed = 1, first = 0, requirements = 50;  // seed: of the catalogue
  bool each = false;
  double time_limit_s = 60.0;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--requirements") == 0 && i + 1 < argc)
      requirements = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--seed") == 0 && i + 1 < argc)
      seed = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--first") == 0 && i + 1 < argc)
      first = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--each") == 0)
      each = true;
    else if (std::strcmp(argv[i], "--time-limit") == 0 && i + 1 < argc)
      time_limit_s = std::stod(argv[++i]);
    else
      sizes.push_back(std::stoi(argv[i]));
  }
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  for (int size : sizes) plenum::bench::Run(size, seed, first, requirements, time_limit_s, each);
}
