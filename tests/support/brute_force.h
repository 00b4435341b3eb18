// Every combination of a small problem, one after the other: nothing of the tree search is used.
// Made-to-measure reservoirs are sized by dense scans, tanks of one group from the laws
// (tank_sizing.h), and pumps without a reservoir (direct_sizing.h), all others by the sizing at a
// given volume, which sizing_test checks against dense scans.
#ifndef PLENUM_TESTS_SUPPORT_BRUTE_FORCE_H_
#define PLENUM_TESTS_SUPPORT_BRUTE_FORCE_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/sizing/custom_sizing.h"

namespace plenum::test {

// Rows of the parts list in the contract's order: id and pieces (1 for tubing).
using PartsKey = std::vector<std::pair<std::string, int>>;

PartsKey KeyOf(const optimizer::Problem& problem, const optimizer::Candidate& candidate);
PartsKey KeyOf(const optimizer::Design& design);

struct Enumerated {
  PartsKey key;
  double mass_kg = 0.0, cost_eur = 0.0;  // of the parts, the least of a made-to-measure one; 0
                                         // where it is all of the objective
  optimizer::Configuration configuration;
  optimizer::Leaf leaf;
};

struct BruteForce {
  std::vector<Enumerated> designs;  // feasible, ranked: ties within 1e-6 by mass, cost, ids
  long long combinations = 0;       // by the contract's product
  long long undecided = 0;
  long long sized = 0;
};

// Calls `visit` for every combination whose parts fit together by their data sheets and have the
// prices that are needed. The candidate and its lines live only during the call.
void ForEachCombination(const optimizer::Problem& problem,
                        const std::function<void(const optimizer::Candidate&)>& visit);

// Volume of the candidate's reservoir; 0 without one.
double StockVolume(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

// Sizes the candidate by itself.
optimizer::Leaf SizeAlone(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

BruteForce Enumerate(const optimizer::Problem& problem);

// Whether one that ties with another goes before it.
bool GoesBefore(const Enumerated& a, const Enumerated& b);

// Runs of designs within 1e-6 of the first of the run are ties and go by mass, cost and part ids.
void Rank(std::vector<Enumerated>& designs);

optimizer::SearchOptions Within(double seconds);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BRUTE_FORCE_H_
