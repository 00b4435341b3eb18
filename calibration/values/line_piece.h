// One element of a line as declared.
#ifndef PLENUM_CALIBRATION_VALUES_LINE_PIECE_H_
#define PLENUM_CALIBRATION_VALUES_LINE_PIECE_H_

#include <optional>

#include "model/flow/iso6358.h"

namespace plenum::calibration {

// In the order from the source; a tube's pairs follow from its size.
struct LinePiece {
  model::FlowElement fill, exhaust;
  struct Tube {
    double inner_diameter_m = 0.0;
    double length_m = 0.0;
  };
  std::optional<Tube> tube;
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_LINE_PIECE_H_
