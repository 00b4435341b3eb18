#include "api/protocol/protocols.h"

namespace plenum::api {

const std::vector<Protocol>& Protocols() {
  static const std::vector<Protocol> kProtocols{
      {"bottle_test", "compressor", {"free_air", "current", "pressure_max_kpa_gauge"}},
      {"duty_test", "compressor", {"duty_max"}},
      {"bottle_test",
       "valve",
       {"sonic_conductance_fill_dm3_per_s_bar", "critical_ratio_fill",
        "sonic_conductance_exhaust_dm3_per_s_bar", "critical_ratio_exhaust"}},
      {"switching_test", "valve", {"pressure_min_kpa_gauge", "coil_power_w"}},
      {"bottle_test", "fitting", {"sonic_conductance_dm3_per_s_bar", "critical_ratio"}},
      {"bottle_test", "regulator", {"sonic_conductance_dm3_per_s_bar", "critical_ratio"}},
      {"volume_test", "reservoir", {"internal_volume_ml"}},
      {"volume_test", "cylinder", {"water_volume_l", "fill_pressure_kpa_gauge"}},
      {"discharge_test", "battery", {"capacity_ah", "current_max_a"}}};
  return kProtocols;
}

}  // namespace plenum::api
