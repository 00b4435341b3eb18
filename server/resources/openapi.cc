#include "server/resources/openapi.h"

#include <string>

#include "api/catalogue/table_reading.h"
#include "api/describe/catalogue_answers.h"
#include "api/describe/descriptions.h"
#include "api/describe/design_answers.h"
#include "api/json/schema_recorder.h"
#include "api/protocol/test_sensor.h"
#include "server/call/lower_case.h"
#include "server/resources/schemas/diagnosis_schemas.h"
#include "server/resources/schemas/document_schemas.h"
#include "server/resources/schemas/operations.h"
#include "server/resources/schemas/schema_forms.h"
#include "server/resources/schemas/sweep_schemas.h"

namespace plenum::server {
namespace {

using api::Json;

constexpr char kJson[] = "application/json", kCsv[] = "text/csv";

Json Parameter(const char* place, const char* name, Json schema, const char* description) {
  return {
      {"name", name}, {"in", place}, {"schema", std::move(schema)}, {"description", description}};
}
Json Header(const char* name, const char* description) {
  return Parameter("header", name, {{"type", "string"}}, description);
}
Json Query(const char* name, Json schema, const char* description) {
  return Parameter("query", name, std::move(schema), description);
}
Json InPath(const char* name, Json schema, const char* description) {
  Json parameter = Parameter("path", name, std::move(schema), description);
  parameter["required"] = true;
  return parameter;
}

Json Parameters() {
  const Json text = {{"type", "string"}}, flag = {{"type", "boolean"}};
  return {
      {"id", InPath("id", text, "of the part, job or sweep")},
      {"rank", InPath("rank", {{"type", "integer"}, {"minimum", 1}}, "of the design")},
      {"sha256_of", InPath("sha256", text, "of the file, 64 hexadecimal digits")},
      {"link", Query("link", text, "where the document was found, or a file name")},
      {"sha256", Query("sha256", text, "that the file must have")},
      {"path", InPath("path", text, "of a file of the documentation; empty for its first page")},
      {"limit", Query("limit", {{"type", "integer"}, {"minimum", 1}, {"maximum", 1000}},
                      "entries of a page")},
      {"cursor", Query("cursor", text, "next_cursor of the page before")},
      {"family", Query("family", text, "of parts")},
      {"ids", Query("ids", text, "of two to eight parts, with commas between")},
      {"dry_run", Query("dry_run", flag, "say what would be done, write nothing")},
      {"encoding", Query("encoding", {{"enum", catalog::EncodingNames()}}, "of the table")},
      {"delimiter", Query("delimiter", {{"enum", catalog::DelimiterNames()}}, "of the table")},
      {"decimal", Query("decimal", {{"enum", {"point", "comma"}}}, "what stands before decimals")},
      {"header_row",
       Query("header_row", {{"type", "integer"}, {"minimum", 1}}, "the row with the headings")},
      {"column", Query("column", {{"type", "array"}, {"items", text}},
                       "HEADING=COLUMN [UNIT]; HEADING= leaves a column out, *= all not known")},
      {"set", Query("set", {{"type", "array"}, {"items", text}}, "COLUMN=VALUE for all rows")},
      {"sensor_noise_kpa", Query("sensor_noise_kpa", api::NumberForm(api::SensorKpaRange()),
                                 "of a reading, one standard deviation; 0.2 without it")},
      {"sensor_resolution_kpa",
       Query("sensor_resolution_kpa", api::NumberForm(api::SensorKpaRange()),
             "step of the readings; 0.1 without it")},
      {"sampling_hz", Query("sampling_hz", api::NumberForm(api::SamplingRange()),
                            "readings a second, at most; 100 without it")},
      {"bottle_l", Query("bottle_l", api::NumberForm(api::BottleRange()),
                         "volume of the bottle; a fitting one without it")},
      {"bottle_uncertainty",
       Query("bottle_uncertainty", api::NumberForm(api::BottleUncertaintyRange()),
             "of its volume, relative: 0.002 of one weighed full of water; 0.02 is assumed "
             "without it")},
      {"validate_only", Query("validate_only", flag, "check the document, start no job")},
      {"revision", Query("revision", {{"type", "integer"}, {"minimum", 0}},
                         "as it was in this revision of the catalogue")},
      {"priority", Query("priority", {{"type", "integer"}, {"minimum", -100}, {"maximum", 0}},
                         "below 0: after all jobs of a higher one, whoever asked; default 0")},
      {"format", Query("format", {{"enum", {"json", "csv"}}}, "of the table; else by Accept")},
      {"Prefer", Header("Prefer", "wait=N: up to N seconds for the result")},
      {"Idempotency-Key", Header("Idempotency-Key", "repetitions with the same key act once")},
      {"From", Header("From", "who writes")},
      {"If-Match", Header("If-Match", "ETag of what is replaced or removed; needed")},
      {"If-None-Match", Header("If-None-Match", "ETag of what the client has")}};
}

// Of answers: the fields that callers may rely on; more may come.
Json AnswerSchemas() {
  const Json text = {{"type", "string"}}, number = {{"type", "number"}};
  const Json integer = {{"type", "integer"}}, maybe_text = {{"type", {"string", "null"}}};
  const Json flag = {{"type", "boolean"}}, any = Json::object();
  const Json ids = ListOf(text);
  const Json name_of_revision = Object({{"number", integer}, {"hash", text}});
  const Json revision =
      Object({{"number", integer}, {"hash", text}, {"at", text}, {"who", text}, {"what", text}});
  const Json change = Object({{"id", text}, {"before", any}, {"after", any}});
  const Json checks = {{"type", "object"},
                       {"additionalProperties", {{"enum", {"ok", "busy", "failed"}}}}};
  const Json status = {{"enum", {"queued", "running", "done", "cancelled", "failed"}}};
  const Json links = Object({{"self", text}, {"events", text}});
  Json schemas = {
      {"Problem",
       {{"type", "object"},
        {"properties",
         {{"type", text},
          {"title", text},
          {"status", integer},
          {"detail", text},
          {"errors", ListOf(Object({{"pointer", text}, {"detail", text}}))},
          {"limit", Object({{"name", text}, {"value", any}})},
          {"questions", ListOf(any)},
          {"understood", any}}},
        {"required", {"type", "title", "status"}}}},
      {"Anything", any},
      {"Text", text},
      {"Csv", text},
      {"Unit", {{"type", "string"}, {"format", "binary"}}},
      {"Health", Object({{"status", {{"const", "ok"}}}})},
      {"Readiness", Object({{"status", text}, {"checks", checks}})},
      {"Limits", Object({{"limits", {{"type", "object"}, {"additionalProperties", number}}}})},
      {"RouteTable",
       NamedListOf("routes", Object({{"method", text}, {"path", text}, {"summary", text}}))},
      {"JobAccepted", Object({{"id", text}, {"status", status}, {"links", links}})},
      {"Job", Object({{"id", text},
                      {"name", text},
                      {"status", status},
                      {"attempts", integer},
                      {"crashes", integer},
                      {"last_crash", maybe_text},
                      {"progress", any},
                      {"result", any},
                      {"links", links}})},
      {"Jobs", NamedListOf("jobs", Object({{"id", text},
                                           {"name", text},
                                           {"status", status},
                                           {"attempts", integer},
                                           {"crashes", integer},
                                           {"last_crash", maybe_text},
                                           {"progress", any},
                                           {"links", links}}))},
      {"Designs", Versioned("designs/1")},
      {"DesignsOrValid",
       {{"anyOf", {Ref("schemas", "Designs"), Object({{"valid", {{"const", true}}}})}}}},
      {"Response", Versioned("response/1")},
      {"MapAnswer", Versioned("map_answer/1")},
      {"Recorded", api::DescribeRecordingAnswer()},
      {"EvaluationAnswer", Versioned("evaluation_answer/1")},
      {"StoredPart",
       {{"allOf", {Ref("schemas", "Part"), {{"type", "object"}, {"required", {"id", "origin"}}}}}}},
      {"Families", NamedListOf("families", Object({{"name", text},
                                                   {"numbers", ListOf(any)},
                                                   {"texts", ListOf(any)},
                                                   {"has_curve", flag}}))},
      {"Revisions", Object({{"revisions", ListOf(revision)}, {"next_cursor", maybe_text}})},
      {"RevisionWithChanges",
       {{"allOf", {revision, Object({{"changes", ListOf(change)}, {"next_cursor", maybe_text}})}}}},
      {"History", Object({{"id", text}, {"history", ListOf(any)}, {"next_cursor", maybe_text}})},
      {"SeedUpdate", Object({{"added", ids},
                             {"replaced", ids},
                             {"removed", ids},
                             {"kept", ids},
                             {"revision", name_of_revision}})},
      {"Undone", {{"type", "object"}}},
      {"ModelRevision", Object({{"name", text},
                                {"version", integer},
                                {"at", text},
                                {"who", text},
                                {"hash", text},
                                {"model", any}})},
      {"Models", NamedListOf("models", Ref("schemas", "ModelRevision"))},
      {"ModelVersions",
       Object({{"name", text}, {"versions", ListOf(Ref("schemas", "ModelRevision"))}})}};
  return schemas;
}

Json Schemas() {
  Json schemas = {{"Requirements", api::DescribeRequirements()},
                  {"Measurement", api::DescribeMeasurement()},
                  {"Simulation", api::DescribeSimulation()},
                  {"Map", api::DescribeMap()},
                  {"Recording", api::DescribeRecording()},
                  {"Model", api::DescribeModel()},
                  {"Part", api::DescribePart()}};
  schemas.update(DiagnosisSchemas());
  schemas["Evaluation"] = Object({{"schema", {{"const", "evaluation/1"}}},
                                  {"requirements", Ref("schemas", "Requirements")},
                                  {"design", api::DescribeGivenDesign()}});
  schemas["Evaluation"]["properties"]["note"] = Json::object();
  schemas["Evaluation"]["properties"]["beside"] = api::DescribeGivenDesign();
  schemas["Evaluation"]["additionalProperties"] = false;
  schemas.update(SweepSchemas());
  schemas.update(DocumentSchemas());
  schemas["NamedModel"] = Object(
      {{"name", {{"type", "string"}, {"maxLength", 200}}}, {"model", Ref("schemas", "Model")}});
  schemas["NamedModel"]["additionalProperties"] = false;
  const Json integer = {{"type", "integer"}};
  schemas["Queue"] = Object({{"waiting", integer},
                             {"running", integer},
                             {"workers", integer},
                             {"threads", integer},
                             {"oldest", {{"type", {"string", "null"}}}}});
  schemas.update(AnswerSchemas());
  schemas.update(api::DescribeCatalogueAnswers());
  api::AddDesignAnswers(schemas);
  return schemas;
}

Json ExampleOf(const std::string& schema) {
  if (schema == "Requirements") return api::ExampleRequirements();
  if (schema == "Measurement") return api::ExampleMeasurement();
  if (schema == "SimulationOrCurves") return api::ExampleSimulation();
  if (schema == "Map") return api::ExampleMap();
  if (schema == "Recording") return api::ExampleRecording();
  if (schema == "Evaluation") return api::ExampleEvaluation();
  if (schema == "Sweep") return ExampleSweep();
  if (schema == "Part") return api::ExamplePart();
  return {{"name", "bench"}, {"model", api::ExampleModel()}};
}

Json RequestBody(const std::string& schema) {
  if (schema == "file") return DocumentBody();
  if (schema == "csv")
    return {{"required", true}, {"content", {{kCsv, {{"schema", Ref("schemas", "Csv")}}}}}};
  return {
      {"required", true},
      {"content", {{kJson, {{"schema", Ref("schemas", schema)}, {"example", ExampleOf(schema)}}}}}};
}

Json Render(const Route& route) {
  const Operation& operation = OperationOf(route.method, route.path);
  Json json = {{"summary", route.summary}, {"parameters", Json::array()}};
  if (route.path.find("{id}") != std::string::npos)
    json["parameters"].push_back(Ref("parameters", "id"));
  for (const std::string& name : operation.parameters)
    json["parameters"].push_back(Ref("parameters", name));
  if (route.method == "GET" && route.path == "/v1/parts")
    for (const Json& filter : api::DescribePartFilters()) json["parameters"].push_back(filter);
  if (!operation.body.empty()) json["requestBody"] = RequestBody(operation.body);
  Json& responses = json["responses"] = Json::object();
  for (const Operation::Answer& answer : operation.answers) {
    Json& response = responses[std::to_string(answer.status)];
    response["description"] = "answered";
    if (!answer.schema.empty())
      response["content"][answer.media]["schema"] = Ref("schemas", answer.schema);
  }
  for (const int status : operation.problems)
    responses[std::to_string(status)] = Ref("responses", "Problem");
  responses["default"] = Ref("responses", "Problem");
  if (route.access == Access::kOpen) json["security"] = Json::array();
  return json;
}

}  // namespace

Json OpenApi(const std::vector<Route>& routes) {
  Json paths = Json::object();
  for (const Route& route : routes) paths[route.path][LowerCase(route.method)] = Render(route);
  const Json problem = {
      {"description", "refused or failed; what, where and which limit stands in the document"},
      {"content", {{"application/problem+json", {{"schema", Ref("schemas", "Problem")}}}}}};
  return {{"openapi", "3.1.0"},
          {"info",
           {{"title", "plenum"},
            {"version", "1"},
            {"description",
             "Chooses the parts of a pneumatic supply for soft robots. The unit of every number "
             "is the end of its name. Limits are at /v1/limits. Beyond the statuses of an "
             "operation every one may answer 400, 401, 403, 408, 413, 414, 415, 429, 431, 500, "
             "501, 503, 505 or 507, always with a problem document."}}},
          {"security", Json::array({Json::object(), Json{{"token", Json::array()}}})},
          {"paths", std::move(paths)},
          {"components",
           {{"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}},
            {"parameters", Parameters()},
            {"responses", {{"Problem", problem}}},
            {"schemas", Schemas()}}}};
}

}  // namespace plenum::server
