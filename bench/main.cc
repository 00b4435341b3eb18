// The comparison of integrators; started by bench/run.sh.
//   plenum_bench rise DIR     writes DIR/rigs.csv and DIR/rise.csv
//   plenum_bench growth       prints how the simulator's cost grows
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure.h"
#include "bench/reference.h"
#include "bench/simulator.h"

namespace plenum::bench {
namespace {

constexpr std::uint64_t kSeed = 20211;
constexpr std::size_t kRigs = 10'000;

std::vector<Method> AllMethods() {
  std::vector<Method> methods = ClosedForms();
  for (auto&& group : {Simulators(), OdeintMethods(), CvodeMethods()}) {
    methods.insert(methods.end(), group.begin(), group.end());
  }
  return methods;
}

struct Row {
  Method method;
  double tolerance;
  Errors errors;
  std::vector<double> seconds_per_rig;
};

int Rise(const std::string& directory) {
  const std::vector<RiseRig> rigs = RandomRigs(kSeed, kRigs);
  std::vector<double> reference_s(rigs.size());
  std::transform(rigs.begin(), rigs.end(), reference_s.begin(), ReferenceRiseTime);
  WriteRigs(directory + "/rigs.csv", rigs, reference_s);
  std::printf("Rigs: %zu, seed %llu, %s\n", rigs.size(), static_cast<unsigned long long>(kSeed),
              DescribeRanges().c_str());
  std::printf("Compiler: g++ %s, flags %s\n", __VERSION__, PLENUM_BENCH_FLAGS);
  std::printf(
      "Time: median of %d repetitions, passes of 20 ms or more, method after method in each\n",
      kRepetitions);

  std::vector<Row> rows;
  int failures = 0;
  for (const Method& method : AllMethods()) {
    const auto tolerance = LoosestTolerance(method, rigs, reference_s);
    if (tolerance) {
      rows.push_back({method, *tolerance, ErrorsAt(method, *tolerance, rigs, reference_s), {}});
    } else {
      std::fprintf(stderr, "%s misses %g at every tolerance\n", method.name.c_str(), kErrorMax);
      ++failures;
    }
  }
  for (int i = 0; i < kRepetitions; ++i) {
    for (Row& row : rows) {
      row.seconds_per_rig.push_back(SecondsPerRig(row.method, row.tolerance, rigs));
    }
  }
  std::ofstream file(directory + "/rise.csv");
  file << "method;rigs;tolerance;error_max;error_median;seconds_per_rig\n";
  for (const Row& row : rows) {
    file << row.method.name << ';' << rigs.size() << ';';
    if (row.method.takes_tolerance) file << row.tolerance;
    file << ';' << row.errors.max << ';' << row.errors.median << ';' << Median(row.seconds_per_rig)
         << '\n';
  }
  return file.flush() && failures == 0 ? 0 : 1;
}

int Growth() {
  constexpr int kGroups[] = {1, 2, 4, 8};
  constexpr int kCycles[] = {1, 10, 100};
  std::printf(
      "Milliseconds per simulation (in brackets microseconds per stroke), 1 Hz cycles, "
      "tolerance 1e-8, median of %d\n",
      kRepetitions);
  std::printf("| %-24s | groups |", "source");
  for (const int cycles : kCycles) std::printf(" %9d cycle%s |", cycles, cycles > 1 ? "s" : " ");
  std::printf("\n| %.24s | -----: |", "-------------------------");
  for (std::size_t i = 0; i < std::size(kCycles); ++i) std::printf(" ---------------: |");
  for (const CycleVariant& variant : CycleVariants()) {
    for (const int groups : kGroups) {
      std::printf("\n| %-24s | %6d |", variant.name.c_str(), groups);
      for (const int cycles : kCycles) {
        std::vector<double> seconds(kRepetitions);
        for (double& value : seconds) value = variant.seconds(groups, cycles);
        const double median = Median(seconds);
        std::printf(" %8.3f (%5.2f) |", 1e3 * median, 1e6 * median / (2.0 * groups * cycles));
      }
    }
  }
  std::printf("\n");
  return 0;
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  try {
    if (command == "rise" && argc == 3) return plenum::bench::Rise(argv[2]);
    if (command == "growth" && argc == 2) return plenum::bench::Growth();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plenum_bench: %s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "usage: plenum_bench rise DIR | growth\n");
  return 2;
}
