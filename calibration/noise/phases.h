// The phases of a run, as its valve commands cut it.
#ifndef PLENUM_CALIBRATION_NOISE_PHASES_H_
#define PLENUM_CALIBRATION_NOISE_PHASES_H_

#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

const char* Name(Phase phase);  // "rest", "rise", "hold", "fall"

struct PhaseSpan {
  Phase phase = Phase::kRest;
  int cycle = 0;  // inflations begun before or with this phase, less one; 0 before the first
  double start_s = 0.0, end_s = 0.0;
};

// From the first sample to the last, gapless, in order of time. Inflating is a rise, deflating a
// fall. A closed valve is a rest after a fall and a hold after a rise; before either it is a hold
// where the run starts more than 5 % of the operating gauge pressure above ambient (a leak-down
// test). Commands that repeat the state in force begin no phase. Empty without samples.
std::vector<PhaseSpan> PhasesOf(const Run& run);

// Index of the phase that holds the time; the later one at a border, the nearest outside.
std::size_t PhaseAt(const std::vector<PhaseSpan>& phases, double t_s);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_PHASES_H_
