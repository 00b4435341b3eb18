// How much pumps can deliver while a stroke empties their reservoir.
//
// While the chambers of one group fill from a reservoir, its pressure p is at least theirs, so that
// no more is drawn than brings them to p: with m pumped since the stroke began at p_1,
//   V·p + D(p) ≥ V·p_1 + κ·m,   D(p) = n·[content(p) − content(p_a)].
// That bounds p(m) from below, up to p_1, and so the delivery Q(p(m)) from above. With an interval
// of volumes the smallest counts, since p is below p_1. Chambers that valves close at p_op take no
// more above it.
#ifndef PLENUM_OPTIMIZER_PUMP_MARCH_H_
#define PLENUM_OPTIMIZER_PUMP_MARCH_H_

#include <algorithm>

#include "optimizer/candidate.h"

namespace plenum::optimizer {

// D in Pa·m³, at most, for a line or a box of lines; `full_pa`: where chambers stop taking air.
double MostDrawn(const Problem& problem, int group, const Line& line, double pressure_pa,
                 double full_pa);

// Calls step(p, m³ ANR) for bits of air in the order in which they are pumped, each at p or above,
// until it returns false; the last bit has no end.
template <typename Drawn, typename Step>
void MarchPump(const Problem& problem, double start_pa, double reservoir_m3, const Drawn& drawn,
               const Step& step) {
  constexpr int kSteps = 20;
  const double ambient_pa = problem.ambient.pressure_pa;
  const double content_per_m3 =
      model::kReferencePressurePa * problem.ambient.temperature_k / model::kReferenceTemperatureK;
  const auto pumped_m3 = [&](double p) {
    return std::max(0.0, (drawn(p) - reservoir_m3 * (start_pa - p)) / content_per_m3);
  };
  double from_pa = ambient_pa, from_m3 = pumped_m3(ambient_pa);
  for (int i = 1; i <= kSteps; ++i) {
    const double to_pa = ambient_pa + (start_pa - ambient_pa) * i / kSteps;
    const double to_m3 = pumped_m3(to_pa);
    if (to_m3 > from_m3 && !step(from_pa, to_m3 - from_m3)) return;
    from_pa = to_pa;
    from_m3 = to_m3;
  }
  step(start_pa, kUnlimited);
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_MARCH_H_
