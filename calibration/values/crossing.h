// Which way gas crosses the line of a run, and the pressures at the line's far end.
//
// The simulator knows one way: from a source into the chamber, and out to what the line exhausts
// into. A run whose source is below the ambient pressure is simulated with both exchanged: its
// inflate command opens the line out to the source, its deflate command lets gas in.
#ifndef PLENUM_CALIBRATION_VALUES_CROSSING_H_
#define PLENUM_CALIBRATION_VALUES_CROSSING_H_

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// The source is below the ambient pressure.
bool Evacuates(const Run& run);

// Whether the pressure between a flow controller and the line is recorded, or one within the line:
// these alone show what the line conducts while the controller lets in what it is told.
bool RecordsNode(const Run& run);

// The piece with the pair that gas crosses into the chamber as `fill`.
LinePiece AsCrossed(LinePiece piece, const Run& run);

// kInflate where gas crosses the line into the chamber.
model::ValveState AsCrossed(model::ValveState state, const Run& run);

// Absolute, above 0: of the source with a factor on its gauge pressure, and of what the line
// exhausts into, both where the ambient pressure is higher by `shift_pa` than declared.
double SourcePressure(const Run& run, double factor, double shift_pa);
double ExhaustPressure(const Run& run, double shift_pa);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_CROSSING_H_
