#include "server/resources/schemas/schema_forms.h"

#include <utility>

namespace plenum::server {

using api::Json;

Json Ref(const std::string& kind, const std::string& name) {
  return {{"$ref", "#/components/" + kind + "/" + name}};
}

Json Object(const Json& properties) {
  Json required = Json::array();
  for (const auto& [name, schema] : properties.items()) required.push_back(name);
  return {{"type", "object"}, {"properties", properties}, {"required", required}};
}
Json ListOf(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json NamedListOf(const std::string& name, const Json& items) {
  return Object({{name, ListOf(items)}});
}

namespace {

// What an answer says of its request, each where there is something to say.
Json RemarkSchemas() {
  const Json text = {{"type", "string"}}, any = Json::object();
  Json understood =
      Object({{"pointer", text}, {"given", any}, {"value", {{"type", "number"}}}, {"unit", text}});
  for (const char* name : {"condition", "name", "formula"}) understood["properties"][name] = text;
  return {{"understood", ListOf(understood)},
          {"warnings", ListOf({{"anyOf", {Object({{"pointer", text}, {"detail", text}}), text}}})},
          {"notes", ListOf(Object({{"pointer", text}, {"note", any}}))}};
}

}  // namespace

Json Versioned(const char* schema) {
  Json properties = {{"schema", {{"const", schema}}}, {"plenum", {{"type", "string"}}}};
  properties.update(RemarkSchemas());
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", {"schema", "plenum"}}};
}

}  // namespace plenum::server
