// Documents against the JSON schemas of the service's description.
#ifndef PLENUM_TESTS_SERVER_RESOURCES_SCHEMA_CHECK_H_
#define PLENUM_TESTS_SERVER_RESOURCES_SCHEMA_CHECK_H_

#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "api/json/json.h"

namespace plenum::server {

// valijson resolves no references between documents, so each schema is put out in full.
inline api::Json Resolved(const api::Json& schema, const api::Json& whole) {
  if (schema.is_object() && schema.contains("$ref")) {
    const auto pointer = schema["$ref"].get<std::string>().substr(1);
    return Resolved(whole.at(api::Json::json_pointer(pointer)), whole);
  }
  api::Json resolved = schema;
  if (schema.is_structured())
    for (std::size_t i = 0; auto& [key, value] : resolved.items())
      value = Resolved(schema.is_array() ? schema[i++] : schema.at(key), whole);
  return resolved;
}

// What is wrong with a document, empty if nothing is.
inline std::string Violations(const api::Json& schema, const api::Json& document) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const auto plain = [](const api::Json& json) { return nlohmann::json::parse(json.dump()); };
  const auto schema_json = plain(schema), document_json = plain(document);
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(Adapter(schema_json), parsed);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(parsed, Adapter(document_json), &results)) return "";
  std::string text;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    for (const auto& step : error.context) text += step;
    text += ": " + error.description + "\n";
  }
  return text;
}

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_RESOURCES_SCHEMA_CHECK_H_
