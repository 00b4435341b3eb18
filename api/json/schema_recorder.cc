#include "api/json/schema_recorder.h"

#include <algorithm>

#include "api/json/request_limits.h"
#include "catalog/units/quantity.h"

namespace plenum::api {
namespace {

thread_local SchemaRecorder* current = nullptr;

bool IsIndex(std::string_view step) {
  return !step.empty() &&
         std::all_of(step.begin(), step.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool IsNumber(const Json& form) {
  return form.contains("type") && (form["type"] == "number" || form["type"] == "integer");
}

// The lower or the upper bound that allows more.
void Widen(Json& form, const Json& other, const char* inclusive, const char* exclusive, int sign) {
  const auto bound = [&](const Json& of) {
    return of.value(of.contains(inclusive) ? inclusive : exclusive, 0.0) * sign;
  };
  const bool wider =
      bound(other) < bound(form) || (bound(other) == bound(form) && other.contains(inclusive));
  if (!wider) return;
  form.erase(inclusive);
  form.erase(exclusive);
  for (const char* name : {inclusive, exclusive})
    if (other.contains(name)) form[name] = other[name];
}

}  // namespace

Json NumberForm(const Range& range) {
  return {{"type", "number"},
          {range.low_open ? "exclusiveMinimum" : "minimum", range.low},
          {range.high_open ? "exclusiveMaximum" : "maximum", range.high}};
}

Json NoteForm() { return {{"description", "a remark, which comes back unchanged"}}; }

Json QuantityForm(std::string_view name) {
  const std::string units = catalog::UnitNames(name);
  return {{"type", "string"},
          {"maxLength", kTextCharactersMax},
          {"description", "a number with one of the units " + units},
          {"examples", Json::array({"1 " + units.substr(0, units.find(','))})}};
}

bool TakesText(std::string_view name, const Range& range) {
  return !catalog::UnitOf(name).empty() || range.high <= 1.0;
}

Json NumberOrQuantityForm(std::string_view name, const Range& range) {
  if (!TakesText(name, range)) return NumberForm(range);
  return {{"anyOf", {NumberForm(range), QuantityForm(name)}}};
}

SchemaRecorder::SchemaRecorder() { current = this; }
SchemaRecorder::~SchemaRecorder() { current = nullptr; }
SchemaRecorder* SchemaRecorder::Current() { return current; }

SchemaRecorder::Node& SchemaRecorder::FieldOf(Node& node, std::string_view name) {
  const auto found = node.fields.find(name);
  if (found != node.fields.end()) return *found->second;
  node.order.emplace_back(name);
  return *(node.fields[std::string(name)] = std::make_unique<Node>());
}

SchemaRecorder::Node& SchemaRecorder::At(const std::string& pointer) {
  Node* node = &root_;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string_view step(pointer.data() + at + 1, end - at - 1);
    if (IsIndex(step)) {
      if (!node->items) node->items = std::make_unique<Node>();
      node = node->items.get();
    } else {
      node = &FieldOf(*node, step);
    }
    at = end;
  }
  return *node;
}

void SchemaRecorder::AddForm(Node& node, const Json& form) {
  if (form.is_null()) return;
  if (form.contains("anyOf")) {
    for (const Json& one : form["anyOf"]) AddForm(node, one);
    return;
  }
  for (Json& known : node.forms) {
    if (known == form) return;
    if (known.value("type", "") == "array" && form.value("type", "") == "array") {
      if (form.contains("items")) known = form;
      return;
    }
    if (IsNumber(known) && IsNumber(form)) {
      Widen(known, form, "minimum", "exclusiveMinimum", +1);
      Widen(known, form, "maximum", "exclusiveMaximum", -1);
      return;
    }
  }
  node.forms.push_back(form);
}

void SchemaRecorder::Object(const std::string& pointer) { ++At(pointer).visits; }

void SchemaRecorder::Field(const std::string& pointer, std::string_view name, const Json& form,
                           bool required) {
  Node& object = At(pointer);
  Node& field = FieldOf(object, name);
  AddForm(field, form);
  if (!required || field.last_required_visit == object.visits) return;
  field.last_required_visit = object.visits;
  ++field.required_in;
}

void SchemaRecorder::MayBeMissing(const std::string& pointer, std::string_view name) {
  Node& field = FieldOf(At(pointer), name);
  field.may_be_missing = true;
  AddForm(field, {{"type", "null"}});
}

void SchemaRecorder::Fix(const std::string& pointer, std::string_view name, const Json& schema) {
  FieldOf(At(pointer), name).fixed = schema;
}

Json SchemaRecorder::RenderObject(const Node& node) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const std::string& name : node.order) {
    const Node& field = *node.fields.at(name);
    schema["properties"][name] = Render(field);
    if (field.required_in == node.visits && !field.may_be_missing) required.push_back(name);
  }
  if (!required.empty()) schema["required"] = std::move(required);
  schema["additionalProperties"] = false;
  return schema;
}

Json SchemaRecorder::Render(const Node& node) {
  if (!node.fixed.is_null() && !node.may_be_missing) return node.fixed;
  if (!node.fixed.is_null()) return {{"anyOf", {node.fixed, {{"type", "null"}}}}};
  std::vector<Json> forms;
  for (const Json& form : node.forms) {
    const bool is_list = form.contains("type") && form["type"] == "array";
    forms.push_back(form);
    if (is_list && node.items && !form.contains("items"))
      forms.back()["items"] = Render(*node.items);
  }
  if (node.visits > 0) forms.push_back(RenderObject(node));
  if (forms.empty()) return Json::object();
  if (forms.size() == 1) return forms.front();
  return {{"anyOf", forms}};
}

Json SchemaRecorder::Schema() const { return Render(root_); }

}  // namespace plenum::api
