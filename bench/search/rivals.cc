// The rivals of C++ on the base instance; writes one line for each run, which rivals_table.py
// reads.
//   rivals FILE SIZE… [--instances N] [--time-limit S] [--only RIVAL]
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "bench/search/rival.h"

namespace plenum::bench {
namespace {

constexpr int kBruteForceSizeMax = 100;

// Instances that have a feasible combination, by number.
std::vector<BaseInstance> Instances(int size, int wanted, std::vector<std::uint64_t>& seeds) {
  std::vector<BaseInstance> instances;
  const Rival plenum = Plenum();
  for (std::uint64_t seed = 0; static_cast<int>(instances.size()) < wanted; ++seed) {
    BaseInstance base = MakeBaseInstance(seed + 1, seed, size);
    if (!plenum.solve(base, seed, 60.0).found) continue;
    instances.push_back(std::move(base));
    seeds.push_back(seed);
  }
  return instances;
}

void Write(std::FILE* file, const std::string& rival, int size, std::uint64_t seed,
           const BaseInstance& base, const Outcome& outcome) {
  const bool feasible = outcome.found && base.Feasible(outcome.best);
  std::fprintf(file, "run\t%s\t%d\t%llu\t%d\t%d\t%.12g\t%.6g\t%.6g\t%s\n", rival.c_str(), size,
               static_cast<unsigned long long>(seed), outcome.claimed, feasible,
               outcome.found ? base.Mass(outcome.best) : std::nan(""), outcome.find_s,
               outcome.total_s, outcome.note.c_str());
  std::fflush(file);
}

std::vector<Rival> Rivals() {
  return {Plenum(),        Cbc(false),         Cbc(true),     Bonmin("B-OA"),
          Bonmin("B-Hyb"), GeneticAlgorithm(), RandomSearch()};
}

void Run(std::FILE* file, int size, int count, double time_limit_s, const std::string& only) {
  std::vector<std::uint64_t> seeds;
  const std::vector<BaseInstance> instances = Instances(size, count, seeds);
  for (const Rival& rival : Rivals())
    for (std::size_t i = 0; i < instances.size(); ++i) {
      if (!only.empty() && rival.name != only) continue;
      std::fprintf(stderr, "%d parts, instance %zu: %s\n", size, i + 1, rival.name.c_str());
      Write(file, rival.name, size, seeds[i], instances[i],
            rival.solve(instances[i], seeds[i], time_limit_s));
    }
  for (std::size_t i = 0; i < instances.size() && size <= kBruteForceSizeMax; ++i) {
    const Enumerated truth = EnumerateBase(instances[i]);
    Outcome outcome;
    outcome.found = outcome.claimed = truth.found;
    outcome.best = truth.best;
    Write(file, "brute force", size, seeds[i], instances[i], outcome);
  }
}

void Describe(std::FILE* file) {
  for (const Rival& rival : Rivals())
    std::fprintf(file, "rival\t%s\t%s\t%s\n", rival.name.c_str(), rival.formulation.c_str(),
                 rival.options.c_str());
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  std::vector<int> sizes;
  int instances = 10;
  double time_limit_s = 20.0;
  std::string only;
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--instances") == 0 && i + 1 < argc)
      instances = std::stoi(argv[++i]);
    else if (std::strcmp(argv[i], "--time-limit") == 0 && i + 1 < argc)
      time_limit_s = std::stod(argv[++i]);
    else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc)
      only = argv[++i];
    else
      sizes.push_back(std::stoi(argv[i]));
  }
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "w") : nullptr;
  if (file == nullptr || sizes.empty()) {
    std::fprintf(stderr,
                 "usage: rivals FILE SIZE... [--instances N] [--time-limit S] [--only RIVAL]\n");
    return 2;
  }
  plenum::bench::Describe(file);
  for (int size : sizes) plenum::bench::Run(file, size, instances, time_limit_s, only);
  std::fclose(file);
}
