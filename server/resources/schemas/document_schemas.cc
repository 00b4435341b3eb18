#include "server/resources/schemas/document_schemas.h"

#include <string>

#include "api/catalogue/documents/part_files.h"
#include "server/resources/schemas/schema_forms.h"

namespace plenum::server {

using api::Json;

Json DocumentSchemas() {
  const Json text = {{"type", "string"}}, integer = {{"type", "integer"}};
  Json file = Object({{"media_type", text}, {"bytes", integer}, {"href", text}});
  file["type"] = {"object", "null"};
  const Json document = Object({{"link", text}, {"sha256", text}, {"file", std::move(file)}});
  const Json revision = Object({{"number", integer}, {"hash", text}});
  return {
      {"DocumentOfPart", {{"allOf", {document, Object({{"catalogue_revision", revision}})}}}},
      {"Documents",
       Object({{"id", text}, {"documents", ListOf(document)}, {"catalogue_revision", revision}})}};
}

Json DocumentBody() {
  Json content = Json::object();
  for (const std::string_view type : api::DocumentTypes())
    content[std::string(type)]["schema"] = Ref("schemas", "Unit");
  return {{"required", true}, {"content", std::move(content)}};
}

}  // namespace plenum::server
