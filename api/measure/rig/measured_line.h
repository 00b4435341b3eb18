// Lines of the rig of a measurement, and what the rig measures of its parts.
#ifndef PLENUM_API_MEASURE_RIG_MEASURED_LINE_H_
#define PLENUM_API_MEASURE_RIG_MEASURED_LINE_H_

#include <string>
#include <vector>

#include "api/json/reader.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// A number of a part that the rig measures, and where it stands there: places of a line or volume,
// or points of the compressor's curve.
struct MeasuredInRig {
  calibration::MeasuredNumber number;
  std::vector<calibration::MeasuredPlace> places;
};

// "part" and "measure" of an object of the rig: the part's id and the names to be measured.
struct Measure {
  std::string part;
  std::vector<std::string> names;
};
Measure ReadMeasure(Reader& reader, const std::vector<std::string>& allowed);

// A line: pairs with a tube behind them, or "elements".
std::vector<calibration::LinePiece> ReadPieces(Reader line, std::vector<MeasuredInRig>& measured);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_RIG_MEASURED_LINE_H_
