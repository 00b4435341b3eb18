// A source whose pressure over time is given, such as the record of a sensor at the source.
//   p_s(t) = p_a + factor·(p(t) − p_a)
// with p(t) the straight lines through the record's points, and its first and last value outside.
// Steps of the simulator end at every point, so that no feature of the record is passed over: a
// noisy record costs a step or more a sample and should be condensed first. Above a relative
// tolerance of 1e-5 a step may pass up to seven points of a record of many. The check in the line
// passes what noise lifts and holds what it drops, so noise also biases a line near equal
// pressures.
#ifndef PLENUM_MODEL_SIMULATE_TOLD_DRIVEN_SOURCE_H_
#define PLENUM_MODEL_SIMULATE_TOLD_DRIVEN_SOURCE_H_

#include <vector>

namespace plenum::model {

struct DrivenSource {
  std::vector<double> time_s;       // rising
  std::vector<double> pressure_pa;  // absolute, as many
  double factor = 1.0;              // on the gauge pressure
  bool operator==(const DrivenSource&) const = default;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_TOLD_DRIVEN_SOURCE_H_
