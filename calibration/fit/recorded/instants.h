// Commands whose instants are not known exactly (Recorded of dataset.h).
//
// An instant of known uncertainty is fitted with a normal prior about the recorded one, within
// kInstantSigmas: by an error of its own, and by one that all commands to the same state of the
// valve share, each in its own uncertainty (a logger that is late is so each time); half of the
// variance is of either. Where a run's commands times its readings are more than kOwnInstantsMax,
// as each is a derivative of all readings, only the shared ones are fitted. An instant that is not
// known is fitted anywhere between its neighbours, from a guess. The guess is
// that of all instants in the order of the commands at which the curve bends most,
//   max Σ s_k·(slope after t_k − slope before t_k),  s_k = sign of the change of the valve's state,
// over hold 0, towards higher pressures 1, towards lower ones −1; slopes by least squares over a
// few readings on either side, the maximum by dynamic programming over readings and commands.
#ifndef PLENUM_CALIBRATION_FIT_RECORDED_INSTANTS_H_
#define PLENUM_CALIBRATION_FIT_RECORDED_INSTANTS_H_

#include <vector>

#include "calibration/fit/coordinates.h"

namespace plenum::calibration {

inline constexpr double kInstantSigmas = 5.0;
inline constexpr std::size_t kOwnInstantsMax = 40'000;  // of a run, times its readings

// Of the runs given. A command that changes nothing has none.
std::vector<Coordinate> InstantCoordinates(const Dataset& dataset,
                                           const std::vector<std::size_t>& runs);

// What several commands of these runs share.
std::vector<Coordinate> SharedInstantCoordinates(const Dataset& dataset,
                                                 const std::vector<std::size_t>& runs);

// Whether a run's commands leave nothing that a clock could be off by: each that turns the valve
// has an error of its own.
bool NoInstantIsExact(const Run& run);

// Sets those of the run's commands whose instant is NaN. The others must not fall. Does nothing
// where there are fewer readings between known commands than commands.
void GuessInstants(Run& run);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RECORDED_INSTANTS_H_
