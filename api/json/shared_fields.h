// Pieces of a request that several requests share: ambient, fractions, tables, pump curves.
#ifndef PLENUM_API_JSON_SHARED_FIELDS_H_
#define PLENUM_API_JSON_SHARED_FIELDS_H_

#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/json/units.h"
#include "model/flow/iso6358.h"
#include "model/physics/air.h"
#include "model/physics/compressor.h"

namespace plenum::api {

inline constexpr int kCountMax = 64;
inline constexpr double kExpansionMax = 1000.0;       // of an actuator's volume
inline constexpr double kGaugeMaxKpa = 5e4;           // sources, parts
inline constexpr double kOperatingGaugeMaxKpa = 1e4;  // actuators
inline constexpr double kRigGaugeMaxKpa = 1e5;        // rigs, whose gas may be dense

inline Range FrequencyRange() { return {1e-4, 100.0}; }
inline Range TubeLengthRange() { return {0.01, 100.0}; }

// What absolute pressures of the document are made gauge with from here on.
void TellAmbient(const model::Ambient& ambient);

// "ambient": 20–200 kPa absolute, 200–350 K; ISO 8778 where missing.
model::Ambient ReadAmbient(Reader& request);

// "rise" and "fall": { "to_fraction" }, in (0, 1] and [0, 1).
struct Fractions {
  double rise = 0.95;
  double fall = 0.05;
};
Fractions ReadFractions(Reader& request);

// "sonic_conductance_dm3_per_s_bar" and "critical_ratio" of one element.
model::FlowElement ReadPair(Reader& reader);

// Two columns of a list of points, in the order given.
struct Table {
  std::vector<double> x, y;
  bool valid = false;  // not empty and without an error
};
// Reads points { x_name, y_name } with x strictly rising; `direction` is the sign that steps of y
// may have.
Table ReadTable(Reader& owner, std::string_view list, std::size_t least, std::string_view x_name,
                Range x_range, std::string_view y_name, Range y_range, int direction);

// The name of group `index`, "group 1", … where missing; must not be in `names`, to which it adds.
std::string ReadName(Reader& group, std::size_t index, std::vector<std::string>& names);

// "curve": [{ "pressure_kpa_gauge", "free_air_l_per_min" }] without currents; of a vacuum pump up
// to ambient, as images.
model::CompressorCurve ReadPumpCurve(Reader& source, const model::Ambient& ambient,
                                     Side side = Side::kPressure);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_SHARED_FIELDS_H_
