// A second simulator, for comparison: it shares no code with the model.
//
// States are masses of gas (kg) in each actuator and in the reservoir. The pressure follows from
// inverting m = p·V(p)/(R·T); flow is the ISO 6358 mass flow  ṁ = C·ρ0·p1·√(T0/T1)·Ψ, lines are
// solved by bisection on the mass flow, and time goes in fixed small steps of classical
// Runge–Kutta. A switch inside a step is found by bisection on the length of the step.
#ifndef PLENUM_TESTS_SUPPORT_MASS_FORM_H_
#define PLENUM_TESTS_SUPPORT_MASS_FORM_H_

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/flow/iso_chain.h"

namespace plenum::test {

struct MassCommand {
  double time_s = 0.0;
  int direction = 0;  // +1 inflate, 0 hold, −1 deflate
};

struct MassGroup {
  int count = 1;
  std::function<double(double)> volume_m3;  // of one actuator with dead volume, at absolute Pa
  std::vector<MassElement> fill, exhaust;   // in the order crossed
  std::vector<MassCommand> schedule;
  double initial_pa = 1e5;
  double operating_pa = 0.0;
  bool close_at_operating = false;
};

struct MassRig {
  double ambient_pa = 1e5;
  double temperature_k = 293.15;
  double gas_factor = 1.0;  // on the standard volume flow of every element
  std::vector<MassGroup> groups;

  enum class Source { kNone, kRegulated, kReservoir } source = Source::kNone;
  double source_pa = 0.0;              // regulated, or the reservoir's at the start
  std::vector<MassElement> regulator;  // none or one, shared
  double flow_max_m3_per_s = std::numeric_limits<double>::infinity();  // ANR

  double reservoir_m3 = 0.0;
  // Delivery of all pumps together while running: absolute Pa rising, m³/s ANR; straight between
  // the points, constant before them. Empty: none.
  std::vector<std::pair<double, double>> delivery;
  double stop_pa = std::numeric_limits<double>::infinity();

  double linear_ratio = 0.999;  // above it flow falls to zero along a straight line
};

struct MassResult {
  std::vector<double> t_s;
  std::vector<std::vector<double>> pressure_pa;  // by group, at t_s
  std::vector<double> source_pa;
  double delivered_kg = 0.0;  // by the pumps, or by the regulated source
  double vented_kg = 0.0;
  double gas_kg = 0.0;        // in all actuators and the reservoir at the end
  double gas_start_kg = 0.0;  // the same at the start
};

// Runs to `end_s` in steps of at most `step_s`, with one sample every `sample_s`.
MassResult SimulateMasses(const MassRig& rig, double end_s, double step_s, double sample_s);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_MASS_FORM_H_
