// One stroke of `count` equal chambers out of a reservoir that compressors refill meanwhile: the
// special case of the simulator that sizing asks for thousands of times.
//
// Integrated over the chamber pressure p instead of time, so that the targets are the end points:
//   dt/dp  = W(p) / (P0·(T/T0)·q(p_s, p))
//   dp_s/dp = P0·(T/T0)/V_r · (Q_c(p_s) − n·q) · dt/dp
// with q the flow of one line and Q_c the delivery of all pumps, which run while p_s is below the
// stop pressure and there for the share of time that covers the draw. Where the reservoir has
// fallen to the chamber's pressure both fill as one volume. Pressures order themselves: a higher
// start, a stronger pump or, as long as the reservoir falls, a larger reservoir gives a higher p(t)
// at every t.
//
// A valve that cannot hold stays open after the operating pressure for the rest of its time, and
// the chambers go on filling: their pressure at its end is found where t comes to that time. They
// never pass the stop pressure.
#ifndef PLENUM_MODEL_STROKES_RESERVOIR_STROKE_H_
#define PLENUM_MODEL_STROKES_RESERVOIR_STROKE_H_

#include "model/flow/flow_table.h"
#include "model/physics/chamber.h"
#include "model/physics/compressor.h"

namespace plenum::model {

struct ReservoirStrokeInput {
  const FlowTable* fill = nullptr;
  const Chamber* chamber = nullptr;
  int count = 1;
  const CompressorCurve* compressor = nullptr;
  int compressors = 1;
  // The pumps stop here; at most the compressor's HighestPressure.
  double stop_pa = 0.0;
  // The volume that counts while the reservoir falls and while it rises. Equal for a simulation; an
  // interval of volumes [V1, V2] with V2 falling and V1 rising gives a time below that of each
  // volume between (the right-hand side is larger everywhere, and the system keeps order), and one
  // with V1 falling and V2 rising a reservoir below that of each
  // (optimizer/pump/settings_bounds.h).
  double volume_falling_m3 = 0.0;
  double volume_rising_m3 = 0.0;
  double from_pa = 0.0;
  double target_pa = 0.0;     // rise time
  double operating_pa = 0.0;  // the valve closes, ≥ target
  double open_s = 0.0;        // a valve that cannot hold closes no sooner than this
  double temperature_k = kReferenceTemperatureK;
  double start_pa = 0.0;  // of the reservoir, at most stop_pa; 0: it is full
};

struct ReservoirStroke {
  bool reached = false;  // false: the pressures are never reached; nothing below is valid
  double rise_s = 0.0;
  double inflate_s = 0.0;
  // When the valve closes.
  double reservoir_end_pa = 0.0, chamber_end_pa = 0.0;
  double pump_on_s = 0.0;      // while it is open
  double pump_energy_j = 0.0;  // while it is open, all pumps
  double pump_air_m3 = 0.0;    // the same, m³ ANR
};

// To 1e-6 of the times and the energy (against the simulator on random rigs). Without a reservoir
// volume nothing is reached.
ReservoirStroke FillFromReservoir(const ReservoirStrokeInput& input);

// Time for `compressors` pumps to bring a closed volume from `low_pa` to `high_pa`; +∞ where the
// delivery vanishes on the way or `high_pa` is above HighestPressure, which itself is reached.
double PumpUpTime(const CompressorCurve& curve, int compressors, double volume_m3, double low_pa,
                  double high_pa, double temperature_k);

// Pressure of such a volume after so long, at most `stop_pa`, where the pumps stop.
double PressureAfterPumping(const CompressorCurve& curve, int compressors, double volume_m3,
                            double low_pa, double stop_pa, double seconds, double temperature_k);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_RESERVOIR_STROKE_H_
