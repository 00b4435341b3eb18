// What every rival reports of an instance.
#ifndef PLENUM_BENCH_SEARCH_RIVAL_H_
#define PLENUM_BENCH_SEARCH_RIVAL_H_

#include <functional>
#include <string>

#include "bench/search/base_instance.h"

namespace plenum::bench {

struct Outcome {
  bool found = false;    // `best` holds a selection
  bool claimed = false;  // it is said to be optimal
  Selection best{};
  double find_s = 0.0;   // until `best` was known
  double total_s = 0.0;  // until the proof, or the end
  std::string note;
};

struct Rival {
  std::string name, formulation, options;
  std::function<Outcome(const BaseInstance&, std::uint64_t seed, double time_limit_s)> solve;
};

Rival Plenum();
Rival Cbc(bool lifted);
Rival Bonmin(const std::string& algorithm);
Rival GeneticAlgorithm();
Rival RandomSearch();

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SEARCH_RIVAL_H_
