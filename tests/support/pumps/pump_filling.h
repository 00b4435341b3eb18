// Chambers that pumps without a reservoir fill at once, by the laws alone: it shares no code with
// the model but for the ISO chain of iso_chain.h, which shares none either.
#ifndef PLENUM_TESTS_SUPPORT_PUMPS_PUMP_FILLING_H_
#define PLENUM_TESTS_SUPPORT_PUMPS_PUMP_FILLING_H_

#include <functional>
#include <vector>

#include "tests/support/flow/iso_chain.h"

namespace plenum::test {

struct PumpFilling {
  std::function<double(double)> delivery_m3_per_s;  // ANR, of all pumps, at absolute Pa
  std::function<double(double)> power_w = [](double) { return 0.0; };  // the same
  double highest_pa = 0.0;                                             // that they reach
  struct Group {
    int count = 1;
    std::function<double(double)> volume_m3;  // of one actuator with dead volume, at absolute Pa
    std::vector<MassElement> fill;            // in the order crossed
    double close_pa = 0.0;                    // its valve closes there
  };
  std::vector<Group> groups;
  double ambient_pa = 1e5;
  double temperature_k = kReferenceK;
  double linear_ratio = 1.0 - 1e-9;
};

struct PumpFilled {
  std::vector<double> seconds;  // to close_pa, by group
  double energy_j = 0.0;
  double node_end_pa = 0.0;  // between pumps and valves, at the very end
};

// From ambient until all valves are closed: classical Runge–Kutta in the masses, of one group in
// steps of its mass, of several in steps of time (`steps` in all, about).
PumpFilled FillByMasses(const PumpFilling& filling, int steps);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PUMPS_PUMP_FILLING_H_
