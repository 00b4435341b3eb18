// Parts as the search sees them: SI, absolute pressures, numbers only. The catalogue's rows with
// their provenance become these in api/.
//
// A part may stand for all that its tolerances allow: each number is then at its worst, and what
// counts at both of its ends has a slack or a spread beside it, which is 0 else.
#ifndef PLENUM_MODEL_FLOW_PARTS_H_
#define PLENUM_MODEL_FLOW_PARTS_H_

#include <optional>
#include <string>
#include <vector>

#include "model/flow/iso6358.h"
#include "model/physics/compressor.h"

namespace plenum::model {

struct PartBasics {
  std::string id;
  double mass_kg = 0.0;
  double body_volume_m3 = 0.0;     // outer envelope
  std::optional<double> cost_eur;  // none: not known
  std::string series = {};         // that its variants share; empty: it is its own
  double mass_slack_kg = 0.0;      // what it may weigh more; limits hold with it
  double body_volume_slack_m3 = 0.0;
  // Pieces, of a tube metres, that are sold together; 0: any number is sold. `cost_eur` is that of
  // one of them.
  double pack = 0.0;
  bool operator==(const PartBasics&) const = default;
};

// Mass, outer volume and cost of a tube are per metre.
struct Tubing {
  PartBasics per_metre;
  double outer_diameter_m = 0.0;
  double inner_diameter_m = 0.0;
  double pressure_max_pa = 0.0;
  bool operator==(const Tubing&) const = default;
};

struct Fitting {
  PartBasics basics;
  double tube_outer_diameter_m = 0.0;
  std::string thread;  // matches Valve::port
  FlowElement flow;
  double pressure_max_pa = 0.0;
  std::optional<FlowElement> flow_most = {};  // of tolerances; none: flow
  bool operator==(const Fitting&) const = default;
};

// How a valve serves one channel. A lone 3/2 cannot hold: closed to the source it vents.
enum class ValveKind {
  kThreeWay,      // 3/2: fill or vent; energised while filling and holding
  kPair,          // two 2/2, one for filling and one for venting; each energised while open
  kProportional,  // 3/3 or 5/3 with closed centre; energised while filling and while venting
  kVent,          // one 2/2 that vents an actuator which is fed past it; energised while it vents
};
inline bool Holds(ValveKind kind) { return kind != ValveKind::kThreeWay; }

struct Valve {
  PartBasics basics;
  ValveKind kind = ValveKind::kThreeWay;
  int channels = 1;
  std::string port;
  FlowElement fill;
  FlowElement exhaust;
  double coil_power_w = 0.0;  // per channel while energised
  double pressure_max_pa = 0.0;
  double pressure_min_pa = 0.0;    // at the inlet, to switch at all (pilot-operated valves)
  double closing_scatter_s = 0.0;  // it closes so much later than it is told to, at most
  std::optional<FlowElement> fill_most = {};  // of tolerances; none: fill
  bool operator==(const Valve&) const = default;
};

struct Compressor {
  PartBasics basics;
  CompressorCurve curve;
  double duty_max = 1.0;  // thermal limit on the share of time that it runs
  // Of an ejector, which has no motor (curve.voltage_v 0), while it runs, ANR.
  double air_consumption_m3_per_s = 0.0;
  // It lets air back while it is off, so that each feed has a check valve behind it; from so much
  // on that one opens, and so much lower are the pressures of `curve`, which are those behind it.
  std::optional<double> check_valve_cracking_pa = {};
  bool operator==(const Compressor&) const = default;
};

struct Battery {
  PartBasics basics;
  double nominal_voltage_v = 0.0;
  double capacity_ah = 0.0;
  double current_max_a = 0.0;
  bool operator==(const Battery&) const = default;
};

// Compressed air at ambient temperature; mass without the gas.
struct Cylinder {
  PartBasics basics;
  double water_volume_m3 = 0.0;
  double fill_pressure_pa = 0.0;
  double fill_pressure_spread_pa = 0.0;  // what a regulator may have to stand above it
  bool operator==(const Cylinder&) const = default;
};

// Liquid CO2 in a cartridge or bottle; mass without the CO2.
struct Co2Bottle {
  PartBasics basics;
  double co2_mass_kg = 0.0;
  double water_volume_m3 = 0.0;          // 0: not known
  double flow_sustained_m3_per_s = 0.0;  // over the mission
  double flow_endless_m3_per_s = 0.0;    // what it may give for ever; 0: not told apart
  bool operator==(const Co2Bottle&) const = default;
};

struct Regulator {
  PartBasics basics;
  FlowElement flow;
  double flow_max_m3_per_s = 0.0;      // +∞: no limit but the conductance
  double inlet_pressure_min_pa = 0.0;  // above it, and above the outlet, it regulates
  double inlet_pressure_max_pa = 0.0;
  double outlet_pressure_min_pa = 0.0;
  double outlet_pressure_max_pa = 0.0;
  double electrical_power_w = 0.0;
  bool operator==(const Regulator&) const = default;
};

struct Reservoir {
  PartBasics basics;
  double volume_m3 = 0.0;  // while it is drawn from
  double pressure_max_pa = 0.0;
  double volume_spread_m3 = 0.0;  // more while it is filled
  bool operator==(const Reservoir&) const = default;
};

// A manifold or a tee: joins so many lines, or pieces of a source, to one.
struct Manifold {
  PartBasics basics;
  int stations = 2;
  double sonic_conductance_m3_per_s_pa = 0.0;  // of its supply port
  double pressure_max_pa = 0.0;
  bool orderable = true;  // false: known to be no product
  bool operator==(const Manifold&) const = default;
};

// It passes air one way, once the pressure in front is so much higher.
struct CheckValve {
  PartBasics basics;
  double sonic_conductance_m3_per_s_pa = 0.0;
  double cracking_pressure_pa = 0.0;
  double pressure_max_pa = 0.0;
  bool operator==(const CheckValve&) const = default;
};

struct Parts {
  std::vector<Tubing> tubing;
  std::vector<Fitting> fittings;
  std::vector<Valve> valves;
  std::vector<Compressor> compressors;
  std::vector<Battery> batteries;
  std::vector<Cylinder> cylinders;
  std::vector<Co2Bottle> co2;
  std::vector<Regulator> regulators;
  std::vector<Reservoir> reservoirs;
  std::vector<Reservoir> tanks;          // the same parts, filled beforehand
  std::vector<Compressor> vacuum_pumps;  // curves over mirrored pressures (chamber.h)
  std::vector<Manifold> manifolds;
  std::vector<Compressor> ejectors;  // as vacuum_pumps
  std::vector<CheckValve> check_valves;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_PARTS_H_
