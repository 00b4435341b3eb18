// The peak of a valve that closes late, integrated in steps of classical Runge–Kutta over the
// content of the chamber, with the flow of iso_chain.h: shares no code with the search.
#ifndef PLENUM_TESTS_SUPPORT_LATE_CLOSING_H_
#define PLENUM_TESTS_SUPPORT_LATE_CLOSING_H_

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/flow/iso6358.h"
#include "model/physics/chamber.h"
#include "tests/support/flow/iso_chain.h"

namespace plenum::test {

struct LateLine {
  std::vector<model::FlowElement> fill;
  model::Chamber chamber;
  double late_s = 0.0, gas_factor = 1.0, temperature_k = 293.15;
};

inline double LatePeakPa(const LateLine& line, double source_pa) {
  constexpr int kSteps = 60;
  std::vector<MassElement> chain;
  for (const model::FlowElement& element : line.fill)
    chain.push_back({element.sonic_conductance_m3_per_s_pa * line.gas_factor,
                     element.critical_ratio, element.subsonic_index, 0.0});
  const double mirror_pa = line.chamber.evacuated ? 2.0 * line.chamber.ambient_pressure_pa : 0.0;
  // dp/dt = P0·(T/T0)·Q/W with W = d(pV)/dp by a difference.
  const auto slope = [&](double pa) {
    if (pa >= source_pa) return 0.0;
    const double up_pa = mirror_pa > 0.0 ? mirror_pa - pa : source_pa;
    const double down_pa = mirror_pa > 0.0 ? mirror_pa - source_pa : pa;
    const double q = ChainFlow(chain, up_pa, down_pa, 1.0, 1.0);
    const double step_pa = 1e-5 * pa;
    const double w =
        (model::Content(line.chamber, pa + step_pa) - model::Content(line.chamber, pa - step_pa)) /
        (2.0 * step_pa);
    return 1e5 * (line.temperature_k / kReferenceK) * q / w;
  };
  double pa = line.chamber.operating_pressure_pa;
  const double h = line.late_s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double k1 = slope(pa), k2 = slope(pa + 0.5 * h * k1), k3 = slope(pa + 0.5 * h * k2),
                 k4 = slope(pa + h * k3);
    pa = std::min(pa + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4), source_pa);
  }
  return pa;
}

// The highest source pressure, at most `most_pa`, whose peak is at most the limit.
inline double MostForPeakPa(const LateLine& line, double limit_pa, double most_pa) {
  if (most_pa <= limit_pa || LatePeakPa(line, most_pa) <= limit_pa) return most_pa;
  // The secant of both ends, of which one that stays counts half (Illinois).
  double low_pa = limit_pa, high_pa = most_pa;
  double below = LatePeakPa(line, low_pa) - limit_pa, above = LatePeakPa(line, high_pa) - limit_pa;
  int stayed = 0;
  while (high_pa - low_pa > 1e-3) {
    const double pa = high_pa - above * (high_pa - low_pa) / (above - below);
    const double beyond = LatePeakPa(line, pa) - limit_pa;
    if (std::abs(beyond) < 1e-4) return pa;
    if (beyond > 0.0) {
      high_pa = pa, above = beyond;
      below *= stayed == 1 ? 0.5 : 1.0;
      stayed = 1;
    } else {
      low_pa = pa, below = beyond;
      above *= stayed == -1 ? 0.5 : 1.0;
      stayed = -1;
    }
  }
  return 0.5 * (low_pa + high_pa);
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_LATE_CLOSING_H_
