// A second simulator of one actuator with physical effects, for comparison: it shares no code with
// the model.
//
// States are the masses of gas in the chamber, in the supply and in the line (kg) and the energy
// that the chamber's gas has taken up (J); pressure and temperature follow from inverting them:
//   isothermal      p·V = m·R·T_a
//   heat_transfer   p·V = (γ−1)·U, T = U/(m·c_v), U = U(0) + enthalpy in − out + heat − ∫p·dV
// Along the volume law ∫p·dV is a known function of the pressure, so U is inverted, not
// differentiated. Flow is the ISO 6358 mass flow  ṁ = C·ρ0·p1·√(T0/T1)·Ψ. Time goes in fixed small
// steps of classical Runge–Kutta that end at every command, end of a ramp and change of the play.
//
// Lines are one-way: gas passes `fill` only into the actuator and `exhaust` only out of it. Gas in
// the supply, the droop volume and the tube is at ambient temperature, gas that leaves the chamber
// at the chamber's. At the start the valve is shut, the volume is that of the initial pressure and
// at rest, creep is nil, the play is centred on the initial pressure, the droop volume has the
// pressure of the source, the tube and the sensor that of the chamber.
#ifndef PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_FORM_H_
#define PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_FORM_H_

#include <functional>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/effects/unlisted_effects.h"
#include "tests/support/mass_form.h"

namespace plenum::test {

// From the chamber to ambient, always; into the chamber where ambient is higher.
struct OrificeLeak {
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
};
struct LaminarLeak {
  double conductance = 0.0;  // G in q_anr = G·(p² − p_a²)/(2·P0), m³/(s·Pa)
};
struct PorousLeak {  // a·ṁ + c·ṁ² = p² − p_a²
  double viscous_pa2_s_per_kg = 0.0;
  double inertial_pa2_s2_per_kg2 = 0.0;
};

// V̈ + 2ζω·V̇ + ω²·(V − V_qs − V_c) = 0
struct Inertia {
  double natural_frequency_rad_per_s = 0.0;
  double damping_ratio = 0.0;
};

// τ·V̇_c = α·(V_qs − V0) − V_c
struct Creep {
  double fraction = 0.0;
  double time_constant_s = 0.0;
};

// A volume that the source refills through one element; the line draws from it.
struct SupplyDroop {
  double volume_m3 = 0.0;
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
};

// In series after the exhaust line; a ramp of the valve does not act on it.
struct ExhaustRestriction {
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
};

// V_qs = V0·[1 + (ε−1)·(x + a·x·(x−1) + s·sin(2πx)/(2π))]
struct Compliance {
  double curvature = 0.0;
  double s_amplitude = 0.0;
};

// A tube between the line and the chamber: a node of volume V_l = π·d²·L/4 that the line fills or
// empties, and a column of gas with inertia and laminar friction between node and chamber,
//   dq/dt = A/(ρ0·L)·(p_n − p) − 32·μ/(d²·ρ)·q,
// q in m³/s ANR, ρ the density at the mean of both pressures and ambient temperature.
struct LineDynamics {
  double inner_diameter_m = 0.0;
  double length_m = 0.0;
};

// x = (p − p_a)/(p_op − p_a). Absent effects do nothing. A blocked actuator keeps the rest volume:
// inertia, creep, hysteresis and compliance do nothing there, the wall's hA stays.
struct EffectRig {
  double rest_volume_m3 = 50e-6;
  double expansion_ratio = 2.0;
  double operating_pa = 2e5;
  bool blocked = false;
  double ambient_pa = 1e5;
  double ambient_k = 293.15;
  double initial_pa = 1e5;
  std::optional<double> initial_k;  // with heat_transfer only; else ambient

  enum class Source { kNone, kRegulated, kReservoir } source = Source::kRegulated;
  double source_pa = 3e5;                       // regulated, or the reservoir's at the start
  std::function<double(double)> source_course;  // of a regulated source over time, for source_pa
  double reservoir_m3 = 0.0;
  // What a compressor sends into the reservoir all the time: absolute Pa rising, m³/s ANR; straight
  // between the points, constant before them, nothing past them. Empty: none.
  std::vector<std::pair<double, double>> delivery;
  std::vector<MassElement> fill, exhaust;  // in the order crossed
  std::vector<MassCommand> schedule;

  std::optional<std::variant<OrificeLeak, LaminarLeak, PorousLeak>> leak;
  std::optional<Inertia> inertia;
  std::optional<Creep> creep;
  std::optional<double> hysteresis_half_width_pa;
  std::optional<double> heat_time_constant_s;  // at the operating pressure; infinite: adiabatic
  double valve_delay_s = 0.0;
  double valve_ramp_s = 0.0;
  double dead_volume_m3 = 0.0;
  std::optional<SupplyDroop> supply_droop;
  std::optional<ExhaustRestriction> exhaust_restriction;
  std::optional<Compliance> compliance;
  double sensor_lag_s = 0.0;
  double sensor_gain = 1.0;
  double sensor_offset_pa = 0.0;
  double cracking_pa = 0.0;
  double fill_factor = 1.0;  // directional_conductance
  std::optional<LineDynamics> line;
  UnlistedEffects unlisted;

  double linear_ratio = 0.999;  // above it flow falls to zero along a straight line
};

struct EffectResult {
  std::vector<double> t_s;
  std::vector<double> pressure_pa;    // in the chamber
  std::vector<double> measured_pa;    // ambient + what the sensor reads
  std::vector<double> volume_m3;      // with dead volume
  std::vector<double> temperature_k;  // in the chamber
  std::vector<double> supply_pa;      // that the line draws from
  std::vector<double> node_pa;        // at the line's end; the chamber's without line dynamics
  std::vector<double> filled_kg;      // into the line since time 0
  std::vector<double> emptied_kg;     // through the valve to ambient since time 0

  // Totals from time 0 to the last time.
  double source_kg = 0.0;     // out of the regulated source or the reservoir
  double delivered_kg = 0.0;  // by the compressor
  double exhaust_kg = 0.0;    // through the valve to ambient
  double leak_kg = 0.0;       // out, less what came in
  // Of the chamber's gas; heat and energy mean nothing without heat_transfer.
  double heat_j = 0.0;  // from the wall
  double work_j = 0.0;  // ∫p·dV
  double enthalpy_in_j = 0.0, enthalpy_out_j = 0.0;
  double gas_start_kg = 0.0, gas_kg = 0.0;  // in chambers, tube and droop volume
  double energy_start_j = 0.0, energy_j = 0.0;
};

// Runs from time 0 to the last of `times_s` (rising) in steps of at most `step_s`: 0.2 ms keeps
// pressures to 1e-7 of ambient, 0.1 ms with a tube; a shorter tube than 0.3 m needs shorter ones.
EffectResult SimulateEffects(const EffectRig& rig, const std::vector<double>& times_s,
                             double step_s);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_FORM_H_
