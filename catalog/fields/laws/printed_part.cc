#include "catalog/fields/laws/printed_part.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/fields/laws/pump_law.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr double kMm3PerMl = 1000.0;
constexpr double kFreeFlowMax = 1e6, kCurrentMax = 1e3;
constexpr std::string_view kTimes[] = {"×", "x", "X", "*", "by"};
constexpr std::string_view kRound[] = {"⌀", "Ø", "ø", "diameter", "dia."};
constexpr std::string_view kFreeFlow = "free flow";

std::string_view WithoutBlanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool TakeRound(std::string_view& piece) {
  for (const std::string_view mark : kRound) {
    if (!piece.starts_with(mark)) continue;
    piece = WithoutBlanks(piece.substr(mark.size()));
    return true;
  }
  return false;
}

// The unit behind the last number, for numbers that have none of their own.
std::string_view UnitBehind(std::string_view piece) {
  const std::size_t at = piece.find_first_not_of("0123456789.,/ ");
  return at == std::string_view::npos ? "" : piece.substr(at);
}

}  // namespace

// Each piece behind the first starts with a number or ⌀.
std::vector<std::string_view> SizePieces(std::string_view text) {
  std::vector<std::string_view> pieces;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const std::string_view times : kTimes) {
      if (at == 0 || !text.substr(at).starts_with(times)) continue;
      const std::string_view next = WithoutBlanks(text.substr(at + times.size()));
      const bool is_round = next.starts_with("⌀") || next.starts_with("Ø") || next.starts_with("ø");
      if (next.empty() || !(IsDigit(next[0]) || next[0] == '.' || is_round)) continue;
      pieces.push_back(WithoutBlanks(text.substr(begin, at - begin)));
      begin = at + times.size();
      at = begin - 1;
      break;
    }
  }
  pieces.push_back(WithoutBlanks(text.substr(begin)));
  return pieces;
}

PrintedNumber BodyVolumeOf(const PrintedBody& body) {
  const std::string length = FormatNumber(body.length_mm);
  if (body.diameter_mm > 0)
    return {std::numbers::pi / 4 * body.diameter_mm * body.diameter_mm * body.length_mm / kMm3PerMl,
            "V = π/4·d²·l, d " + FormatNumber(body.diameter_mm) + " mm, l " + length + " mm"};
  return {body.length_mm * body.width_mm * body.height_mm / kMm3PerMl,
          "V = l·w·h, " + length + " x " + FormatNumber(body.width_mm) + " x " +
              FormatNumber(body.height_mm) + " mm"};
}

bool IsPrintedBody(std::string_view text) {
  std::string_view front = WithoutBlanks(text);
  if (TakeRound(front)) return true;
  return !front.empty() && IsDigit(front[0]) && SizePieces(front).size() > 1;
}

std::string ReadPrintedBody(std::string_view text, PrintedBody& body) {
  const std::string wanted = "; is " + Shown(text);
  std::vector<std::string_view> pieces = SizePieces(WithoutBlanks(text));
  const std::string unit(UnitBehind(pieces.back()));
  std::vector<double> sides, diameters;
  for (std::string_view piece : pieces) {
    const bool round = TakeRound(piece);
    const bool bare = UnitBehind(piece).empty() && !unit.empty();
    const std::string number = std::string(piece) + (bare ? " " + unit : "");
    const Quantity side = ParseQuantity(number, "side_mm");
    if (!side.value) return "size " + side.error;
    if (!(*side.value >= kBodySideMinMm && *side.value <= kBodySideMaxMm))
      return "each number of a size must be between " + FormatNumber(kBodySideMinMm) + " and " +
             FormatNumber(kBodySideMaxMm) + " mm, is " + FormatNumber(*side.value);
    (round ? diameters : sides).push_back(*side.value);
  }
  if (diameters.size() == 1 && sides.size() == 1) {
    body = {sides[0], 0, 0, diameters[0]};
    return "";
  }
  if (diameters.empty() && sides.size() == 3) {
    body = {sides[0], sides[1], sides[2], 0};
    return "";
  }
  if (diameters.empty() && sides.size() == 2)
    return "two numbers may be two sides of three or a diameter and a length: write ⌀ before the "
           "diameter, or three sides" +
           wanted;
  return "must be three sides like \"70 x 30 x 50 mm\", or a diameter and a length like \"⌀18.5 x "
         "65 mm\"" +
         wanted;
}

bool IsPrintedPump(std::string_view text) { return WithoutBlanks(text).starts_with(kFreeFlow); }

std::string ReadPrintedPump(std::string_view text, PrintedPump& pump) {
  std::string_view rest = WithoutBlanks(text);
  rest.remove_prefix(kFreeFlow.size());
  const std::size_t comma = rest.find(", ");
  const Quantity flow = ParseQuantity(WithoutBlanks(rest.substr(0, comma)), "free_l_per_min");
  if (!flow.value) return "free flow " + flow.error;
  if (!(*flow.value > 0 && *flow.value <= kFreeFlowMax))
    return "free flow must be > 0 and at most " + FormatNumber(kFreeFlowMax) + " L/min, is " +
           FormatNumber(*flow.value);
  pump = {*flow.value, std::nullopt};
  if (comma == std::string_view::npos) return "";
  const Quantity current = ParseQuantity(WithoutBlanks(rest.substr(comma + 1)), "current_a");
  if (!current.value) return "current behind the free flow " + current.error;
  if (!(*current.value > 0 && *current.value <= kCurrentMax))
    return "current behind the free flow must be > 0 and at most " + FormatNumber(kCurrentMax) +
           " A, is " + FormatNumber(*current.value);
  pump.current_a = current.value;
  return "";
}

std::string DeriveCurve(const PrintedPump& pump, const std::string& source, Part& part) {
  const Family* family = FindFamily(part.family);
  const bool suction = family != nullptr && family->curve == CurveKind::kSuction;
  const char* far = suction ? "vacuum_max_kpa_gauge" : "pressure_max_kpa_gauge";
  const auto value_of = [&](const char* name) -> std::optional<double> {
    const auto found = part.numbers.find(name);
    if (found == part.numbers.end() || !std::isfinite(found->second.value)) return std::nullopt;
    return found->second.value;
  };
  const auto voltage = value_of("voltage_v"), end = value_of(far);
  for (const auto& [name, value] : {std::pair{"voltage_v", voltage}, std::pair{far, end}})
    if (!value || *value == 0.0)
      return std::string("a curve from free flow needs ") + name + ", which the part lacks";
  if (!(*voltage > 0) || (*end < 0) != suction) return "";  // Validate tells the range
  if (pump.current_a && !part.numbers.contains("power_max_w"))
    part.numbers["power_max_w"] = {
        std::round(*voltage * *pump.current_a * 1e9) / 1e9, Provenance::kDerived,
        "P = U·I, " + FormatNumber(*voltage) + " V, " + FormatNumber(*pump.current_a) +
            " A printed" + (source.empty() ? "" : "; " + source)};
  const auto type = part.texts.find("type");
  const PumpEstimate estimate = EstimatePump(
      {pump.free_flow_l_per_min, *end, *voltage, value_of("power_min_w"), value_of("power_max_w"),
       type != part.texts.end() && type->second.value.find("piston") != std::string::npos});
  const std::string behind = ", data README" + (source.empty() ? "" : "; " + source);
  const auto power = value_of("power_max_w");
  part.curve = {estimate.points,
                Provenance::kEstimated,
                "rule: pump flow line, from " + FormatNumber(pump.free_flow_l_per_min) +
                    " L/min and " + FormatNumber(*end) + " kPa printed" + behind,
                Provenance::kEstimated,
                (power ? "rule: pump current, from " + FormatNumber(*power) + " W at "
                       : "rule: pump current, power by free flow, at ") +
                    FormatNumber(*voltage) + " V" + behind,
                estimate.free_air_uncertainty,
                estimate.current_uncertainty};
  return "";
}

std::optional<double> PrintedCRate(std::string_view text) {
  text = WithoutBlanks(text);
  if (text.size() < 2 || (text.back() != 'C' && text.back() != 'c')) return std::nullopt;
  const auto rate = ParseNumber(WithoutBlanks(text.substr(0, text.size() - 1)));
  return rate && *rate > 0 ? rate : std::nullopt;
}

PrintedNumber CurrentOfCRate(double rate, double capacity_ah) {
  return {rate * capacity_ah, "I = C-rate · capacity, " + FormatNumber(rate) + " C, " +
                                  FormatNumber(capacity_ah) + " Ah"};
}

std::optional<double> PrintedEnergy(std::string_view text) {
  text = WithoutBlanks(text);
  if (!text.ends_with("Wh")) return std::nullopt;
  const auto energy_wh = ParseQuantity(text, "energy_wh", {.needs_unit = true}).value;
  return energy_wh && *energy_wh > 0 ? energy_wh : std::nullopt;
}

PrintedNumber CapacityOfEnergy(double energy_wh, double nominal_voltage_v) {
  return {energy_wh / nominal_voltage_v, "capacity = energy / nominal voltage, " +
                                             FormatNumber(energy_wh) + " Wh, " +
                                             FormatNumber(nominal_voltage_v) + " V"};
}

}  // namespace plenum::catalog
