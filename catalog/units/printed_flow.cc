#include "catalog/units/printed_flow.h"

#include <cctype>
#include <cmath>
#include <numbers>

#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr double kAtmosphereBar = 1.013;
constexpr double kKpaPerBar = 100.0;
constexpr double kSecondsPerMinute = 60.0;
constexpr double kRatioAssumed = 0.3;
constexpr double kPerCv = 4.0;
constexpr double kKvPerCv = 0.865;
constexpr double kPerBoreMm2 = 0.16;
constexpr double kAreaMm2PerC = 5.0;
constexpr double kPressureMaxKpa = 1e5;
constexpr std::string_view kConductance = "sonic_conductance";
constexpr std::string_view kConductanceUnit = "_dm3_per_s_bar";

bool StartsWithWord(std::string_view text, std::string_view word) {
  if (text.size() <= word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(text[i])) !=
        std::tolower(static_cast<unsigned char>(word[i])))
      return false;
  return !std::isalpha(static_cast<unsigned char>(text[word.size()]));
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t=:");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

const FlowNotationSpec* NotationOf(std::string_view text) {
  for (const FlowNotationSpec& spec : FlowNotations())
    if (StartsWithWord(text, spec.word)) return &spec;
  return nullptr;
}

std::string Bar(double kpa) { return FormatNumber(std::round(kpa * 1e4) / 1e6); }

DerivedFlow OfNominalFlow(const PrintedFlow& printed, std::optional<double> critical_ratio) {
  const double b = critical_ratio.value_or(kRatioAssumed);
  const double from_bar = printed.from_kpa_gauge / kKpaPerBar + kAtmosphereBar;
  const double ratio = (printed.to_kpa_gauge / kKpaPerBar + kAtmosphereBar) / from_bar;
  const double share = ratio <= b ? 1.0 : std::sqrt(1.0 - std::pow((ratio - b) / (1.0 - b), 2.0));
  return {printed.value / (kSecondsPerMinute * from_bar * share),
          std::string(ratio <= b ? "C = Qn/(60·p1)" : "C = Qn/(60·p1·√(1−((p2/p1−b)/(1−b))²))") +
              ", Qn " + FormatNumber(printed.value) + " L/min from " + Bar(printed.from_kpa_gauge) +
              " to " + Bar(printed.to_kpa_gauge) + " bar gauge, b " + FormatNumber(b) +
              (critical_ratio ? "" : " assumed")};
}

}  // namespace

const std::vector<FlowNotationSpec>& FlowNotations() {
  static const std::vector<FlowNotationSpec> kSpecs = {
      {FlowNotation::kQn, "qn_l_per_min", "Qn", 1e-3, 1e6},
      {FlowNotation::kCv, "cv", "Cv", 1e-6, 1e3},
      {FlowNotation::kKv, "kv", "Kv", 1e-6, 1e3},
      {FlowNotation::kOrifice, "orifice_mm", "orifice", 1e-2, 100},
      {FlowNotation::kEffectiveArea, "effective_area_mm2", "effective area", 1e-5, 1e4},
  };
  return kSpecs;
}

DerivedFlow ConductanceOf(const PrintedFlow& printed, std::optional<double> critical_ratio) {
  const double x = printed.value;
  const std::string number = FormatNumber(x);
  switch (printed.notation) {
    case FlowNotation::kQn:
      return OfNominalFlow(printed, critical_ratio);
    case FlowNotation::kCv:
      return {kPerCv * x, "C = 4·Cv (within 10–20 %), Cv " + number};
    case FlowNotation::kKv:
      return {kPerCv * x / kKvPerCv, "C = 4·Kv/0.865 (within 10–20 %), Kv " + number};
    case FlowNotation::kOrifice:
      return {kPerBoreMm2 * std::numbers::pi / 4.0 * x * x,
              "C = 0.16·π/4·d² (within 20 %), orifice " + number + " mm"};
    case FlowNotation::kEffectiveArea:
      break;
  }
  return {x / kAreaMm2PerC, "C = S/5, effective area " + number + " mm²"};
}

std::string ReadFlowPressures(std::string_view text, PrintedFlow& printed) {
  const std::string wanted =
      "must be like \"6 to 5 bar\", gauge pressures before and behind the "
      "part; is " +
      Shown(text);
  std::string_view first, second;
  for (const std::string_view between : {" to ", "→", "->"}) {
    const std::size_t at = text.find(between);
    if (at == std::string_view::npos) continue;
    first = Trimmed(text.substr(0, at));
    second = Trimmed(text.substr(at + between.size()));
    break;
  }
  if (first.empty() || second.empty() || !IsCleanText(text)) return wanted;
  const auto read = [](const std::string& pressure) {
    return ParseQuantity(pressure, "pressure_kpa_gauge", {.needs_unit = true}).value;
  };
  const auto to = read(std::string(second));
  auto from = read(std::string(first));
  // "6 to 5 bar": the unit stands behind the last number.
  const std::size_t unit = second.find_first_not_of("0123456789.,- ");
  if (!from && unit != std::string_view::npos)
    from = read(std::string(first) + " " + std::string(second.substr(unit)));
  if (!from || !to || !(*from > *to) || !(*to >= 0.0) || *from > kPressureMaxKpa) return wanted;
  printed.from_kpa_gauge = *from;
  printed.to_kpa_gauge = *to;
  return "";
}

bool IsPrintedFlow(std::string_view text) { return NotationOf(Trimmed(text)) != nullptr; }

std::string ReadPrintedFlow(std::string_view text, PrintedFlow& printed) {
  text = Trimmed(text);
  const FlowNotationSpec* spec = NotationOf(text);
  if (spec == nullptr)
    return "must be like \"Qn 100 L/min at 6 to 5 bar\", \"Cv 0.05\", \"Kv 0.04\", \"orifice 1.2 "
           "mm\" or \"effective area 2.5 mm2\"";
  printed = {.notation = spec->notation};
  std::string_view value = Trimmed(text.substr(spec->word.size()));
  const std::size_t at = spec->notation == FlowNotation::kQn ? value.find(" at ") : value.npos;
  // "Nl/min at 0 °C" speaks of a temperature.
  if (at != value.npos && value.substr(at).find("°C") == value.npos) {
    if (std::string error = ReadFlowPressures(Trimmed(value.substr(at + 4)), printed);
        !error.empty())
      return "pressures " + error;
    value = Trimmed(value.substr(0, at));
  }
  const Quantity quantity = ParseQuantity(value, spec->field);
  if (!quantity.value) return std::string(spec->word) + " " + quantity.error;
  if (!(*quantity.value >= spec->min && *quantity.value <= spec->max))
    return std::string(spec->word) + " must be between " + FormatNumber(spec->min) + " and " +
           FormatNumber(spec->max) + ", is " + FormatNumber(*quantity.value);
  printed.value = *quantity.value;
  return "";
}

bool IsConductance(std::string_view field) {
  return field.starts_with(kConductance) && field.ends_with(kConductanceUnit);
}

std::string CriticalRatioOf(std::string_view conductance) {
  conductance.remove_prefix(kConductance.size());
  conductance.remove_suffix(kConductanceUnit.size());
  return "critical_ratio" + std::string(conductance);
}

}  // namespace plenum::catalog
