// Strokes of several groups of chambers that begin at once out of a reservoir that compressors
// refill meanwhile: where no effect acts this is what a simulation would tell of them, at a
// fraction of its cost.
//
//   dp_g/dt = P0·(T/T0)·q_g(p_s, p_g)/W_g(p_g)
//   dp_s/dt = P0·(T/T0)/V_r·(Q_c(p_s) − Σ n_g·q_g)
//
// with the signs of model/strokes/reservoir_stroke.h, until a valve closes at the operating
// pressure, or, where it cannot hold, when its time is over. The pumps run while p_s is below the
// stop pressure, and there for the share of time that covers the draw, which only falls. Nothing
// flows back out of a chamber. One that has come up to the reservoir rises with it, as far behind
// as its flow asks, until the reservoir falls or a valve closes.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_RESERVOIR_FILLING_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_RESERVOIR_FILLING_H_

#include <functional>
#include <span>
#include <vector>

#include "model/strokes/reservoir_stroke.h"
#include "model/strokes/stroke.h"

namespace plenum::optimizer {

// A group's stroke: all on one reservoir, with the same pumps, stop pressure and start.
struct StrokeOfMany {
  model::ReservoirStrokeInput line;
  double window_s = 0.0;  // its valve is open no longer than this
  // Finite where only rises are asked for, and whether each is in time: the strokes end once one is
  // late or all have come.
  double rise_limit_s = model::kNever;
};

struct ReservoirStrokes {
  bool done = false;  // false: too many steps, or told to stop; nothing below is valid
  // Per group; kNever: not reached within the window. Where an inflation is not, all else is not
  // known.
  std::vector<double> rise_s, inflate_s;
  std::vector<double> chamber_end_pa;                              // when its valve closes
  double reservoir_end_pa = 0.0, end_s = 0.0;                      // when the last one does
  double pump_on_s = 0.0, pump_energy_j = 0.0, pump_air_m3 = 0.0;  // until then
};

// To 3e-5 of the times and 1e-4 of the pumps' time, energy and air (against the simulator on random
// rigs); mostly far closer.
ReservoirStrokes FillFromReservoir(std::span<const StrokeOfMany> strokes,
                                   const std::function<bool()>& stop);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_RESERVOIR_FILLING_H_
