// Runs that a bench could be asked for next: the rig of the data, its range of pressures, and
// schedules that show what others hide.
//
// Sources lie between the lowest and the highest of the data, and where the data have one alone, at
// that and at kLowerSource of it; the actuator goes at most to its operating pressure. Per source,
// blocked and free (where that differs): a stroke with a long hold and with a four times longer
// one, to half of the pressure too; three full cycles with a rest after; stairs up and down; ten
// short strokes. Without a source: closed, emptying or emptying in steps, from the highest initial
// pressure of the data and from half of it. The commands follow from how long the strokes take in a
// simulation given by the caller. Samples are as dense as in the data times `rate`,
// kProposalSamples at most. A sensor that reads to `highest_pa`, which may be infinite, is given
// less than that to read.
#ifndef PLENUM_CALIBRATION_EXPERIMENT_PROPOSALS_H_
#define PLENUM_CALIBRATION_EXPERIMENT_PROPOSALS_H_

#include <functional>
#include <string>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

inline constexpr int kProposalSamples = 4000;
inline constexpr double kLowerSource = 0.6;  // of the gauge pressure

struct Proposal {
  Run run;           // no readings
  std::string what;  // "inflate to 100 kPa, hold 6 s, deflate"
};

// Seconds that a stroke takes at the least: of a run whose only command inflates (deflates) at time
// 0, until the pressure has risen (fallen) to `level_pa`; infinite where it never does.
using StrokeTime = std::function<double(const Run& stroke, double level_pa)>;

// For the runs given, whose first is the pattern. Empty where no run has samples.
std::vector<Proposal> ProposeRuns(const Dataset& dataset, const std::vector<std::size_t>& runs,
                                  double rate, double highest_pa, const StrokeTime& stroke_time);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_EXPERIMENT_PROPOSALS_H_
