// What data sheets and price lists print in place of numbers of the catalogue: the size of a body
// in place of its volume, free flow and highest pressure in place of a pump's curve, a C-rate in
// place of a battery's current, its energy in place of its capacity.
#ifndef PLENUM_CATALOG_FIELDS_LAWS_PRINTED_PART_H_
#define PLENUM_CATALOG_FIELDS_LAWS_PRINTED_PART_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// A box, or a cylinder where a diameter is given; in mm.
struct PrintedBody {
  double length_mm = 0, width_mm = 0, height_mm = 0;
  double diameter_mm = 0;  // above 0: a cylinder of this diameter and of length_mm
};
inline constexpr double kBodySideMinMm = 0.1, kBodySideMaxMm = 1e4;

struct PrintedNumber {
  double value = 0;
  std::string formula;  // and what was printed, for people
};

// The envelope in mL: l·w·h, or π/4·d²·l.
PrintedNumber BodyVolumeOf(const PrintedBody& body);

// The pieces of a size between signs of multiplication: "70", "30", "50 mm".
std::vector<std::string_view> SizePieces(std::string_view text);
// Whether a text gives a size: numbers with × or x between them, or one behind ⌀.
bool IsPrintedBody(std::string_view text);
// Reads "70 x 30 x 50 mm", "⌀18.5 × 65 mm", each number also with a unit of its own; the unit may
// be missing (mm). Two numbers without ⌀ are refused. An error in words, or empty.
std::string ReadPrintedBody(std::string_view text, PrintedBody& body);

struct PrintedPump {
  double free_flow_l_per_min = 0;
  std::optional<double> current_a = std::nullopt;  // the highest, or the one that is printed
};
// Whether a text starts with "free flow".
bool IsPrintedPump(std::string_view text);
// Reads "free flow 12 L/min", "free flow 12 L/min, 0.8 A"; an error in words, or empty.
std::string ReadPrintedPump(std::string_view text, PrintedPump& pump);
// Gives the part the curve of its free flow, its voltage and its highest pressure (a vacuum pump:
// its deepest), by the law of pumps whose curve is not printed (catalog/fields/laws/pump_law.h),
// marked `estimated` with its uncertainty; what was printed stands in the sources. The power is
// power_max_w, else the printed current times the voltage, else by the law of free flow. `source`
// is where it was printed, or empty. What the part lacks, in words, or empty.
std::string DeriveCurve(const PrintedPump& pump, const std::string& source, Part& part);

// The C-rate of a text like "25C" or "25 C": how often an hour the capacity could be drawn.
std::optional<double> PrintedCRate(std::string_view text);
// current = C-rate · capacity.
PrintedNumber CurrentOfCRate(double rate, double capacity_ah);

// The energy of a text like "19.2 Wh", in Wh, which stands in place of a capacity.
std::optional<double> PrintedEnergy(std::string_view text);
// capacity = energy / nominal voltage.
PrintedNumber CapacityOfEnergy(double energy_wh, double nominal_voltage_v);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LAWS_PRINTED_PART_H_
