// A design as a rig for the simulator. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RIG_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RIG_H_

#include <vector>

#include "model/simulate/simulate.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

struct State {
  double source_pa = 0.0;
  std::vector<double> unit_pa;
};

// One unit with the commands of so many periods.
model::GroupRig MakeGroup(const Problem& problem, const Assembly& assembly, const Unit& unit,
                          double pressure_pa, int periods);
// All of them, in the order of UnitsOf(), and the source.
model::Rig MakeRig(const Problem& problem, const Settings& settings, const Assembly& assembly,
                   const State& state, int periods, double rising_m3);
model::SimulateOptions OptionsOf(const Problem& problem, double end_s, const Stop& stop);

// On every conductance, by gas and temperature.
double FactorOf(const Problem& problem, Configuration configuration);

// Strokes count from ambient: an actuator that would still hold air at its next one gets a wider
// exhaust. How fast it empties is nothing to the source.
void EmptyBeforeNext(const Problem& problem, const Settings& settings, const Assembly& assembly,
                     model::Rig& rig);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_RIG_H_
