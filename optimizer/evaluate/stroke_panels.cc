#include "optimizer/evaluate/stroke_panels.h"

#include <cmath>

#include "optimizer/problem/gait.h"

namespace plenum::optimizer {

StrokePanels MakeStrokePanels(const Problem& problem, int g, const model::Chamber& chamber) {
  const ActuatorGroup& group = problem.groups[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  const double target_pa = RiseTarget(problem, group);
  const double empty = model::Content(chamber, ambient_pa);
  const int count = FilledAtOnce(problem, g);
  const auto drawn = [&](double pressure_pa) {
    return count * (model::Content(chamber, pressure_pa) - empty);
  };
  StrokePanels panels;
  // Closer to each other towards the ends, where the flow drops fastest.
  const auto place = [&](int first, int panels_of, double from_pa, double to_pa) {
    for (int i = 0; i <= panels_of; ++i) {
      const double rest = 1.0 - static_cast<double>(i) / panels_of;
      panels.pressure_pa[first + i] = to_pa - (to_pa - from_pa) * rest * std::sqrt(rest);
    }
  };
  place(0, kStrokePanels, ambient_pa, target_pa);
  place(kStrokePanels, kLastStrokePanels, target_pa, group.chamber.operating_pressure_pa);
  for (int i = 0; i < kStrokeNodes; ++i) panels.drawn[i] = drawn(panels.pressure_pa[i]);
  for (int i = 0; i + 1 < kStrokeNodes; ++i) {
    const double low_pa = panels.pressure_pa[i], high_pa = panels.pressure_pa[i + 1];
    panels.middle_pa[i] = 0.5 * (low_pa + high_pa);
    if (chamber.evacuated) {
      // The centroid of W = a + b·p, which falls.
      const model::LinearContent law = model::LinearContentSlope(chamber);
      const double width_pa = high_pa - low_pa, mean = law.a + law.b * panels.middle_pa[i];
      panels.middle_pa[i] += law.b * width_pa * width_pa / (12.0 * mean);
    }
    panels.middle_drawn[i] = drawn(panels.middle_pa[i]);
  }
  return panels;
}

}  // namespace plenum::optimizer
