// The rig of a simulation, read from JSON: groups with their lines, source and valve schedules.
#ifndef PLENUM_API_SIMULATE_RIG_H_
#define PLENUM_API_SIMULATE_RIG_H_

#include <optional>
#include <vector>

#include "api/json/reader.h"
#include "api/json/units.h"
#include "catalog/fields/part.h"
#include "model/simulate/simulate.h"

namespace plenum::api {

// A line in both directions, each in the order crossed, and the bore volume of its tubes.
struct Line {
  std::vector<model::FlowElement> fill;
  std::vector<model::FlowElement> exhaust;
  double bore_volume_m3 = 0.0;
};

// Either one pair of C and b with optional "exhaust" pair and "tube" after it, or "elements" from
// source to actuator: pairs (with optional "exhaust"), tubes, or parts of the catalogue by id
// (tubing with "length_m", fitting, valve).
Line ReadLine(Reader& group, const std::vector<catalog::Part>& parts);

// "source": regulated, compressor, direct_pump (without a reservoir), tank (filled beforehand,
// without a pump) or none; of evacuated actuators regulated (a rail that stays), vacuum_pump,
// direct_vacuum_pump or none.
model::Source ReadSource(Reader& request, const model::Ambient& ambient,
                         Side side = Side::kPressure);

// "gas", air where it is not said.
model::Gas ReadGas(Reader& owner);

// "state" of a command.
model::ValveState ReadValveState(Reader& command);

// A schedule and how long it lasts, where it says so.
struct Schedule {
  std::vector<model::ValveCommand> commands;
  std::optional<double> duration_s;
};
// "valve" or "cycle" of the owner (the request or a group), none if it has neither.
std::optional<Schedule> ReadSchedule(Reader& owner);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_RIG_H_
