// What looks for good combinations and proves nothing.
#include <chrono>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <random>

#include "bench/search/rival.h"

namespace plenum::bench {
namespace {

using Clock = ProcessorClock;

constexpr unsigned kPopulation = 100, kGenerations = 300;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The mass; what is not feasible is heavier than anything that is, by how much it misses.
double Penalised(const BaseInstance& base, const Selection& s) {
  constexpr double kWall = 1e3;
  double missed = 0.0;
  for (int f = 0; f < kBaseFamilies; ++f) missed += !base.stands[f][s[f]];
  missed += base.tube_class[s[kTubes]] != base.fitting_class[s[kFittings]];
  missed += base.fitting_thread[s[kFittings]] != base.valve_thread[s[kValves]];
  missed += base.gas_m3[s[kCylinders]] < base.need_m3[s[kTubes]];
  missed += base.fill_pa[s[kCylinders]] > base.inlet_max_pa[s[kRegulators]];
  const BaseAttributes attributes = base.AttributesOf(s);
  missed += std::min(10.0, std::max(0.0, base.Fall(attributes) - 1.0));
  missed += std::min(10.0, std::max(0.0, base.Rise(attributes) - 1.0));
  return base.Mass(s) + (missed > 0.0 ? kWall * (1.0 + missed) : 0.0);
}

// Keeps the best and when it was found.
struct Incumbent {
  const BaseInstance* base = nullptr;
  Clock::time_point start = Clock::now();
  double mass_kg = std::numeric_limits<double>::infinity();
  Outcome outcome;

  double Try(const Selection& s) {
    const double value = Penalised(*base, s);
    if (value < mass_kg && base->Feasible(s)) {
      mass_kg = value;
      outcome.best = s;
      outcome.found = true;
      outcome.find_s = Since(start);
    }
    return value;
  }
};

// The parts of each family in the order of their mass.
struct ByMass {
  explicit ByMass(const BaseInstance& base) {
    for (int f = 0; f < kBaseFamilies; ++f) {
      for (int i = 0; i < base.size; ++i) order[f].push_back(i);
      std::sort(order[f].begin(), order[f].end(),
                [&](int a, int b) { return base.mass_kg[f][a] < base.mass_kg[f][b]; });
    }
  }
  std::array<std::vector<int>, kBaseFamilies> order;
};

struct Udp {
  Incumbent* incumbent = nullptr;
  const ByMass* by_mass = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    Selection s{};
    for (int f = 0; f < kBaseFamilies; ++f)
      s[f] = by_mass->order[f][static_cast<std::size_t>(x[static_cast<std::size_t>(f)])];
    return {incumbent->Try(s)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const double last = static_cast<double>(incumbent ? incumbent->base->size - 1 : 1);
    return {pagmo::vector_double(kBaseFamilies, 0.0), pagmo::vector_double(kBaseFamilies, last)};
  }
  pagmo::vector_double::size_type get_nix() const { return kBaseFamilies; }
};

Outcome RunGenetic(const BaseInstance& base, std::uint64_t seed, double) {
  Incumbent incumbent;
  incumbent.base = &base;
  const ByMass by_mass(base);
  const pagmo::problem problem{Udp{&incumbent, &by_mass}};
  pagmo::population population(problem, kPopulation, static_cast<unsigned>(seed));
  const pagmo::algorithm algorithm{pagmo::sga(kGenerations, 0.9, 1.0, 0.1, 1.0, 2u, "exponential",
                                              "uniform", "tournament",
                                              static_cast<unsigned>(seed))};
  algorithm.evolve(population);
  incumbent.outcome.total_s = Since(incumbent.start);
  return incumbent.outcome;
}

Outcome RunRandom(const BaseInstance& base, std::uint64_t seed, double) {
  Incumbent incumbent;
  incumbent.base = &base;
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> pick(0, base.size - 1);
  for (unsigned i = 0; i < kPopulation * kGenerations; ++i) {
    Selection s{};
    for (int& part : s) part = pick(random);
    incumbent.Try(s);
  }
  incumbent.outcome.total_s = Since(incumbent.start);
  return incumbent.outcome;
}

}  // namespace

Rival GeneticAlgorithm() {
  return {"pagmo sga", "five whole numbers, parts by mass; mass and a penalty, exact rise and fall",
          "population 100, 300 generations, crossover 0.9, mutation 0.1 uniform, tournament",
          RunGenetic};
}

Rival RandomSearch() {
  return {"random search", "five whole numbers, mass of the feasible ones", "30,000 draws",
          RunRandom};
}

}  // namespace plenum::bench
