// Random design problems that are small enough to enumerate, with parts whose numbers trade off as
// real ones do: more flow, more air or more energy costs mass.
#ifndef PLENUM_TESTS_SUPPORT_SMALL_CATALOGUE_H_
#define PLENUM_TESTS_SUPPORT_SMALL_CATALOGUE_H_

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/problem.h"
#include "tests/support/random_parts.h"

namespace plenum::test {

struct Draw {
  std::uint64_t seed = 0;
  std::set<optimizer::Configuration> configurations;
  int groups = 1;
  bool simultaneous = true;
  double severity = 0.5;  // 0: limits that nearly everything meets; 1: that hardly anything does
  CatalogueSize size;
};

// Parts, actuators, duty, limits and a mass objective. Same draw, same problem.
optimizer::Problem RandomProblem(const Draw& draw);

// A problem of one group that parts of an ordinary catalogue meet with ease, without limits but
// rise and fall time: the start of tests that tighten one thing.
optimizer::Problem EasyProblem(std::uint64_t seed,
                               std::set<optimizer::Configuration> configurations);

// A line assembled from the raw parts, without the optimizer's own enumeration. `fitting` −1 where
// the group needs none. Its fall time and least inflation time are the model's; its lowest source
// pressure is the trivial one.
optimizer::Line AssembleLine(const optimizer::Problem& problem, int group, int tubing, int fitting,
                             int valve, model::Gas gas);

// How many times a design buys what feeds one group, or one actuator, or all.
int FeedsByHand(const optimizer::Problem& problem);

// Raw rules of compatibility.
bool Mates(const optimizer::Problem& problem, int tubing, int fitting, int valve);

// A made part choice: `quantity` pieces of the family's part `index`.
optimizer::Option MakeOption(const optimizer::Problem& problem, optimizer::Family family, int index,
                             int quantity);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_SMALL_CATALOGUE_H_
