#include "api/json/reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <variant>

#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/unit_slips.h"
#include "api/json/words.h"
#include "catalog/units/quantity.h"

namespace plenum::api {
namespace {

const Json kNullForm = {{"type", "null"}};
const Json kTextForm = {{"type", "string"}, {"minLength", 1}, {"maxLength", kTextCharactersMax}};

Json ListForm(std::size_t least, std::size_t most) {
  return {{"type", "array"}, {"minItems", least}, {"maxItems", most}};
}

std::string SizeText(std::size_t least, std::size_t most) {
  return "must be a list of " + std::to_string(least) + " to " + std::to_string(most) + " elements";
}

// The number of a text with a unit, for a field whose name ends in one, or what is wrong with it.
std::variant<double, std::string> ReadQuantity(const std::string& text, const std::string& pointer,
                                               Range range, std::string_view name) {
  RemarkRecorder* remarks = RemarkRecorder::Current();
  const catalog::Quantity quantity = catalog::ParseQuantity(
      text, name,
      {.ambient_kpa_abs = remarks == nullptr ? std::nullopt : remarks->ambient_kpa_abs(),
       .needs_unit = true});
  const std::string unit(catalog::UnitOf(name));
  const std::string allowed = range.Text() + (unit.empty() ? "" : " " + unit);
  if (!quantity.value) return quantity.error + "; allowed are " + allowed;
  // Without the noise of the conversion, so that a bound in another unit is within its range.
  const double number = Rounded(*quantity.value);
  if (!range.Contains(number))
    return "must be " + allowed + ", not " + Decimal(number) + " (" + Quoted(text) + ")";
  if (remarks == nullptr) return number;
  Json understood = {{"given", text}, {"value", number}, {"unit", unit}};
  if (!quantity.condition.empty()) understood["condition"] = quantity.condition;
  remarks->Understood(pointer, understood);
  return number;
}

}  // namespace

bool Range::Contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::Text() const {
  return std::string(low_open ? "> " : "≥ ") + Decimal(low) + " and " + (high_open ? "< " : "≤ ") +
         Decimal(high);
}

std::string KindOf(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::string:
      return "the text " + Quoted(value.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    default:
      return Decimal(value.get<double>());
  }
}

Reader::Reader(const Json& value, std::string pointer, Errors& errors)
    : pointer_(std::move(pointer)), errors_(&errors) {
  if (auto* recorder = SchemaRecorder::Current()) recorder->Object(pointer_);
  if (!value.is_object()) {
    FailHere("must be an object, not " + KindOf(value));
    return;
  }
  object_ = &value;
  // A note is allowed in every object of a document whose answer gives it back.
  if (auto* remarks = RemarkRecorder::Current()) {
    Note("note", false, NoteForm);
    if (const Json* note = Raw("note")) remarks->Note(pointer_, *note);
  }
}

Reader::Reader(const Element& element, Errors& errors)
    : Reader(*element.value, element.pointer, errors) {}

template <typename MakeForm>
void Reader::Note(std::string_view name, bool required, MakeForm&& form) {
  if (auto* recorder = SchemaRecorder::Current()) recorder->Field(pointer_, name, form(), required);
}

void Reader::Describe(std::string_view name, const Json& schema) {
  if (auto* recorder = SchemaRecorder::Current()) recorder->Fix(pointer_, name, schema);
}

const Json* Reader::Raw(std::string_view name) {
  if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.emplace_back(name);
  Note(name, false, [] { return Json(); });
  if (object_ == nullptr) return nullptr;
  const auto found = object_->find(std::string(name));
  return found == object_->end() ? nullptr : &*found;
}

bool Reader::Has(std::string_view name) {
  if (auto* recorder = SchemaRecorder::Current()) recorder->MayBeMissing(pointer_, name);
  const Json* value = Raw(name);
  return value != nullptr && !value->is_null();
}

const Json* Reader::Required(std::string_view name) {
  Note(name, true, [] { return Json(); });
  const Json* value = Raw(name);
  if (value == nullptr && object_ != nullptr) Fail(name, "is required");
  return value;
}

double Reader::ReadNumber(const Json& value, const std::string& pointer, Range range,
                          std::string_view name) {
  const bool in_percent = value.is_string() && value.get_ref<const std::string&>().ends_with('%');
  if (value.is_string() && (in_percent ? TakesText(name, range) : !catalog::UnitOf(name).empty())) {
    const auto read = ReadQuantity(value.get_ref<const std::string&>(), pointer, range, name);
    if (const double* number = std::get_if<double>(&read)) return *number;
    Report(pointer, std::get<std::string>(read));
    return kNaN;
  }
  if (!value.is_number()) {
    Report(pointer, "must be a number " + range.Text() + ", not " + KindOf(value));
    return kNaN;
  }
  const double number = value.get<double>();
  if (!range.Contains(number)) {
    Report(pointer, "must be " + range.Text() + ", not " + Decimal(number));
    return kNaN;
  }
  if (auto* remarks = RemarkRecorder::Current())
    if (const std::string slip = LooksLikeAnotherUnit(pointer, number); !slip.empty())
      remarks->Warn(pointer, slip);
  return number;
}

double Reader::Number(std::string_view name, Range range) {
  Note(name, true, [&] { return NumberOrQuantityForm(name, range); });
  const Json* value = Raw(name);
  if (value != nullptr) return ReadNumber(*value, Pointer(name), range, name);
  if (object_ != nullptr) Fail(name, "is required, a number " + range.Text());
  return kNaN;
}

double Reader::Number(std::string_view name, Range range, double fallback) {
  Note(name, false, [&] { return NumberOrQuantityForm(name, range); });
  const Json* value = Raw(name);
  return value == nullptr ? fallback : ReadNumber(*value, Pointer(name), range, name);
}

std::optional<double> Reader::OptionalNumber(std::string_view name, Range range) {
  Note(name, false, [&] { return NumberOrQuantityForm(name, range); });
  Note(name, false, [] { return kNullForm; });
  if (!Has(name)) return std::nullopt;
  return ReadNumber(*Raw(name), Pointer(name), range, name);
}

int Reader::Integer(std::string_view name, int low, int high, std::optional<int> fallback) {
  const Range range{double(low), double(high)};
  Note(name, false, [&] {
    Json form = NumberForm(range);
    form["type"] = "integer";
    return form;
  });
  const double number = fallback ? Number(name, range, *fallback) : Number(name, range);
  if (std::isnan(number)) return low;
  if (number == std::floor(number)) return static_cast<int>(number);
  Fail(name, "must be a whole number " + range.Text() + ", not " + Decimal(number));
  return low;
}

bool Reader::Bool(std::string_view name, bool fallback) {
  Note(name, false, [] { return Json{{"type", "boolean"}}; });
  const Json* value = Raw(name);
  if (value == nullptr) return fallback;
  if (value->is_boolean()) return value->get<bool>();
  Fail(name, "must be true or false, not " + KindOf(*value));
  return fallback;
}

std::string Reader::Text(std::string_view name, std::optional<std::string> fallback) {
  Note(name, !fallback, [] { return kTextForm; });
  const Json* value = fallback ? Raw(name) : Required(name);
  if (value == nullptr) return std::move(fallback).value_or("");
  if (!value->is_string()) {
    Fail(name, "must be a text, not " + KindOf(*value));
    return "";
  }
  const std::string& text = value->get_ref<const std::string&>();
  const std::size_t length = CountCharacters(text);
  if (length >= 1 && length <= kTextCharactersMax) return text;
  Fail(name, "must have 1 to " + std::to_string(kTextCharactersMax) + " characters, not " +
                 std::to_string(length));
  return "";
}

std::string Reader::Choice(std::string_view name, const std::vector<std::string>& allowed,
                           std::optional<std::string> fallback) {
  Note(name, !fallback, [&] { return Json{{"type", "string"}, {"enum", allowed}}; });
  const Json* value = Raw(name);
  if (value == nullptr) {
    if (!fallback && object_ != nullptr) Fail(name, "is required, " + OneOf(allowed));
    return std::move(fallback).value_or("");
  }
  if (value->is_string()) {
    const std::string& text = value->get_ref<const std::string&>();
    if (std::find(allowed.begin(), allowed.end(), text) != allowed.end()) return text;
  }
  Fail(name, "must be " + OneOf(allowed) + ", not " + KindOf(*value));
  return "";
}

Reader Reader::Object(std::string_view name) {
  const Json* value = Required(name);
  if (value == nullptr) return Reader(Pointer(name), *errors_);
  return Reader(*value, Pointer(name), *errors_);
}

std::optional<Reader> Reader::OptionalObject(std::string_view name) {
  Note(name, false, [] { return kNullForm; });
  if (!Has(name)) return std::nullopt;
  return Reader(*Raw(name), Pointer(name), *errors_);
}

std::vector<Element> Reader::List(std::string_view name, std::size_t least, std::size_t most) {
  Note(name, least > 0, [&] { return ListForm(least, most); });
  const Json* value = least == 0 ? Raw(name) : Required(name);
  if (value == nullptr) return {};
  if (!value->is_array()) {
    Fail(name, SizeText(least, most) + ", not " + KindOf(*value));
    return {};
  }
  if (value->size() < least || value->size() > most) {
    Fail(name, SizeText(least, most) + ", not of " + std::to_string(value->size()));
    return {};
  }
  std::vector<Element> elements;
  for (std::size_t i = 0; i < value->size(); ++i)
    elements.push_back({&(*value)[i], Pointer(name) + "/" + std::to_string(i)});
  return elements;
}

std::vector<std::string> Reader::Texts(std::string_view name, std::size_t least, std::size_t most) {
  Note(name, least > 0, [&] {
    Json form = ListForm(least, most);
    form["items"] = {{"type", "string"}};
    form["uniqueItems"] = true;
    return form;
  });
  std::vector<std::string> texts;
  std::set<std::string> seen;
  for (const Element& element : List(name, least, most)) {
    std::string text;
    if (!element.value->is_string())
      Report(element.pointer, "must be a text, not " + KindOf(*element.value));
    else if (text = element.value->get<std::string>(); !seen.insert(text).second)
      Report(element.pointer, Quoted(text) + " is listed twice");
    texts.push_back(std::move(text));  // keeps its place, so that an index is a pointer
  }
  return texts;
}

std::vector<double> Reader::Numbers(std::string_view name, std::size_t most, Range range) {
  Note(name, true, [&] { return NumberForm(range); });
  Note(name, true, [&] {
    Json form = ListForm(1, most);
    form["items"] = NumberForm(range);
    return form;
  });
  if (const Json* value = Raw(name); value != nullptr && value->is_number())
    return {ReadNumber(*value, Pointer(name), range, "")};
  std::vector<double> numbers;
  for (const Element& element : List(name, 1, most))
    numbers.push_back(ReadNumber(*element.value, element.pointer, range, ""));
  return numbers;
}

std::vector<std::string> Reader::Names() const {
  std::vector<std::string> names;
  if (object_ != nullptr)
    for (const auto& [name, value] : object_->items()) names.push_back(name);
  return names;
}

std::string Reader::Pointer(std::string_view name) const {
  return pointer_ + "/" + EscapePointer(name);
}

void Reader::Fail(std::string_view name, std::string detail) {
  Report(Pointer(name), std::move(detail));
}

void Reader::FailAt(std::string_view path, std::string detail) {
  Report(pointer_ + "/" + std::string(path), std::move(detail));
}

bool Reader::Full() const { return errors_->size() >= kErrorsCollectedMax; }

void Reader::Report(std::string pointer, std::string detail) {
  if (!Full()) errors_->push_back({std::move(pointer), std::move(detail)});
}

void Reader::FailHere(std::string detail) { Report(pointer_, std::move(detail)); }

void Reader::Finish() {
  for (const std::string& name : Names()) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    if (Full()) return;
    const std::string nearest = Nearest(name, known_);
    Report(pointer_ + "/" + EscapePointer(Clip(name, 200)),
           "unknown field" + (nearest.empty() ? "" : "; nearest known: " + nearest));
  }
}

}  // namespace plenum::api
