// The periodic steady state of a rig whose schedules repeat, found directly.
//
// With F the map from the state at the start of a period to the state at its end, the periodic
// state is x = F(x). One evaluation of F is one simulated period. Plain iteration is what the rig
// itself does; it takes many periods where a mode decays slowly (a reservoir much larger than the
// draw, creep or heat over many periods). Anderson acceleration (model/integrate/anderson.h) jumps
// ahead; a jump that leaves the physical bounds, fails or makes the residual grow is undone, and
// the rig goes on by itself from the best period so far.
//
// What a valve is doing at the end of a period (its command, delayed moves, ramps, whether it still
// waits for the operating pressure) is no part of x: it is handed on to the next period as it is,
// and must repeat as well. Pumps and effects choose their modes anew from the state.
//
// Where several states are periodic (groups that nothing fills or vents, a play of hysteresis wider
// than the swing, a reservoir above its stop pressure from which nothing draws), the result is one
// that the rig's initial state leads to or near; convergence says nothing about the others, nor
// about stability. A rig may also repeat only after several periods, or never (a valve that closes
// on reaching the operating pressure may leave out a stroke after a long one): not converged. Where
// a source is too weak, the periodic state has strokes that never reach their target: +∞.
#ifndef PLENUM_MODEL_SIMULATE_PERIODIC_H_
#define PLENUM_MODEL_SIMULATE_PERIODIC_H_

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/simulate/simulate.h"

namespace plenum::model {

struct PeriodicOptions {
  // Converged when, for every state, |F(x) − x| and the step of the acceleration, which estimates
  // the distance to the periodic state, are ≤ tolerance·size; size: a pressure itself, otherwise
  // the typical size. The simulator's own error must be smaller: it runs with a relative tolerance
  // of at most a tenth of this.
  double tolerance = 1e-9;
  int cycles_max = 300;  // simulated before giving up
  int depth = 5;         // of the acceleration; 0: plain iteration
};

// kFailed: a period could not be simulated. kInvalid: bad input, nothing was done.
enum class PeriodicStatus { kNotRun, kConverged, kNotConverged, kCancelled, kFailed, kInvalid };

struct WorstStroke {
  double to_target_s = 0.0;  // +∞: not reached before the group's next command
  int group = 0;
  double command_s = 0.0;
};

struct WorstStrokes {
  std::optional<WorstStroke> rise, fall;  // none: no such command
};

struct PeriodicState {
  PeriodicStatus status = PeriodicStatus::kNotRun;
  std::string detail;         // for any status but kConverged: why
  std::vector<double> state;  // at the start of the period, as Run::Execute takes it
  double residual = std::numeric_limits<double>::infinity();        // max |F(x) − x|/size
  double error_estimate = std::numeric_limits<double>::infinity();  // max |step|/size
  int cycles = 0;                                                   // simulated in all
  // The rest only when converged. One period; the strokes are those commanded in it, followed into
  // the next one as far as they need.
  Response response;
  std::vector<WorstStrokes> groups;
  WorstStrokes all;
  double compressor_duty = 0.0;    // mean share of time that each pump runs
  double air_drawn_m3 = 0.0;       // ANR, from the source, per period
  double compressor_air_m3 = 0.0;  // ANR, delivered, per period
  double compressor_energy_j = 0.0;
  double source_lowest_pressure_pa = 0.0;  // in the period; 0 without a source
};

// The schedules of the rig hold the commands of one period, in [0, period_s); commands before 0 are
// left out, since the repetition says what they are. The rig's initial state is where the search
// begins. `simulate.end_s` is not used; `sample_hz` samples the converged period. Never throws for
// a physical reason.
PeriodicState FindPeriodicState(const Rig& rig, double period_s, const SimulateOptions& simulate,
                                const PeriodicOptions& options = {});

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_PERIODIC_H_
