#include "tests/server/enemy.h"

#include <cmath>
#include <functional>
#include <limits>

namespace plenum::server {
namespace {

using api::Json;

// The alternatives of a schema, or the schema itself.
std::vector<Json> Forms(const Json& schema) {
  if (!schema.contains("anyOf")) return {schema};
  std::vector<Json> forms;
  for (const Json& alternative : schema["anyOf"])
    for (const Json& form : Forms(alternative)) forms.push_back(form);
  return forms;
}

double LowOf(const Json& form) {
  return form.value("minimum", form.value("exclusiveMinimum", 0.0));
}
double HighOf(const Json& form) {
  return form.value("maximum", form.value("exclusiveMaximum", 1.0));
}

// Whether the schema says anything of the kind of a value.
bool SaysNothing(const Json& schema) { return schema.empty() || !schema.is_object(); }

bool Takes(const Json& form, const Json& value) {
  if (form.contains("const")) return form["const"] == value;
  if (form.contains("enum")) {
    for (const Json& allowed : form["enum"])
      if (allowed == value) return true;
    return false;
  }
  const Json& types = In(form, "type");
  if (types.is_null()) return true;
  const auto is = [&](const char* type) {
    if (types.is_string()) return types == type;
    for (const Json& one : types)
      if (one == type) return true;
    return false;
  };
  if (value.is_null()) return is("null");
  if (value.is_boolean()) return is("boolean");
  if (value.is_string()) return is("string");
  if (value.is_array()) return is("array");
  if (value.is_object()) return is("object");
  if (!is("number") && !is("integer")) return false;
  const double number = value.get<double>();
  if (is("integer") && number != std::floor(number)) return false;
  return number >= form.value("minimum", -HUGE_VAL) && number <= form.value("maximum", HUGE_VAL) &&
         number > form.value("exclusiveMinimum", -HUGE_VAL) &&
         number < form.value("exclusiveMaximum", HUGE_VAL);
}

bool AnyTakes(const Json& schema, const Json& value) {
  if (SaysNothing(schema)) return true;
  for (const Json& form : Forms(schema))
    if (SaysNothing(form) || Takes(form, value)) return true;
  return false;
}

std::string Escaped(std::string step) {
  for (std::size_t at = 0; (at = step.find_first_of("~/", at)) != std::string::npos; at += 2)
    step.replace(at, 1, step[at] == '~' ? "~0" : "~1");
  return step;
}

// Whether the value has what the form fixes: of several forms the one that it is written in.
bool IsMeant(const Json& form, const Json& value) {
  for (const auto& [name, inner] : In(form, "properties").items()) {
    if (!value.contains(name)) continue;
    if (inner.is_object() && inner.contains("const") && inner["const"] != value[name]) return false;
    if (TypeOf(inner) == "object" && value[name].is_object() && !IsMeant(inner, value[name]))
      return false;
  }
  return true;
}

class Breaker {
 public:
  Breaker(const Json& document, std::mt19937& random) : document_(document), random_(random) {}

  // Values of another kind or out of range in place of the one at `pointer`.
  void Replace(const Json& schema, const std::string& pointer) {
    std::vector<Json> values = {
        nullptr, true, "x", Json::array(),          Json::object(),         -1e300,
        1e300,   0.5,  -1,  std::string(5000, 'y'), Json::array({nullptr}), 1e-300};
    for (const Json& form : Forms(schema)) {
      if (TypeOf(form) != "number" && TypeOf(form) != "integer") continue;
      const double low = LowOf(form), high = HighOf(form), span = high - low;
      std::uniform_real_distribution<double> beyond(0.0, 1.0);
      for (int i = 0; i < 3; ++i) {
        values.push_back(low - span * beyond(random_) - 1e-6);
        values.push_back(high + span * beyond(random_) + 1e-6);
      }
      values.push_back(std::nextafter(low, -HUGE_VAL));
      values.push_back(std::nextafter(high, HUGE_VAL));
    }
    for (const Json& value : values)
      if (!AnyTakes(schema, value)) Put(pointer, value);
  }

  void Walk(const Json& schema, const std::string& pointer) {
    if (SaysNothing(schema)) return;
    if (!pointer.empty()) Replace(schema, pointer);
    const Json& value = document_.at(Json::json_pointer(pointer));
    for (const Json& form : Forms(schema)) {
      if (TypeOf(form) == "object" && value.is_object() && IsMeant(form, value))
        WalkObject(form, value, pointer);
      if (TypeOf(form) == "array" && value.is_array()) WalkArray(form, value, pointer);
    }
  }

  std::vector<BadDocument> Take() { return std::move(bad_); }

 private:
  void WalkObject(const Json& form, const Json& value, const std::string& pointer) {
    const Json& others = In(form, "additionalProperties");
    if (others == false) {
      const std::string name = "no_such_field" + std::to_string(bad_.size());
      Put(pointer + "/" + name, 1);
    }
    for (const Json& name : In(form, "required"))
      if (value.contains(name.get<std::string>())) Remove(pointer, name.get<std::string>());
    for (const auto& [name, inner] : In(form, "properties").items()) {
      const std::string place = pointer + "/" + Escaped(name);
      if (value.contains(name))
        Walk(inner, place);
      else if (!SaysNothing(inner))
        Replace(inner, place);
    }
    if (!others.is_object()) return;
    for (const auto& [name, inner] : value.items())
      if (!In(form, "properties").contains(name)) Walk(others, pointer + "/" + Escaped(name));
  }

  void WalkArray(const Json& form, const Json& value, const std::string& pointer) {
    const auto least = form.value("minItems", 0u), most = form.value("maxItems", 1'000'000u);
    if (least > 0) Put(pointer, Json::array());
    if (!value.empty() && most <= 1000) {
      Json longer = value;
      while (longer.size() <= most) longer.push_back(value[0]);
      Put(pointer, longer);
    }
    if (!value.empty() && form.contains("items")) Walk(form["items"], pointer + "/0");
  }

  void Put(const std::string& pointer, const Json& value) {
    Json document = document_;
    document[Json::json_pointer(pointer)] = value;
    bad_.push_back({document.dump(), pointer});
  }
  void Remove(const std::string& pointer, const std::string& name) {
    Json document = document_;
    document[Json::json_pointer(pointer)].erase(name);
    bad_.push_back({document.dump(), pointer + "/" + Escaped(name)});
  }

  const Json& document_;
  std::mt19937& random_;
  std::vector<BadDocument> bad_;
};

}  // namespace

const Json& In(const Json& form, const std::string& name) {
  static const Json kNothing;
  return form.contains(name) ? form[name] : kNothing;
}

std::string TypeOf(const Json& form) {
  const Json& type = In(form, "type");  // the first of several
  if (type.is_array()) return type[0].get<std::string>();
  return type.is_string() ? type.get<std::string>() : "";
}

Json FullDocument(const Json& schema, unsigned turn) {
  std::vector<Json> forms;
  for (const Json& form : Forms(schema))
    if (TypeOf(form) != "null") forms.push_back(form);
  if (forms.empty()) return nullptr;
  const Json& form = forms[turn % forms.size()];
  if (form.contains("const")) return form["const"];
  if (form.contains("enum")) return form["enum"][turn % form["enum"].size()];
  const std::string type = TypeOf(form);
  if (type == "object") {
    Json object = Json::object();
    for (const auto& [name, inner] : In(form, "properties").items())
      object[name] = FullDocument(inner, turn);
    if (const Json& others = In(form, "additionalProperties");
        others.is_object() && !others.empty())
      object["x"] = FullDocument(others, turn);
    return object;
  }
  if (type == "array") {
    Json array = Json::array();
    const auto least = std::max(1u, form.value("minItems", 1u));
    while (form.contains("items") && array.size() < least)
      array.push_back(FullDocument(form["items"], turn + static_cast<unsigned>(array.size())));
    return array;
  }
  if (type == "integer") return std::ceil(LowOf(form)) + 1;
  if (type == "number") return LowOf(form) + 0.01 * (HighOf(form) - LowOf(form));
  if (type == "boolean") return turn % 2 == 0;
  return "x";
}

std::vector<BadDocument> BadDocuments(const Json& schema, const Json& document,
                                      std::mt19937& random) {
  Breaker breaker(document, random);
  breaker.Walk(schema, "");
  return breaker.Take();
}

}  // namespace plenum::server
