// Slips of the pen in a record, which would account for more than any missing physics: units,
// absolute pressures, exchanged commands, exchanged runs (slip_kinds.h).
//
// From what is declared: of each run E = Σ(m − y)²/Σ(m² + y²), m the model exactly as declared, y
// the readings, both gauge: 0 where they agree, about 1 where they have nothing in common. A slip
// is suspected where E is above kAstray and undoing the slip leaves less than kUndone of it, in all
// such runs or in some.
// Times in ms are looked for below kAstray, too, where readings are kSlowS and more apart: strokes
// that end between two readings by the model leave most of the record at rest, and E small.
// From what fits: where a search has come to an end and structure is left, the base model is fitted
// to the record with a slip undone in all runs, or with two runs exchanged. A slip is suspected
// where that leaves less than kUndone of the variance above the noise that the base model leaves of
// the record as written, and less than the chosen set of effects leaves; else where a search of the
// record with the slip undone comes to a set that leaves less than kUndone of that.
#ifndef PLENUM_CALIBRATION_LEARN_SLIPS_H_
#define PLENUM_CALIBRATION_LEARN_SLIPS_H_

#include <functional>
#include <string>
#include <vector>

#include "calibration/search/effect_search.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

inline constexpr double kAstray = 0.05;
inline constexpr double kUndone = 0.1;
inline constexpr double kAstrayInTime = 1e-3, kSlowS = 0.5;

// Of the slips of single runs the likeliest, and runs whose readings seem to be exchanged. A few
// simulations of each run.
std::vector<SuspectedSlip> SuspectedSlips(const Dataset& dataset,
                                          const std::function<bool()>& cancelled);

// The likeliest slip by what fits, or none. `base` and `chosen` are fits of the record as written.
std::vector<SuspectedSlip> SlipsThatFit(const FitData& data, const Fit& base, const Fit& chosen,
                                        const SearchOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_SLIPS_H_
