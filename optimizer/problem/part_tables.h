// The fields of each family. Each number of the catalogue is here or in model::PartBasics, or no
// part of a search looks at it.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PART_TABLES_H_
#define PLENUM_OPTIMIZER_PROBLEM_PART_TABLES_H_

#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/problem/part_fields.h"

namespace plenum::optimizer {

namespace read {

template <auto get>
inline constexpr auto kTubing = &ValueIn<&model::Parts::tubing, get>;
template <auto get>
inline constexpr auto kFitting = &ValueIn<&model::Parts::fittings, get>;
template <auto get>
inline constexpr auto kValve = &ValueIn<&model::Parts::valves, get>;
template <auto get>
inline constexpr auto kCompressor = &ValueIn<&model::Parts::compressors, get>;
template <auto get>
inline constexpr auto kCylinder = &ValueIn<&model::Parts::cylinders, get>;
template <auto get>
inline constexpr auto kCo2 = &ValueIn<&model::Parts::co2, get>;
template <auto get>
inline constexpr auto kBattery = &ValueIn<&model::Parts::batteries, get>;
template <auto get>
inline constexpr auto kRegulator = &ValueIn<&model::Parts::regulators, get>;
template <auto get>
inline constexpr auto kReservoir = &ValueIn<&model::Parts::reservoirs, get>;
template <auto get>
inline constexpr auto kVacuumPump = &ValueIn<&model::Parts::vacuum_pumps, get>;
template <auto get>
inline constexpr auto kEjector = &ValueIn<&model::Parts::ejectors, get>;
template <auto get>
inline constexpr auto kManifold = &ValueIn<&model::Parts::manifolds, get>;
template <auto get>
inline constexpr auto kCheckValve = &ValueIn<&model::Parts::check_valves, get>;
template <auto get>
inline constexpr auto kTank = &ValueIn<&model::Parts::tanks, get>;

inline bool Holds(const model::Valve& valve) { return model::Holds(valve.kind); }
// What it lets by while it closes late: of two lines that differ by their valves alone one passes
// at most sqrt((1 − b')/(1 − b))·C/C' of the other where C ≥ C' and b ≥ b' (m = 0.5 of both, as of
// all valves of the catalogue), and by so much longer it may take for the same peak (closing.h).
inline double LetBy(const model::Valve& valve) {
  if (!model::Holds(valve.kind) || valve.closing_scatter_s == 0.0) return 0.0;
  const model::FlowElement most = valve.fill_most.value_or(valve.fill);
  return valve.closing_scatter_s * most.sonic_conductance_m3_per_s_pa /
         std::sqrt(1.0 - most.critical_ratio);
}
inline double PumpVoltage(const model::Compressor& pump) { return pump.curve.voltage_v; }
// Without any vacuum.
inline double SuctionFlow(const model::Compressor& ejector) {
  return ejector.curve.free_air_m3_per_s.y().front();
}
inline double PumpPressure(const model::Compressor& pump) { return pump.curve.pressure_max_pa; }
inline double FullPressure(const model::Cylinder& cylinder) {  // at most
  return cylinder.fill_pressure_pa + cylinder.fill_pressure_spread_pa;
}
inline double PackEnergy(const model::Battery& pack) {
  return model::UsableEnergy(pack.capacity_ah, pack.nominal_voltage_v);
}

}  // namespace read

inline constexpr PartField kTubingFields[] = {
    {.name = "outer_diameter_mm",
     .use = Use::kMate,
     .of = read::kTubing<&model::Tubing::outer_diameter_m>},
    {.name = "inner_diameter_mm",  // a wider bore passes more and takes more air
     .use = Use::kBoth,
     .of = read::kTubing<&model::Tubing::inner_diameter_m>,
     .weight = 2.5},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRating,
     .of = read::kTubing<&model::Tubing::pressure_max_pa>,
     .weight = 1.0},
};

inline constexpr PartField kFittingFields[] = {
    {.name = "tube_outer_diameter_mm",
     .use = Use::kMate,
     .of = read::kFitting<&model::Fitting::tube_outer_diameter_m>},
    {.name = "thread", .use = Use::kMate, .of = read::kFitting<&model::Fitting::thread>},
    {.name = "sonic_conductance_dm3_per_s_bar",
     .use = Use::kSharedFlow,
     .of = read::kFitting<&model::Fitting::flow>,
     .weight = 1.0,
     .ratio_weight = 1.0},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRating,
     .of = read::kFitting<&model::Fitting::pressure_max_pa>,
     .weight = 1.0},
};

inline constexpr PartField kValveFields[] = {
    {.name = "function", .use = Use::kBoth, .of = read::kValve<&read::Holds>},
    {.name = "port", .use = Use::kMate, .of = read::kValve<&model::Valve::port>},
    {.name = "channels", .use = Use::kRule, .of = read::kValve<&model::Valve::channels>},
    {.name = "sonic_conductance_fill_dm3_per_s_bar",
     .use = Use::kSharedFlow,
     .of = read::kValve<&model::Valve::fill>,
     .weight = 1.0,
     .ratio_weight = 1.0},
    {.name = "sonic_conductance_exhaust_dm3_per_s_bar",
     .use = Use::kSharedFlow,
     .of = read::kValve<&model::Valve::exhaust>,
     .weight = 0.5},
    {.name = "coil_power_w",
     .use = Use::kLess,
     .of = read::kValve<&model::Valve::coil_power_w>,
     .pieces = Pieces::kSum,
     .weight = 0.2,
     .weight_offset = 1e-3},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRating,
     .of = read::kValve<&model::Valve::pressure_max_pa>,
     .weight = 1.0},
    {.name = "pressure_min_kpa_gauge",
     .use = Use::kLess,
     .of = read::kValve<&model::Valve::pressure_min_pa>,
     .weight = 1.0},
    {.name = "response_time_ms", .use = Use::kLess, .of = read::kValve<&read::LetBy>},
};

// Several pumps are another pump, and a battery drives some: rules of the family.
inline constexpr PartField kCompressorFields[] = {
    {.name = "voltage_v", .use = Use::kRule, .of = read::kCompressor<&read::PumpVoltage>},
    {.name = "duty_max",
     .use = Use::kMore,
     .of = read::kCompressor<&model::Compressor::duty_max>,
     .weight = 1.0},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRule,
     .of = read::kCompressor<&read::PumpPressure>},
};

inline constexpr PartField kVacuumPumpFields[] = {
    {.name = "voltage_v", .use = Use::kRule, .of = read::kVacuumPump<&read::PumpVoltage>},
    {.name = "duty_max",
     .use = Use::kMore,
     .of = read::kVacuumPump<&model::Compressor::duty_max>,
     .weight = 1.0},
    {.name = "vacuum_max_kpa_gauge",
     .use = Use::kRule,
     .of = read::kVacuumPump<&read::PumpPressure>},
};

inline constexpr PartField kEjectorFields[] = {
    {.name = "suction_flow_l_per_min_anr",
     .use = Use::kRule,
     .of = read::kEjector<&read::SuctionFlow>},
    {.name = "air_consumption_l_per_min_anr",
     .use = Use::kLess,
     .of = read::kEjector<&model::Compressor::air_consumption_m3_per_s>,
     .pieces = Pieces::kSum},
    {.name = "vacuum_max_kpa_gauge", .use = Use::kRule, .of = read::kEjector<&read::PumpPressure>},
};

// The gas that a bottle gives depends on the regulators behind it: a rule of the family.
inline constexpr PartField kCylinderFields[] = {
    {.name = "water_volume_l",
     .use = Use::kRule,
     .of = read::kCylinder<&model::Cylinder::water_volume_m3>},
    {.name = "fill_pressure_kpa_gauge",  // the regulator must stand it
     .use = Use::kLess,
     .of = read::kCylinder<&read::FullPressure>,
     .weight = 0.5},
};

inline constexpr PartField kCo2Fields[] = {
    {.name = "co2_mass_kg", .use = Use::kRule, .of = read::kCo2<&model::Co2Bottle::co2_mass_kg>},
    {.name = "water_volume_l",
     .use = Use::kRule,
     .of = read::kCo2<&model::Co2Bottle::water_volume_m3>},
    {.name = "flow_sustained_l_per_min_anr",
     .use = Use::kMore,
     .of = read::kCo2<&model::Co2Bottle::flow_sustained_m3_per_s>,
     .pieces = Pieces::kSum,
     .weight = 0.5},
};

inline constexpr PartField kBatteryFields[] = {
    {.name = "capacity_ah",  // as usable energy, J
     .use = Use::kMore,
     .of = read::kBattery<&read::PackEnergy>,
     .pieces = Pieces::kSum,
     .weight = 1.0},
    {.name = "current_max_a",
     .use = Use::kMore,
     .of = read::kBattery<&model::Battery::current_max_a>,
     .pieces = Pieces::kSum,
     .weight = 0.3},
    {.name = "nominal_voltage_v",
     .use = Use::kMore,
     .of = read::kBattery<&model::Battery::nominal_voltage_v>},
};

inline constexpr PartField kRegulatorFields[] = {
    {.name = "sonic_conductance_dm3_per_s_bar",
     .use = Use::kFlow,
     .of = read::kRegulator<&model::Regulator::flow>,
     .weight = 1.0},
    {.name = "flow_max_l_per_min_anr",
     .use = Use::kMore,
     .of = read::kRegulator<&model::Regulator::flow_max_m3_per_s>},
    {.name = "inlet_pressure_min_kpa_gauge",
     .use = Use::kLess,
     .of = read::kRegulator<&model::Regulator::inlet_pressure_min_pa>,
     .weight = 0.5},
    {.name = "inlet_pressure_max_kpa_gauge",
     .use = Use::kMore,
     .of = read::kRegulator<&model::Regulator::inlet_pressure_max_pa>,
     .weight = 0.5},
    {.name = "outlet_pressure_min_kpa_gauge",
     .use = Use::kLess,
     .of = read::kRegulator<&model::Regulator::outlet_pressure_min_pa>},
    {.name = "outlet_pressure_max_kpa_gauge",
     .use = Use::kMore,
     .of = read::kRegulator<&model::Regulator::outlet_pressure_max_pa>,
     .weight = 0.5},
    {.name = "electrical_power_w",
     .use = Use::kLess,
     .of = read::kRegulator<&model::Regulator::electrical_power_w>,
     .weight = 0.2,
     .weight_offset = 1e-2},
};

inline constexpr PartField kReservoirFields[] = {
    {.name = "internal_volume_ml",  // a larger one droops less and takes longer to fill
     .use = Use::kBoth,
     .of = read::kReservoir<&model::Reservoir::volume_m3>,
     .pieces = Pieces::kSum,
     .weight = 8.0},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kMore,
     .of = read::kReservoir<&model::Reservoir::pressure_max_pa>,
     .weight = 0.1},
};

inline constexpr PartField kTankFields[] = {
    {.name = "internal_volume_ml",
     .use = Use::kMore,
     .of = read::kTank<&model::Reservoir::volume_m3>,
     .pieces = Pieces::kSum},
    {.name = "pressure_max_kpa_gauge",  // it is filled to that at most
     .use = Use::kMore,
     .of = read::kTank<&model::Reservoir::pressure_max_pa>},
};

// What joins lines follows from them: rules of the family.
inline constexpr PartField kManifoldFields[] = {
    {.name = "stations", .use = Use::kRule, .of = read::kManifold<&model::Manifold::stations>},
    {.name = "sonic_conductance_dm3_per_s_bar",
     .use = Use::kRule,
     .of = read::kManifold<&model::Manifold::sonic_conductance_m3_per_s_pa>},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRule,
     .of = read::kManifold<&model::Manifold::pressure_max_pa>},
};

inline constexpr PartField kCheckValveFields[] = {
    {.name = "sonic_conductance_dm3_per_s_bar",
     .use = Use::kRule,
     .of = read::kCheckValve<&model::CheckValve::sonic_conductance_m3_per_s_pa>},
    {.name = "cracking_pressure_kpa_gauge",
     .use = Use::kRule,
     .of = read::kCheckValve<&model::CheckValve::cracking_pressure_pa>},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRule,
     .of = read::kCheckValve<&model::CheckValve::pressure_max_pa>},
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PART_TABLES_H_
