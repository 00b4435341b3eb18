// Units in headings of recordings: how they are spelt, gauge or absolute, scales of sensors.
#ifndef PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_UNITS_H_
#define PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_UNITS_H_

#include <string>
#include <string_view>

namespace plenum::api {

enum class Gauge { kUnsaid, kGauge, kAbsolute };

// A text without the words that say what its pressure is counted from: "abs", "absolute", "(a)",
// the last letter of "psia"; "gauge", "rel", "(g)", "psig".
struct MarkedText {
  std::string text;
  Gauge gauge = Gauge::kUnsaid;
};
MarkedText TakeGaugeMark(std::string_view text);

// Behind a unit: " abs", " gauge" or nothing.
std::string_view MarkOf(Gauge gauge);

// The unit as catalog/units/quantity.h spells it: "KPA" as "kPa", "sec" as "s".
std::string SpelledUnit(std::string_view unit);

// Volts, milliamperes or counts: what a sensor gives before its scale is applied.
bool IsRawUnit(std::string_view unit);

// Whether numbers of the field may be in this unit, which has no mark. Of pressures raw ones, too.
bool IsUnitOf(std::string_view field, std::string_view unit);

// x of the column are x · numerator / denominator + offset of the field.
struct ColumnScale {
  double numerator = 1.0, denominator = 1.0, offset = 0.0;
  double operator()(double x) const { return x * numerator / denominator + offset; }
};

// `unit` as a target carries it: "bar", "bar abs", "psi gauge", or the scale of a sensor by two
// points, or one and zero: "0.5 V = 0 bar; 4.5 V = 10 bar". An empty one is the field's own.
// Absolute pressures become gauge with the ambient pressure.
struct ScaleOrError {
  ColumnScale scale;
  std::string error;
};
ScaleOrError ScaleOf(std::string_view field, std::string_view unit, double ambient_kpa_abs);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_UNITS_H_
