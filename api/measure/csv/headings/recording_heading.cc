#include "api/measure/csv/headings/recording_heading.h"

#include <algorithm>
#include <vector>

#include "api/json/words.h"
#include "api/measure/csv/headings/recording_units.h"
#include "api/measure/csv/headings/recording_words.h"
#include "catalog/tables/heading_phrases.h"

namespace plenum::api {
namespace {

using catalog::HeadingMatch;
using catalog::HeadingPhrase;
using catalog::Target;
using catalog::Trimmed;

constexpr std::size_t kHeadingBytes = 120;

bool SaysNoUnit(std::string_view unit) {
  return unit.find_first_not_of(" -–()[]") == std::string_view::npos || unit == "1";
}

// "hh:mm:ss.fff", "h:m:s", "UTC": of clock times.
bool IsClockFormat(std::string_view unit) {
  if (unit == "UTC" || unit == "ISO 8601") return true;
  return unit.find(':') != std::string_view::npos &&
         unit.find_first_not_of("hHmMsSfx0.,:") == std::string_view::npos;
}

Target TargetOf(std::string_view field, std::string_view unit, Gauge gauge) {
  Target target{std::string(field), std::string(unit)};
  if (IsPressureField(field) && gauge != Gauge::kUnsaid) {
    const std::string_view mark = MarkOf(gauge);
    target.unit += unit.empty() ? mark.substr(1) : mark;
  }
  return target;
}

bool IsTextField(std::string_view field) {
  return field == kRunField || field == kSpecimenField || field == kDateField;
}

// The fields of a phrase that may have its unit.
std::vector<Target> TargetsOf(const HeadingPhrase& phrase, Gauge gauge) {
  std::vector<Target> targets;
  const std::string unit = SpelledUnit(phrase.unit);
  for (const std::string_view field : FieldsNamed(phrase.words)) {
    const bool plain =
        phrase.in_brackets && (SaysNoUnit(unit) || IsValveField(field) || IsTextField(field) ||
                               (field == kTimeField && IsClockFormat(unit)));
    if (plain)
      targets.push_back(TargetOf(field, "", gauge));
    else if (IsUnitOf(field, unit))
      targets.push_back(TargetOf(field, unit, gauge));
  }
  return targets;
}

// "Supply [bar]", "Sensor 3 [bar]", "x [ms]".
std::vector<Target> TargetsOfUnit(const HeadingPhrase& phrase, Gauge gauge) {
  const std::string unit = SpelledUnit(phrase.unit);
  if (!phrase.in_brackets || IsRawUnit(unit)) return {};
  for (const char* quantity : {"pressure ", "time "}) {
    const auto fields = FieldsNamed(quantity + std::string(phrase.words));
    if (fields.size() == 1 && IsUnitOf(fields.front(), unit))
      return {TargetOf(fields.front(), unit, gauge)};
  }
  return {};
}

}  // namespace

HeadingMatch MatchRecordingHeading(std::string_view heading) {
  heading = Trimmed(heading);
  if (heading.empty() || heading.size() > kHeadingBytes) return {};
  const auto& fields = RecordingFields();
  if (std::find(fields.begin(), fields.end(), heading) != fields.end())
    return {{{std::string(heading), "", std::nullopt, true}}, ""};
  const MarkedText marked = TakeGaugeMark(heading);
  if (Trimmed(marked.text).empty()) return {};
  std::string wrong_unit;
  const auto phrases = catalog::SplitHeading(marked.text);
  for (const HeadingPhrase& phrase : phrases) {
    if (FieldsNamed(phrase.words).empty()) continue;
    if (auto targets = TargetsOf(phrase, marked.gauge); !targets.empty())
      return {std::move(targets), ""};
    if (phrase.in_brackets) wrong_unit = phrase.unit;
  }
  if (!wrong_unit.empty()) return {{}, std::move(wrong_unit)};
  for (const HeadingPhrase& phrase : phrases)
    if (auto targets = TargetsOfUnit(phrase, marked.gauge); !targets.empty())
      return {std::move(targets), ""};
  std::vector<Target> targets;
  for (const std::string_view field : FieldsNamed(marked.text))
    targets.push_back(TargetOf(field, "", marked.gauge));
  // "T" without a unit is a time, as far as headings go.
  if (targets.size() > 1) targets.resize(1);
  // "millis" and "ms" are time and its unit at once.
  const std::string unit = SpelledUnit(marked.text);
  if ((targets.empty() || targets.front().column == kTimeField) && IsUnitOf(kTimeField, unit))
    return {{TargetOf(kTimeField, unit, Gauge::kUnsaid)}, ""};
  return {std::move(targets), ""};
}

catalog::GivenTarget ParseRecordingTarget(std::string_view text) {
  text = Trimmed(text);
  const std::size_t open = text.find('[');
  Target target{std::string(Trimmed(text.substr(0, open))), ""};
  const auto& fields = RecordingFields();
  if (std::find(fields.begin(), fields.end(), target.column) == fields.end())
    return {{},
            Quoted(target.column) +
                " is no field of a recording; nearest: " + Nearest(target.column, fields)};
  if (open == std::string_view::npos) return {std::move(target), ""};
  if (!text.ends_with("]")) return {{}, "the bracket behind " + target.column + " is not closed"};
  target.unit = Trimmed(text.substr(open + 1, text.size() - open - 2));
  if (target.unit.empty() || IsValveField(target.column)) return {std::move(target), ""};
  if (IsTextField(target.column)) return {{}, target.column + " has no unit"};
  const MarkedText marked = TakeGaugeMark(target.unit);
  if (IsPressureField(target.column) && marked.text.empty()) return {std::move(target), ""};
  if (IsPressureField(target.column) && IsRawUnit(SpelledUnit(marked.text)))
    return {std::move(target), ""};
  if (auto scale = ScaleOf(target.column, target.unit, 100.0); !scale.error.empty())
    return {{}, std::move(scale.error)};
  return {std::move(target), ""};
}

}  // namespace plenum::api
