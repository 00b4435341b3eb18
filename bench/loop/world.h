// Hidden worlds: what the parts of a catalogue are in truth.
//
// Each number has one factor for all pieces of its part, a pump's delivery and its current one
// each: exp(σ·z), so that none changes its sign. σ is the uncertainty that the catalogue states, or
// else half of the half-width that a guarantee takes for the provenance
// (catalog/fields/half_width.h); the errors z are independent:
//   normal, drawn again until it is within 3; of the estimated numbers kFarShare from beyond,
//   uniform between 3 and 4 on either side.
// Numbers without a half-width (counts, diameters, nominal voltages, prices) are as printed.
#ifndef PLENUM_BENCH_LOOP_WORLD_H_
#define PLENUM_BENCH_LOOP_WORLD_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::bench {

inline constexpr double kFarShare = 0.05;

// Masses and outer volumes in truth. No test of plenum's tells them, so that kAsPrinted shows what
// caution costs and kDrawn what a scale for the whole catalogue would be worth besides.
enum class Weights { kDrawn, kAsPrinted };

// The error z of a number in a world; follows from its arguments alone.
double ErrorInDeviations(std::string_view world, const std::string& part, std::string_view field,
                         catalog::Provenance provenance);

// Of whatever else is drawn in a world.
std::uint64_t SeedOf(std::string_view world);

std::vector<catalog::Part> DrawWorld(std::vector<catalog::Part> rows, std::string_view world,
                                     Weights weights);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_LOOP_WORLD_H_
