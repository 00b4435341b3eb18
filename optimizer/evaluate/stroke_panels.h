// Pressures that divide the filling of a chamber for a march panel by panel (stroke_bound.h).
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKE_PANELS_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKE_PANELS_H_

#include <array>

#include "model/physics/chamber.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

inline constexpr int kStrokePanels = 12;     // up to the rise target
inline constexpr int kLastStrokePanels = 4;  // from there to the operating pressure
inline constexpr int kStrokeNodes = kStrokePanels + kLastStrokePanels + 1;

// Where panels begin and end and their middles (of evacuated chambers the centroids of W), Pa, and
// what the chambers of the group that fill at once have drawn there since they began at ambient, as
// content, Pa·m³.
struct StrokePanels {
  std::array<double, kStrokeNodes> pressure_pa{}, drawn{};
  std::array<double, kStrokeNodes - 1> middle_pa{}, middle_drawn{};
};

// `chamber`: of the group, with the dead volume of its line.
StrokePanels MakeStrokePanels(const Problem& problem, int group, const model::Chamber& chamber);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKE_PANELS_H_
