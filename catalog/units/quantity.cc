#include "catalog/units/quantity.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "catalog/units/text.h"
#include "catalog/units/unit_table.h"

namespace plenum::catalog {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string Replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// Takes one of the marks off the end.
bool Drop(std::string& text, std::initializer_list<std::string_view> marks) {
  for (const std::string_view mark : marks) {
    if (text.size() <= mark.size() || !text.ends_with(mark)) continue;
    text.resize(text.size() - mark.size());
    return true;
  }
  return false;
}

// "dm³ / (s · bar)" as "dm3/(sbar)", "l/min" as "L/min".
std::string Normalized(std::string_view unit) {
  std::string text(unit);
  for (const std::string_view nothing : {" ", "\t", "\u00A0", "\u202F", "·", "⋅", "*"})
    text = Replaced(std::move(text), nothing, "");
  for (const std::string_view three : {"³", "^3"}) text = Replaced(std::move(text), three, "3");
  for (const std::string_view two : {"²", "^2", "₂"}) text = Replaced(std::move(text), two, "2");
  text = Replaced(std::move(text), "µ", "u");  // U+00B5, micro sign
  text = Replaced(std::move(text), "μ", "u");  // U+03BC, Greek letter
  text = Replaced(std::move(text), "℃", "°C");
  if (text.starts_with("l/") || text == "l") text[0] = 'L';
  if (text.starts_with("ml")) text[1] = 'L';
  return text;
}

// "1.234.567" and the like: one to three digits, then groups of three.
bool AreThousands(const std::vector<std::string_view>& groups) {
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (i == 0 ? groups[i].empty() || groups[i].size() > 3 : groups[i].size() != 3) return false;
  return groups.front().front() != '0';
}

enum class Reading { kClear, kAmbiguous, kNone };

// Digits with points and commas as digits with at most one point.
Reading Plain(std::string_view digits, std::string& plain) {
  const std::size_t last = digits.find_last_of(".,");
  if (last == std::string_view::npos) {
    plain = digits;
    return Reading::kClear;
  }
  const char mark = digits[last], other = mark == '.' ? ',' : '.';
  const auto groups = Split(digits, mark);
  if (groups.size() > 2 || digits.find(other) == std::string_view::npos) {
    // One kind of mark alone. A single point is a decimal one, as everywhere in the program.
    const bool thousands = AreThousands(groups) && !(mark == '.' && groups.size() == 2);
    if (thousands && groups.size() == 2) return Reading::kAmbiguous;
    if (thousands) {
      plain = Replaced(std::string(digits), std::string_view(&mark, 1), "");
      return digits.find(other) == std::string_view::npos ? Reading::kClear : Reading::kNone;
    }
    if (groups.size() > 2 || (mark == ',' && (groups[0].empty() || groups[1].empty())))
      return Reading::kNone;
    plain = Replaced(std::string(digits), ",", ".");
    return Reading::kClear;
  }
  if (!AreThousands(Split(groups[0], other)) || groups[1].empty()) return Reading::kNone;
  plain = Replaced(std::string(groups[0]), std::string_view(&other, 1), "") + "." +
          std::string(groups[1]);
  return Reading::kClear;
}

// The number at the front of a text, which becomes what is behind it.
struct Leading {
  Reading reading = Reading::kNone;
  double value = 0.0;
  std::string plain;  // without thousands, with a point
};

std::size_t CountFront(std::string_view text, std::string_view of) {
  const std::size_t end = text.find_first_not_of(of);
  return end == std::string_view::npos ? text.size() : end;
}

Leading TakeNumber(std::string_view& text) {
  constexpr std::string_view kDigits = "0123456789";
  Leading number;
  text.remove_prefix(CountFront(text, " \t"));
  bool negative = false;
  for (const std::string_view minus : {"-", "−"}) {
    if (!text.starts_with(minus)) continue;
    negative = true;
    text.remove_prefix(minus.size());
    break;
  }
  const std::string_view digits = text.substr(0, CountFront(text, "0123456789.,"));
  if (digits.find_first_of(kDigits) == std::string_view::npos) return number;
  number.reading = Plain(digits, number.plain);
  text.remove_prefix(digits.size());
  if (number.reading == Reading::kAmbiguous) return number;
  if (text.size() > 1 && (text[0] == 'e' || text[0] == 'E')) {
    const std::size_t sign = text[1] == '-' || text[1] == '+' ? 1 : 0;
    const std::size_t size = CountFront(text.substr(1 + sign), kDigits);
    if (size > 0) {
      if (number.reading == Reading::kClear)
        number.plain +=
            "e" + std::string(text.substr(text[1] == '+' ? 2 : 1, size + (text[1] == '-' ? 1 : 0)));
      text.remove_prefix(1 + sign + size);
    }
  }
  const char* end = number.plain.data() + number.plain.size();
  const auto [read, error] = std::from_chars(number.plain.data(), end, number.value);
  if (error != std::errc() || read != end) number.reading = Reading::kNone;
  // "1/4 in"
  if (text.size() > 1 && text[0] == '/' && IsDigit(text[1])) {
    const std::size_t size = CountFront(text.substr(1), kDigits);
    double below = 0.0;
    std::from_chars(text.data() + 1, text.data() + 1 + size, below);
    number.value /= below;
    text.remove_prefix(1 + size);
  }
  if (negative) number.value = -number.value;
  return number;
}

const Unit* Find(const Dimension& dimension, std::string_view name) {
  for (const Unit& unit : dimension.units)
    if (unit.name == name) return &unit;
  return nullptr;
}

double InFieldUnit(double value, const Unit& unit) {
  value += unit.offset;
  return unit.denominator == 1 ? value * unit.numerator : value * unit.numerator / unit.denominator;
}

// A text with its number taken off: what the unit makes of it.
class Converter {
 public:
  Converter(const Dimension& dimension, const QuantityContext& context, double value)
      : dimension_(dimension), context_(context), value_(value) {}

  // None: not understood; `why` says more where there is more to say.
  std::optional<double> Convert(std::string name) {
    if (dimension_.kind == Kind::kGauge || dimension_.kind == Kind::kAbsolute)
      return Pressure(std::move(name));
    if (dimension_.kind == Kind::kFlow) return Flow(std::move(name));
    const Unit* unit = Find(dimension_, name);
    return unit == nullptr ? std::nullopt : std::optional(InFieldUnit(value_, *unit));
  }

  std::string why;
  std::string_view condition;

 private:
  std::optional<double> Pressure(std::string name) {
    const bool field_is_gauge = dimension_.kind == Kind::kGauge;
    const Unit* unit = Find(dimension_, name);
    bool gauge = field_is_gauge;
    if (unit == nullptr) {
      if (Drop(name, {"(g)", "(gauge)", "gauge", "g"}))
        gauge = true;
      else if (Drop(name, {"(a)", "(abs)", "(absolute)", "absolute", "abs", "a"}))
        gauge = false;
      unit = Find(dimension_, name);
    }
    if (unit == nullptr) return std::nullopt;
    const double kpa = InFieldUnit(value_, *unit);
    if (gauge == field_is_gauge) return kpa;
    if (!field_is_gauge) {
      why = "this field is absolute: give an absolute pressure";
      return std::nullopt;
    }
    if (!context_.ambient_kpa_abs) {
      why = "an absolute pressure needs an ambient pressure, which is not known here: give gauge";
      return std::nullopt;
    }
    return kpa - *context_.ambient_kpa_abs;
  }

  std::optional<double> Flow(std::string name) {
    Drop(name, {"(ANR)", "ANR"});
    if (const Unit* unit = Find(dimension_, name)) {
      condition = unit->condition;
      return InFieldUnit(value_, *unit);
    }
    if (!name.starts_with("N") && !name.starts_with("n")) return std::nullopt;
    name.erase(0, 1);
    name = Replaced(Replaced(Normalized(name), "(", ""), ")", "");
    double per_litre = 0.0;
    for (const std::string_view celsius : {"°C", "degC", "C"}) {
      if (per_litre > 0.0) break;
      if (!Drop(name, {celsius})) continue;
      if (Drop(name, {"at20", "20"}))
        per_litre = 1.0, condition = kAtTwenty;
      else if (Drop(name, {"at0", "0"}))
        per_litre = kAnrPerNormalLitre, condition = kAtZero;
    }
    if (per_litre > 0.0) Drop(name, {","});
    const Unit* unit = Find(dimension_, name);
    if (unit == nullptr || !unit->condition.empty()) return std::nullopt;
    if (per_litre > 0.0) return InFieldUnit(value_, *unit) * per_litre;
    why = "a normal litre is counted at 0 °C or at 20 °C, 7 % apart: add \"(0 °C)\" or \"(20 °C)\"";
    return std::nullopt;
  }

  const Dimension& dimension_;
  const QuantityContext& context_;
  double value_;
};

}  // namespace

std::string_view UnitOf(std::string_view field) { return DimensionOf(field).unit; }

std::string UnitNames(std::string_view field) {
  std::string names;
  for (const Unit& unit : DimensionOf(field).units)
    if (!unit.is_alias) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  for (const std::string_view per : {"bar)", "Pa)"})
    names = Replaced(std::move(names), per, "·" + std::string(per));
  return names;
}

// "every 3 s" and "once every minute" as a frequency; none: the text says no such thing.
static std::optional<double> OnceEvery(std::string_view text) {
  std::string words(text);
  if (!words.empty())
    words[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(words[0])));
  constexpr std::string_view kOnce = "once ", kEvery = "every ";
  if (words.starts_with(kOnce)) words.erase(0, kOnce.size());
  if (!words.starts_with(kEvery)) return {};
  const std::string period = words.substr(kEvery.size());
  const bool counts = !period.empty() && (std::isdigit(period[0]) != 0 || period[0] == '.');
  const Quantity read =
      ParseQuantity((counts ? "" : "1 ") + period, "period_s", {.needs_unit = true});
  if (!read.value || !(*read.value > 0.0)) return {};
  return 1.0 / *read.value;
}

Quantity ParseQuantity(std::string_view text, std::string_view field,
                       const QuantityContext& context) {
  if (!context.needs_unit)
    if (const auto bare = ParseNumber(text)) return {bare, "", ""};
  const Dimension& dimension = DimensionOf(field);
  if (dimension.suffix == "_hz")
    if (const auto often = OnceEvery(text)) return {often, "", ""};
  const auto refused = [&](const std::string& why) {
    return Quantity{std::nullopt,
                    std::string("must be a finite number, ") +
                        (context.needs_unit ? "or a text of a number and" : "alone or with") +
                        " one of " + UnitNames(field) + "; is " + Shown(text) +
                        (why.empty() ? "" : ": " + why),
                    ""};
  };
  std::string_view rest = text;
  const Leading number = TakeNumber(rest);
  if (number.reading == Reading::kAmbiguous)
    return refused("the comma may stand before decimals or between thousands");
  if (number.reading == Reading::kNone) return refused("");
  const std::string name = Normalized(rest);
  if (name.empty()) {
    if (context.needs_unit || !std::isfinite(number.value))
      return refused(context.needs_unit ? "the unit is missing" : "");
    return {number.value, "", ""};
  }
  Converter converter(dimension, context, number.value);
  const std::optional<double> value = converter.Convert(name);
  if (value && std::isfinite(*value)) return {value, "", converter.condition};
  return refused(converter.why);
}

}  // namespace plenum::catalog
