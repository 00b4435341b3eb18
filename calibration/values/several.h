// Several chambers behind one valve, in a row or side by side.
//
// Gas passes between a chamber and the one that feeds it through an always open line, both ways.
// Chambers side by side branch off a junction behind the valve, which is a small rigid volume of
// its own. Each chamber with a gauge makes a run of its own of one recording: one shot, simulated
// with all chambers and compared with the readings of that gauge, so that noise, residuals and
// errors are those of each gauge.
#ifndef PLENUM_CALIBRATION_VALUES_SEVERAL_H_
#define PLENUM_CALIBRATION_VALUES_SEVERAL_H_

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "calibration/values/line_piece.h"
#include "model/physics/chamber.h"

namespace plenum::calibration {

struct OneOfSeveral {
  std::string name;  // empty of a junction
  model::Chamber chamber;
  std::size_t from = 0;         // the chamber that feeds it, an earlier one
  std::vector<LinePiece> line;  // from there; none of the first, which the run's line leads to
  double start_above_pa = 0.0;  // by which it starts above the chamber with the gauge
};

struct Several {
  std::vector<OneOfSeveral> all;  // the junction first, where there is one; empty: one chamber
  std::size_t gauge = 0;          // the one in which the run's readings were taken
  std::string shot;               // id of the recording; empty: the run's own

  bool empty() const { return all.empty(); }
  std::size_t first() const { return !all.empty() && all.front().name.empty() ? 1 : 0; }
  std::size_t pieces() const { return all.size() - first(); }  // chambers without the junction
  const OneOfSeveral& piece(std::size_t i) const { return all[first() + i]; }
  bool HasPiece(auto&& test) const {
    return std::any_of(all.begin(), all.end(), [&](const OneOfSeveral& one) {
      return std::any_of(one.line.begin(), one.line.end(), test);
    });
  }
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_SEVERAL_H_
