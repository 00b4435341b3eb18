// Random parts whose numbers trade off as real ones do: more flow, more air or more energy costs
// mass.
#ifndef PLENUM_TESTS_SUPPORT_RANDOM_PARTS_H_
#define PLENUM_TESTS_SUPPORT_RANDOM_PARTS_H_

#include <array>
#include <random>

#include "model/flow/parts.h"

namespace plenum::test {

inline constexpr double kAmbientPa = 1e5;
inline constexpr double kBar = 1e5;

// What tubes, fittings and valves are drawn from, so that some of them mate.
inline constexpr std::array<double, 3> kOuterDiameterM{3e-3, 4e-3, 6e-3};
inline constexpr std::array<const char*, 2> kThreads{"M5", "G1/8"};

using Random = std::mt19937_64;

double Uniform(Random& random, double low, double high);
double LogUniform(Random& random, double low, double high);
int Pick(Random& random, int low, int high);  // both ends included
bool Chance(Random& random, double share);

// How many parts of each family a catalogue gets.
struct CatalogueSize {
  int tubing = 2, fittings = 2, valves = 3, regulators = 2, cylinders = 2, co2 = 2, compressors = 2,
      batteries = 2, reservoirs = 1;
};

model::Parts RandomParts(Random& random, const CatalogueSize& size);

// Makes a pump draw less the higher the pressure, so that energy per air may fall with it.
void MakePowerFall(Random& random, model::CompressorCurve& curve);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_RANDOM_PARTS_H_
