#include "catalog/fields/laws/estimate_missing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "catalog/fields/fields.h"
#include "catalog/fields/laws/laws.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr double kCellVoltage = 3.7, kCellVoltageOff = 0.151;
constexpr double kUncertaintyMin = 0.01, kUncertaintyMax = 1;

double Rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

// A number that a law takes, with its own relative error where it is an estimate.
struct Taken {
  double value = 0, error = 0;
};

std::optional<Taken> NumberOf(const Part& part, const std::string& name) {
  const auto found = part.numbers.find(name);
  if (found == part.numbers.end() || !(found->second.value > 0)) return std::nullopt;
  const Number& number = found->second;
  const bool estimated = number.provenance == Provenance::kEstimated;
  return Taken{number.value, estimated ? number.uncertainty.value_or(0.0) : 0.0};
}

std::optional<Taken> Product(const Part& part, const char* a, const char* b) {
  const auto x = NumberOf(part, a), y = NumberOf(part, b);
  if (!x || !y) return std::nullopt;
  return Taken{x->value * y->value, std::hypot(x->error, y->error)};
}

std::optional<Taken> FreeFlow(const Part& part) {
  if (!part.curve || part.curve->points.empty()) return std::nullopt;
  double most = 0;
  for (const CurvePoint& point : part.curve->points)
    most = std::max(most, point.free_air_l_per_min);
  return most > 0 ? std::optional(Taken{most, 0.0}) : std::nullopt;
}

// What a law takes beside the numbers of the part.
std::optional<Taken> ValueFor(const Part& part, const std::string& name) {
  if (name == "free_flow_l_per_min") return FreeFlow(part);
  if (name == "power_w") {
    if (const auto known = NumberOf(part, "power_max_w")) return known;
    const auto flow = FreeFlow(part);
    if (!flow) return std::nullopt;
    const FieldLaw& law = PumpCoefficient("power_max_w");
    return Taken{law.factor * std::pow(flow->value, law.powers.front().exponent),
                 law.uncertainty.value_or(0.0)};
  }
  if (name == "energy_wh") return Product(part, "nominal_voltage_v", "capacity_ah");
  if (name == "c_rate") {
    const auto current = NumberOf(part, "current_max_a"), capacity = NumberOf(part, "capacity_ah");
    if (!current || !capacity) return std::nullopt;
    return Taken{current->value / capacity->value, current->error};
  }
  if (name == "fill_energy_j") return Product(part, "fill_pressure_kpa_gauge", "water_volume_l");
  if (name == "wall_area_mm2") {
    const auto outer = NumberOf(part, "outer_diameter_mm");
    const auto inner = NumberOf(part, "inner_diameter_mm");
    if (!outer || !inner || inner->value >= outer->value) return std::nullopt;
    return Taken{std::numbers::pi / 4 * (outer->value * outer->value - inner->value * inner->value),
                 0.0};
  }
  return NumberOf(part, name);
}

std::string Lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

// One condition: "material has steel", "function is 3/2", "a above 1", "a known".
bool Holds(const Part& part, std::string_view condition) {
  const auto words = Split(condition, ' ');
  if (words.size() < 2) return false;
  const std::string name(words[0]);
  const std::string_view verb = words[1];
  const std::string value(words.size() > 2 ? condition.substr(name.size() + verb.size() + 2)
                                           : std::string_view());
  if (verb == "known") return NumberOf(part, name).has_value();
  if (verb == "above") {
    const auto number = NumberOf(part, name);
    return number && number->value > ParseNumber(value).value_or(HUGE_VAL);
  }
  const auto text = part.texts.find(name);
  if (text == part.texts.end()) return false;
  const std::string held = Lower(text->second.value);
  return verb == "is" ? held == Lower(value) : held.find(Lower(value)) != std::string::npos;
}

bool HoldAll(const Part& part, std::string_view conditions) {
  if (conditions.empty()) return true;
  const auto all = Split(conditions, ';');
  return std::all_of(all.begin(), all.end(), [&](std::string_view one) {
    return Holds(part, one.substr(std::min(one.find_first_not_of(' '), one.size())));
  });
}

// Cells in series of a lithium pack whose voltage leaves no doubt: 3.6 to 3.85 V each.
void CountCells(Part& part) {
  const auto chemistry = part.texts.find("chemistry");
  const auto voltage = NumberOf(part, "nominal_voltage_v");
  if (part.numbers.contains("cells_series") || chemistry == part.texts.end() || !voltage) return;
  const std::string kind = Lower(chemistry->second.value);
  const bool is_lithium = kind.starts_with("li-ion") || kind.starts_with("liion") ||
                          kind.starts_with("lipo") || kind.starts_with("li-po") ||
                          kind.starts_with("lithium-ion") || kind.starts_with("lithium ion");
  const double cells = std::round(voltage->value / kCellVoltage);
  if (!is_lithium || cells < 1 || std::abs(voltage->value / cells - kCellVoltage) > kCellVoltageOff)
    return;
  part.numbers["cells_series"] = {
      cells, Provenance::kDerived,
      "nominal voltage " + FormatNumber(voltage->value) + " V at about 3.7 V a cell"};
}

std::optional<Number> Predicted(const Part& part, const FieldLaw& law) {
  double value = law.factor;
  double square = law.uncertainty.value_or(0.0) * law.uncertainty.value_or(0.0);
  for (const LawPower& power : law.powers) {
    const auto taken = ValueFor(part, power.of);
    if (!taken) return std::nullopt;
    value *= std::pow(taken->value, power.exponent);
    square += std::pow(power.exponent * taken->error, 2);
  }
  std::optional<double> uncertainty;
  if (square > 0)
    uncertainty = Rounded(std::clamp(std::sqrt(square), kUncertaintyMin, kUncertaintyMax), 2);
  const bool is_copy =
      law.factor == 1 && law.powers.size() == 1 && law.powers.front().exponent == 1;
  return Number{is_copy ? value : Rounded(value, 3), Provenance::kEstimated, law.source,
                uncertainty};
}

}  // namespace

void EstimateMissing(Part& part) {
  const Family* family = FindFamily(part.family);
  if (family == nullptr) return;
  if (part.family == "battery") CountCells(part);
  // In the order of the laws: what one gives the next may take.
  for (const FieldLaw& law : FieldLaws()) {
    if (law.family != part.family || part.numbers.contains(law.field)) continue;
    const auto field = std::find_if(family->numbers.begin(), family->numbers.end(),
                                    [&](const NumberField& one) { return one.name == law.field; });
    if (field == family->numbers.end() || !field->required || !HoldAll(part, law.when)) continue;
    if (auto number = Predicted(part, law)) part.numbers[law.field] = std::move(*number);
  }
}

}  // namespace plenum::catalog
