// One stroke of `count` equal chambers that pumps fill through their lines, without a reservoir:
// the special case of the simulator that sizing asks for thousands of times.
//
// What lies between pumps and valves has no volume, so that its pressure p_n follows the chamber's
// p at each instant:
//   N·Q_c(p_n) = n·q(p_n, p),   dt/dp = W(p) / (P0·(T/T0)·q)
// with Q_c the delivery of one of N pumps (ANR) and q the flow of one of n lines. The left side
// does not rise with p_n and the right side rises from zero at p_n = p, so there is one root. It
// rises with p, and the flow falls: the stroke is slowest at its end. A line that passes more
// lowers p_n and a stronger pump raises it; both fill faster. Where pumps deliver more than the
// lines take up to the highest pressure that they reach, the rest is lost. Source: the quasi-static
// limit of a reservoir without volume (reservoir_stroke.h).
#ifndef PLENUM_MODEL_STROKES_PUMP_STROKE_H_
#define PLENUM_MODEL_STROKES_PUMP_STROKE_H_

#include "model/flow/series.h"
#include "model/physics/chamber.h"
#include "model/physics/compressor.h"

namespace plenum::model {

struct PumpStrokeInput {
  const Series* fill = nullptr;  // one line, with gas and temperature factor
  const Chamber* chamber = nullptr;
  int count = 1;
  const CompressorCurve* compressor = nullptr;
  int compressors = 1;
  double from_pa = 0.0;
  double target_pa = 0.0;     // rise time
  double operating_pa = 0.0;  // the valve closes and the pumps stop, ≥ target
  double temperature_k = kReferenceTemperatureK;
};

struct PumpStroke {
  bool reached = false;  // false: the pressures are never reached; nothing below is valid
  double rise_s = 0.0;
  double inflate_s = 0.0;      // the pumps run all the while
  double pump_energy_j = 0.0;  // all pumps
  double node_end_pa = 0.0;    // the highest between pumps and valves
};

// Pressure between pumps and valves while the chambers are at `chamber_pa`, and what flows into one
// of them, m³/s ANR.
struct PumpNode {
  double pressure_pa = 0.0;
  double flow_m3_per_s = 0.0;
};
PumpNode NodeBehindPumps(const PumpStrokeInput& input, double chamber_pa);

// To 1e-7 of times and energy.
PumpStroke FillFromPumps(const PumpStrokeInput& input);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_PUMP_STROKE_H_
