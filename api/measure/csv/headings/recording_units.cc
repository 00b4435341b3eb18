#include "api/measure/csv/headings/recording_units.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "api/json/words.h"
#include "api/measure/csv/headings/recording_words.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

using catalog::ParseQuantity;
using catalog::Trimmed;

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

struct Spelling {
  std::string_view lower, unit;
};
constexpr Spelling kSpellings[] = {{"kpa", "kPa"},
                                   {"pa", "Pa"},
                                   {"hpa", "hPa"},
                                   {"mpa", "MPa"},
                                   {"bar", "bar"},
                                   {"mbar", "mbar"},
                                   {"psi", "psi"},
                                   {"mmhg", "mmHg"},
                                   {"torr", "Torr"},
                                   {"cmh2o", "cmH2O"},
                                   {"inh2o", "inH2O"},
                                   {"inhg", "inHg"},
                                   {"atm", "atm"},
                                   {"sec", "s"},
                                   {"secs", "s"},
                                   {"second", "s"},
                                   {"seconds", "s"},
                                   {"sek", "s"},
                                   {"sekunden", "s"},
                                   {"msec", "ms"},
                                   {"millis", "ms"},
                                   {"milliseconds", "ms"},
                                   {"usec", "us"},
                                   {"micros", "us"},
                                   {"microseconds", "us"},
                                   {"mins", "min"},
                                   {"minutes", "min"},
                                   {"minuten", "min"},
                                   {"hours", "h"},
                                   {"hrs", "h"},
                                   {"hr", "h"},
                                   {"s", "s"},
                                   {"ms", "ms"},
                                   {"us", "us"},
                                   {"min", "min"},
                                   {"h", "h"},
                                   {"celsius", "°C"},
                                   {"c", "°C"},
                                   {"degc", "°C"},
                                   {"kelvin", "K"},
                                   {"k", "K"},
                                   {"ml", "mL"},
                                   {"l", "L"},
                                   {"cc", "cc"},
                                   {"lpm", "L/min"},
                                   {"l/min", "L/min"},
                                   {"volt", "V"},
                                   {"volts", "V"},
                                   {"v", "V"},
                                   {"mv", "mV"},
                                   {"ma", "mA"}};

const Spelling* SpellingOf(std::string_view unit) {
  const std::string lower = Lower(unit);
  const auto* found = std::find_if(std::begin(kSpellings), std::end(kSpellings),
                                   [&](const Spelling& one) { return one.lower == lower; });
  return found == std::end(kSpellings) ? nullptr : found;
}

// What a word says of gauge or absolute, and the word without it.
struct MarkedWord {
  std::string_view left;
  Gauge gauge = Gauge::kUnsaid;
};

MarkedWord MarkOfWord(std::string_view word, bool in_brackets) {
  const std::string lower = Lower(word);
  for (const char* absolute : {"abs", "absolute", "absolut"})
    if (lower == absolute) return {"", Gauge::kAbsolute};
  for (const char* gauge : {"gauge", "gage", "rel", "relative", "relativ"})
    if (lower == gauge) return {"", Gauge::kGauge};
  if (in_brackets && lower == "a") return {"", Gauge::kAbsolute};
  if (in_brackets && lower == "g") return {"", Gauge::kGauge};
  for (const char* unit : {"psi", "bar", "mbar", "kpa", "mpa"}) {
    const std::string stem(unit);
    if (lower == stem + "a") return {word.substr(0, stem.size()), Gauge::kAbsolute};
    if (lower == stem + "g") return {word.substr(0, stem.size()), Gauge::kGauge};
  }
  return {word, Gauge::kUnsaid};
}

struct UnitPoint {
  double raw = 0.0, value = 0.0;
};

// "0.5 V = 0 bar"
std::optional<UnitPoint> PointOf(std::string_view text, std::string_view field,
                                 double ambient_kpa) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  std::string_view left = Trimmed(text.substr(0, equals));
  const std::size_t end = left.find_first_not_of("0123456789.,+-eE");
  const auto raw = ParseQuantity(left.substr(0, end), "count_v");
  const MarkedText right = TakeGaugeMark(Trimmed(text.substr(equals + 1)));
  const auto value =
      ParseQuantity(right.text + std::string(IsPressureField(field) ? MarkOf(right.gauge) : ""),
                    field, {.ambient_kpa_abs = ambient_kpa, .needs_unit = true});
  if (!raw.value || !value.value) return std::nullopt;
  return UnitPoint{*raw.value, *value.value};
}

ScaleOrError ScaleOfPoints(std::string_view field, std::string_view text, double ambient_kpa) {
  std::vector<UnitPoint> points;
  for (const std::string_view piece : catalog::Split(text, ';')) {
    const auto point = PointOf(piece, field, ambient_kpa);
    if (!point)
      return {{},
              Quoted(Trimmed(piece)) +
                  " is no point of a scale; write two as 0.5 V = 0 bar; 4.5 V = 10 bar"};
    points.push_back(*point);
  }
  if (points.size() == 1) points.insert(points.begin(), UnitPoint{});
  if (points.size() != 2 || points[0].raw == points[1].raw || points[0].value == points[1].value)
    return {{}, Quoted(text) + " is no scale: it needs two points that differ"};
  ColumnScale scale;
  scale.numerator = points[1].value - points[0].value;
  scale.denominator = points[1].raw - points[0].raw;
  scale.offset = points[0].value - points[0].raw * scale.numerator / scale.denominator;
  return {scale, ""};
}

}  // namespace

MarkedText TakeGaugeMark(std::string_view text) {
  MarkedText marked;
  for (std::size_t at = 0; at < text.size();) {
    if (!IsLetter(text[at])) {
      marked.text += text[at++];
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && IsLetter(text[end])) ++end;
    const bool in_brackets = at > 0 && text[at - 1] == '(' && end < text.size() && text[end] == ')';
    const MarkedWord word = MarkOfWord(text.substr(at, end - at), in_brackets);
    marked.text += word.left;
    if (word.gauge != Gauge::kUnsaid) marked.gauge = word.gauge;
    if (word.left.empty() && in_brackets) {
      marked.text.pop_back();
      ++end;
    }
    at = end;
  }
  const std::size_t last = marked.text.find_last_not_of(" _-,;");
  marked.text.erase(last == std::string::npos ? 0 : last + 1);
  return marked;
}

std::string_view MarkOf(Gauge gauge) {
  if (gauge == Gauge::kUnsaid) return "";
  return gauge == Gauge::kGauge ? " gauge" : " abs";
}

std::string SpelledUnit(std::string_view unit) {
  unit = Trimmed(unit);
  if (unit == "mPa") return std::string(unit);  // no megapascal
  const Spelling* known = SpellingOf(unit);
  return std::string(known == nullptr ? unit : known->unit);
}

bool IsRawUnit(std::string_view unit) {
  for (const std::string_view raw :
       {"V", "mV", "mA", "A", "count", "counts", "adc", "ADC", "raw", "digits", "LSB", "bits"})
    if (unit == raw) return true;
  return false;
}

bool IsUnitOf(std::string_view field, std::string_view unit) {
  if (unit.empty() || unit.size() > 40) return false;
  if (IsPressureField(field) && IsRawUnit(unit)) return true;
  if (field != kTimeField && !IsReadingField(field)) return false;
  return ParseQuantity("1 " + std::string(unit), field, {.needs_unit = true}).value.has_value();
}

ScaleOrError ScaleOf(std::string_view field, std::string_view unit, double ambient_kpa) {
  if (unit.empty()) return {};
  if (unit.find('=') != std::string_view::npos) return ScaleOfPoints(field, unit, ambient_kpa);
  const MarkedText marked = TakeGaugeMark(unit);
  const std::string name = SpelledUnit(marked.text);
  const auto one = ParseQuantity("1 " + name, field, {.needs_unit = true});
  const auto zero = ParseQuantity("0 " + name, field, {.needs_unit = true});
  if (!one.value || !zero.value)
    return {{},
            Quoted(marked.text) + " is no unit of " + std::string(field) + "; units are " +
                catalog::UnitNames(field)};
  ColumnScale scale;
  const double factor = *one.value - *zero.value, inverse = std::round(1.0 / factor);
  if (1.0 / inverse == factor)
    scale.denominator = inverse;  // as exact as a division
  else
    scale.numerator = factor;
  scale.offset = *zero.value;
  if (marked.gauge == Gauge::kAbsolute) scale.offset -= ambient_kpa;
  return {scale, ""};
}

}  // namespace plenum::api
