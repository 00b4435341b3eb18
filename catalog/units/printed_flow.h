// The flow through a part as data sheets print it: nominal flow Qn, Cv, Kv, bore of the orifice or
// effective area, in place of the sonic conductance C of ISO 6358.
#ifndef PLENUM_CATALOG_UNITS_PRINTED_FLOW_H_
#define PLENUM_CATALOG_UNITS_PRINTED_FLOW_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

enum class FlowNotation { kQn, kCv, kKv, kOrifice, kEffectiveArea };

// A notation: its field of a part's JSON, the word before it in a text, its range.
struct FlowNotationSpec {
  FlowNotation notation;
  std::string_view field;  // "qn_l_per_min"
  std::string_view word;   // "Qn"
  double min, max;
};
const std::vector<FlowNotationSpec>& FlowNotations();

struct PrintedFlow {
  FlowNotation notation = FlowNotation::kQn;
  double value = 0.0;  // L/min (ANR), 1, m³/h by definition of Kv, mm, mm²
  double from_kpa_gauge = 600.0, to_kpa_gauge = 500.0;  // of Qn
};

struct DerivedFlow {
  double conductance_dm3_per_s_bar = 0.0;
  std::string formula;  // and what was printed, for people
};

// C of what is printed. With p1 and p2 the pressures of Qn, absolute in bar (1.013 bar added), and
// b the critical ratio of the part (0.3 where it is not known, which the formula says):
//   Qn               C = Qn / (60·p1·√(1 − ((p2/p1 − b)/(1 − b))²)), choked C = Qn / (60·p1)
//   Cv, Kv           C = 4·Cv = 4·Kv/0.865, a rule, right within 10 to 20 %
//   orifice          C = 0.16·π/4·d², d in mm: a sharp bore; a rule, right within 20 %
//   effective area   C = S/5, S in mm² (JIS B 8390)
DerivedFlow ConductanceOf(const PrintedFlow& printed, std::optional<double> critical_ratio);

// Reads "6 to 5 bar", also "6 → 5 bar" and "87 psi to 72.5 psi", gauge, into the pressures; an
// error in words, or empty.
std::string ReadFlowPressures(std::string_view text, PrintedFlow& printed);

// Whether a text starts with the word of a notation and a number.
bool IsPrintedFlow(std::string_view text);
// Reads "Qn 100 L/min at 6 to 5 bar", "Cv 0.05", "Kv 0.04", "orifice 1.2 mm", "effective area 2.5
// mm2"; the unit may be missing, "at …" too. An error in words, or empty.
std::string ReadPrintedFlow(std::string_view text, PrintedFlow& printed);

// Whether the field is a sonic conductance; then the field of its critical ratio.
bool IsConductance(std::string_view field);
std::string CriticalRatioOf(std::string_view conductance);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_UNITS_PRINTED_FLOW_H_
