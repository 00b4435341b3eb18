#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace {

const NumberField kMass{"mass_kg", 1e-6, 500, true, "mass of one piece, empty"};
const NumberField kBody{"body_volume_ml", 1e-4, 1e6, true, "outer envelope of one piece"};
const NumberField kPrice{"price_eur", 0, 1e6, false, "price of one piece"};
// Of families that are kept but not yet chosen from, few data sheets give these.
const NumberField kMassIfKnown{"mass_kg", 1e-6, 500, false, "mass of one piece"};
const NumberField kBodyIfKnown{"body_volume_ml", 1e-4, 1e6, false, "outer envelope of one piece"};
const NumberField kPowerMin{"power_min_w", 1e-3, 1e4, false, "lowest electrical power printed"};
const NumberField kPowerMax{"power_max_w", 1e-3, 1e4, false, "highest electrical power printed"};
const NumberField kPressureMaxIfKnown{"pressure_max_kpa_gauge", 1, 5e4, false,
                                      "highest working pressure"};
const NumberField kVacuumMax{"vacuum_max_kpa_gauge", kVacuumMinKpaGauge, 0, false,
                             "deepest suction pressure, below ambient"};
const NumberField kConductanceIfKnown{"sonic_conductance_dm3_per_s_bar", 1e-6, 1e4, false,
                                      "sonic conductance C"};
const NumberField kRatioIfKnown{"critical_ratio", 0, 0.95, false, "critical pressure ratio b"};

const NumberField kPressureMax{"pressure_max_kpa_gauge", 1, 5e4, true, "highest working pressure"};

NumberField Conductance(std::string_view name, std::string_view meaning) {
  return {name, 1e-6, 1e4, true, meaning};
}
NumberField Ratio(std::string_view name) {
  return {name, 0, 0.95, true, "critical pressure ratio b"};
}

const TextField kCheckValve{
    "check_valve", false, {"yes", "no"}, "whether it keeps air from flowing back while it is off"};

// Vacuum pumps are searched; ejectors and what follows are kept, found, imported and exported, and
// wait for it.
std::vector<Family> VacuumSources() {
  return {
      {"vacuum_pump",
       {{"voltage_v", 1, 60, true, "voltage at which the curve was taken"},
        {"duty_max", 0.01, 1, false, "thermal limit on the share of time that it runs"},
        kPowerMin,
        kPowerMax,
        kVacuumMax,
        kMassIfKnown,
        kBodyIfKnown,
        kPrice,
        {"pressure_max_kpa_gauge", 1, 5e4, false, "highest pressure where it also compresses"}},
       {{"type", false, {}, "principle"}, kCheckValve},
       CurveKind::kSuction},
      {"ejector",
       {{"suction_flow_l_per_min_anr", 1e-3, 1e5, false, "suction flow without vacuum"},
        kVacuumMax,
        {"air_consumption_l_per_min_anr", 1e-3, 1e5, false, "air drawn at its supply pressure"},
        {"supply_pressure_kpa_gauge", 1, 2e3, false, "supply pressure that the numbers hold for"},
        {"nozzle_diameter_mm", 0.1, 20, false, "bore of the nozzle"},
        {"stages", 1, 10, false, "stages"},
        kMassIfKnown,
        kBodyIfKnown,
        kPrice},
       {{"port", false, {}, "thread or tube of the suction port"}}},
  };
}

std::vector<Family> Connections() {
  return {
      {"manifold",
       {{"stations", 1, 64, true, "valves or lines that it takes"},
        kConductanceIfKnown,
        kRatioIfKnown,
        kMassIfKnown,
        kBodyIfKnown,
        kPrice,
        kPressureMaxIfKnown},
       {{"takes", false, {}, "series of the valves that sit on it"},
        {"inlet", false, {}, "thread of the supply port"},
        {"port", false, {}, "thread or tube of each outlet"}}},
      {"check_valve",
       {kConductanceIfKnown,
        kRatioIfKnown,
        {"cracking_pressure_kpa_gauge", 0, 5e3, false, "pressure difference from which it opens"},
        kMassIfKnown,
        kBodyIfKnown,
        kPrice,
        kPressureMaxIfKnown},
       {{"port", false, {}, "thread or tube"}}},
      {"relief_valve",
       {{"relief_pressure_min_kpa_gauge", 0.1, 5e4, false, "lowest setting"},
        {"relief_pressure_max_kpa_gauge", 0.1, 5e4, false, "highest setting"},
        kConductanceIfKnown,
        kRatioIfKnown,
        kMassIfKnown,
        kBodyIfKnown,
        kPrice},
       {{"port", false, {}, "thread"}}},
      {"silencer",
       {kConductanceIfKnown, kRatioIfKnown, kMassIfKnown, kBodyIfKnown, kPrice,
        kPressureMaxIfKnown},
       {{"port", false, {}, "thread"}}},
  };
}

std::vector<Family> FamiliesOfTheSearch() {
  return {
      {"tubing",
       {{"outer_diameter_mm", 0.5, 100, true, "outer diameter"},
        {"inner_diameter_mm", 0.3, 30, true, "bore"},
        {"mass_kg_per_m", 1e-6, 10, true, "mass per metre"},
        {"price_eur_per_m", 0, 1e4, false, "price per metre"},
        kPressureMax},
       {{"material", false, {}, "material"}}},
      {"fitting",
       {{"tube_outer_diameter_mm", 0.5, 100, true, "outer diameter of the tube it takes"},
        Conductance("sonic_conductance_dm3_per_s_bar", "sonic conductance C of one fitting"),
        Ratio("critical_ratio"),
        kMass,
        kBody,
        kPrice,
        kPressureMax},
       {{"thread", true, {}, "thread, matches a valve's port"}, {"style", false, {}, "shape"}}},
      {"valve",
       {{"channels", 1, 64, true, "actuators that one piece serves"},
        Conductance("sonic_conductance_fill_dm3_per_s_bar", "sonic conductance C when filling"),
        Ratio("critical_ratio_fill"),
        Conductance("sonic_conductance_exhaust_dm3_per_s_bar", "sonic conductance C when venting"),
        Ratio("critical_ratio_exhaust"),
        {"coil_power_w", 0, 1e3, true, "electrical power per channel while energised"},
        {"pressure_min_kpa_gauge", 0, 5e4, false, "lowest inlet pressure at which it switches"},
        {"response_time_ms", 0, 1e4, false, "time from command to open"},
        kMass,
        kBody,
        kPrice,
        kPressureMax},
       {{"function", true, {"3/2", "2/2 pair", "proportional", "2/2"}, "how one channel is served"},
        {"port", true, {}, "thread of the port to the actuator"},
        {"vacuum_rated", false, {"yes", "no"}, "whether it works with a vacuum at its inlet"}}},
      {"compressor",
       {{"voltage_v", 1, 60, true, "voltage at which the curve was taken"},
        {"duty_max", 0.01, 1, true, "thermal limit on the share of time that it runs"},
        kPowerMin,
        kPowerMax,
        kVacuumMax,
        kMass,
        kBody,
        kPrice,
        kPressureMax},
       {{"type", false, {}, "principle"}, kCheckValve},
       CurveKind::kPressure},
      {"cylinder",
       {{"water_volume_l", 0.01, 100, true, "inner volume"},
        {"fill_pressure_kpa_gauge", 100, 5e4, true, "fill pressure"},
        kMass,
        kBody,
        kPrice},
       {{"material", false, {}, "material"}}},
      {"co2",
       {{"co2_mass_kg", 1e-3, 50, true, "liquid CO2 when full"},
        {"water_volume_l", 0.005, 100, false, "inner volume"},
        {"flow_sustained_l_per_min_anr", 1e-3, 1e4, true, "sustained draw without heating"},
        kMass,
        kBody,
        kPrice},
       {{"thread", false, {}, "neck thread"}}},
      {"battery",
       {{"cells_series", 1, 24, true, "cells in series"},
        {"nominal_voltage_v", 1, 100, true, "nominal voltage of the pack"},
        {"capacity_ah", 0.01, 1e3, true, "capacity"},
        {"current_max_a", 0.01, 1e4, true, "continuous current limit"},
        kMass,
        kBody,
        kPrice},
       {{"chemistry", false, {}, "cell chemistry"}}},
      {"regulator",
       {Conductance("sonic_conductance_dm3_per_s_bar", "sonic conductance C, inlet to outlet"),
        Ratio("critical_ratio"),
        {"flow_max_l_per_min_anr", 1e-3, 1e6, false, "flow limit, if below what C allows"},
        {"inlet_pressure_min_kpa_gauge", 0, 5e4, true, "lowest inlet pressure that regulates"},
        {"inlet_pressure_max_kpa_gauge", 1, 5e4, true, "highest inlet pressure"},
        {"outlet_pressure_min_kpa_gauge", 0, 5e4, true, "lowest outlet setting"},
        {"outlet_pressure_max_kpa_gauge", 1, 5e4, true, "highest outlet setting"},
        {"electrical_power_w", 0, 1e3, true, "electrical power, 0 for a mechanical regulator"},
        kMass,
        kBody,
        kPrice},
       {{"type", false, {}, "principle"}}},
      {"reservoir",
       {{"internal_volume_ml", 1, 1e6, true, "inner volume"}, kMass, kBody, kPrice, kPressureMax},
       {{"material", false, {}, "material"}, {"port", false, {}, "thread"}}},
  };
}

}  // namespace

std::vector<Family> OwnFamilies() {
  std::vector<Family> families = FamiliesOfTheSearch();
  for (const auto& waiting : {VacuumSources(), Connections()})
    families.insert(families.end(), waiting.begin(), waiting.end());
  return families;
}

const Family* FindFamily(std::string_view name) {
  for (const Family& family : Families())
    if (family.name == name) return &family;
  return nullptr;
}

}  // namespace plenum::catalog
