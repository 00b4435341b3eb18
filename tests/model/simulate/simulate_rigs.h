// Small rigs for the tests of the simulator.
#ifndef PLENUM_TESTS_MODEL_SIMULATE_SIMULATE_RIGS_H_
#define PLENUM_TESTS_MODEL_SIMULATE_SIMULATE_RIGS_H_

#include <limits>
#include <utility>
#include <vector>

#include "model/simulate/simulate.h"

namespace plenum::model {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

// A group of one 50 mL actuator through one element.
inline GroupRig OneActuator(double operating_pa, double expansion_ratio, FlowElement element) {
  GroupRig group;
  group.chamber.rest_volume_m3 = 50e-6;
  group.chamber.expansion_ratio = expansion_ratio;
  group.chamber.operating_pressure_pa = operating_pa;
  group.fill = {element};
  group.exhaust = {element};
  return group;
}

inline Rig RigOf(Source source, std::vector<GroupRig> groups) {
  Rig rig;
  rig.source = std::move(source);
  rig.groups = std::move(groups);
  return rig;
}

inline SimulateOptions Until(double end_s, double sample_hz = 0.0) {
  SimulateOptions options;
  options.end_s = end_s;
  options.sample_hz = sample_hz;
  return options;
}

inline RegulatedSource Regulated(double pressure_pa) { return {.pressure_pa = pressure_pa}; }

}  // namespace plenum::model

#endif  // PLENUM_TESTS_MODEL_SIMULATE_SIMULATE_RIGS_H_
