// What the cells of valves mean: inflate, hold, deflate.
#ifndef PLENUM_API_MEASURE_CSV_VALVE_CELLS_H_
#define PLENUM_API_MEASURE_CSV_VALVE_CELLS_H_

#include "api/measure/csv/recording.h"

namespace plenum::api {

// Fills the states of each run, and the meanings of the columns of valves, or asks.
//   Words mean what they say (inflate, fill, vent, hold, …); open, on, true, 1 are a valve that is
//   switched on, closed, off, false, 0 one that is not; 1, 0, -1 are inflate, hold, deflate.
//   Numbers at two levels (0 V and 24 V) are on and off.
//   Of one valve on is inflate. Off is deflate if the pressure falls below a tenth after each
//   switch, soon, and hold if it stays above four fifths; anything else is asked.
//   Of two valves, one that fills and one that vents: both off is hold, both on an error.
//   The target of a column may say it: "valve [1 = inflate; 0 = hold]".
void FindValveStates(Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_VALVE_CELLS_H_
