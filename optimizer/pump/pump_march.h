// How much pumps can deliver while a stroke empties their reservoir.
//
// While the chambers of one group fill from a reservoir, its pressure p is at least theirs, so that
// no more is drawn than brings them to p: with m pumped since the stroke began at p_1,
//   V·p + D(p) ≥ V·p_1 + κ·m,   D(p) = n·[content(p) − content(p_a)].
// That bounds p(m) from below, up to p_1, and so the delivery Q(p(m)) from above. With an interval
// of volumes the smallest counts, since p is below p_1. Chambers that valves close at p_op take no
// more above it.
#ifndef PLENUM_OPTIMIZER_PUMP_PUMP_MARCH_H_
#define PLENUM_OPTIMIZER_PUMP_PUMP_MARCH_H_

#include <algorithm>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {

// κ, Pa·m³ of content per m³ ANR.
inline double ContentPerVolume(const Problem& problem) {
  return model::kReferencePressurePa * problem.ambient.temperature_k /
         model::kReferenceTemperatureK;
}

// D in Pa·m³, at most, for a line or a box of lines; `full_pa`: where chambers stop taking air.
double MostDrawn(const Problem& problem, int group, const Line& line, double pressure_pa,
                 double full_pa);

// Calls step(from, to, m³ ANR) for bits of air in the order in which they are pumped, each at the
// pressures in between or above, until it returns false; the last bit has no end. Within a bit the
// air per pressure does not fall, if it does not in `drawn`, which is constant from `full_pa` on.
// `begun_m3` is pumped already.
template <typename Drawn, typename Step>
void MarchPump(const Problem& problem, double start_pa, double reservoir_m3, double full_pa,
               double begun_m3, const Drawn& drawn, const Step& step) {
  constexpr int kSteps = 8;
  constexpr double kTolerance = 1e-5;  // of the pressure from which on they pump
  const double content_per_m3 = ContentPerVolume(problem);
  const auto pumped_m3 = [&](double p) {
    return (drawn(p) - reservoir_m3 * (start_pa - p)) / content_per_m3 - begun_m3;
  };
  double from_pa = problem.ambient.pressure_pa;
  double from_m3 = std::max(0.0, pumped_m3(from_pa));
  if (from_m3 > 0.0) {
    if (!step(from_pa, from_pa, from_m3)) return;
  } else if (full_pa < start_pa && pumped_m3(full_pa) <= 0.0) {
    from_pa = start_pa - (drawn(start_pa) - begun_m3 * content_per_m3) / reservoir_m3;
  } else {
    const double high_pa = std::min(full_pa, start_pa);
    const auto missing = [&](double p) { return -pumped_m3(p); };
    const double least = missing(from_pa), most = missing(high_pa);
    if (most > 0.0)
      from_pa = high_pa;
    else if (least > 0.0)
      from_pa = NarrowBracket(missing, from_pa, least, high_pa, most, kTolerance).low;
  }
  const auto march = [&](double end_pa, int steps) {
    const double begin_pa = from_pa;
    for (int i = 1; i <= steps; ++i) {
      const double to_pa = begin_pa + (end_pa - begin_pa) * i / steps;
      const double to_m3 = pumped_m3(to_pa);
      if (to_m3 > from_m3 && !step(from_pa, to_pa, to_m3 - from_m3)) return false;
      from_pa = to_pa;
      from_m3 = std::max(from_m3, to_m3);
    }
    return true;
  };
  if (from_pa < full_pa && !march(std::min(full_pa, start_pa), kSteps)) return;
  if (full_pa < start_pa && !march(start_pa, 1)) return;
  step(start_pa, start_pa, kUnlimited);
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_PUMP_MARCH_H_
