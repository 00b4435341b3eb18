// Whether a valve that is switched off holds or deflates, as the pressure shows.
#ifndef PLENUM_API_MEASURE_CSV_OFF_STATE_H_
#define PLENUM_API_MEASURE_CSV_OFF_STATE_H_

#include <optional>
#include <string>
#include <vector>

#include "api/measure/csv/recording.h"

namespace plenum::api {

enum class Position { kInflate, kDeflate, kHold, kOn, kOff };

struct OffState {
  std::optional<Position> state;  // kDeflate or kHold; none: the pressure does not show it
  std::string why;                // in words
};

// Looks at each time the valve is off after it has inflated to a fifth of the largest gauge
// pressure or more. It deflates if the pressure always falls to a tenth or less, and to half within
// ten times as long as the valve was on; it holds if four fifths always remain.
OffState OffStateOf(const Recording& recording,
                    const std::vector<std::vector<Position>>& positions);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_OFF_STATE_H_
