#include "server/resources/schemas/diagnosis_schemas.h"

#include <utility>

#include "api/measure/stated_document.h"
#include "server/resources/schemas/schema_forms.h"

namespace plenum::server {
namespace {

using api::Json;

// Declared numbers that are named as wrong.
Json NumbersSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", {"number", "null"}}};
  return ListOf(Object({{"name", text},
                        {"declared", number},
                        {"fitted", number},
                        {"unit", text},
                        {"deviation_sigma", number},
                        {"instead_of", ListOf(text)}}));
}

// What changed readings say of the names.
Json StabilitySchema() {
  return ListOf(Object({{"change", {{"type", "string"}}},
                        {"delta_bic", {{"type", {"number", "null"}}}},
                        {"holds", {{"type", "boolean"}}}}));
}

// The numbers of one model of a diagnosis, with its error.
Json ModelSchema() {
  const Json number = {{"type", {"number", "null"}}};
  Json schema = Object({{"rms_kpa", number},
                        {"rms_percent", number},
                        {"peak_kpa", number},
                        {"holdout_rms_kpa", number},
                        {"runs", {{"type", "object"}}},
                        {"effects", ListOf({{"type", "object"}})},
                        {"factors", {{"type", "object"}}}});
  return schema;
}

Json DiagnosisSchema() {
  const Json text = {{"type", "string"}}, model = ModelSchema();
  Json learned = model;
  learned["type"] = {"object", "null"};
  Json schema = Versioned("diagnosis/1");
  schema["properties"].update(
      {{"verdict", {{"enum", {"adequate", "explained", "tie", "unexplained", "undecided"}}}},
       {"declared", model},
       {"before", model},
       {"after", model},
       {"learned", learned},
       {"runs", ListOf(Object({{"id", text},
                               {"held_out", {{"type", "boolean"}}},
                               {"relative_tolerance", {{"type", "number"}}},
                               {"left_out", ListOf({{"type", "integer"}})}}))},
       {"held_out_fitted", ListOf(Object({{"run", text}, {"numbers", ListOf(text)}}))},
       {"measurement", {{"type", "object"}}},
       {"numbers", NumbersSchema()},
       {"stability", StabilitySchema()},
       {"candidates",
        ListOf({{"type", "object"}, {"properties", {{"reason", {{"type", {"string", "null"}}}}}}})},
       {"next_experiment", {{"type", {"object", "null"}}}},
       {"reason",
        {{"type", {"string", "null"}}, {"description", "why a tie has no next experiment"}}}});
  return schema;
}

Json CurvesSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", {"number", "null"}}};
  Json schema = Versioned("curves/1");
  schema["properties"].update({{"model", text},
                               {"rms_kpa", number},
                               {"holdout_rms_kpa", number},
                               {"stated_rms_kpa", number},
                               {"runs", ListOf(Object({{"id", text},
                                                       {"held_out", {{"type", "boolean"}}},
                                                       {"status", {{"enum", {"done", "failed"}}}},
                                                       {"stated_rms_kpa", number}}))}});
  return schema;
}

Json CurvesRequestSchema() {
  const Json text = {{"type", "string"}, {"maxLength", 200}};
  Json schema = Object({{"schema", {{"const", "simulation/1"}}},
                        {"from",
                         {{"description", "the answer of a diagnosis, or the id of one"},
                          {"anyOf", {Ref("schemas", "Diagnosis"), {{"type", "string"}}}}}}});
  schema["properties"].update({{"name", text},
                               {"run", text},
                               {"model", {{"enum", api::kModelsOfADiagnosis}}},
                               {"measurement", Ref("schemas", "Measurement")},
                               {"note", Json::object()}});
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

Json DiagnosisSchemas() {
  const auto either = [](const char* a, const char* b) {
    return Json{{"anyOf", {Ref("schemas", a), Ref("schemas", b)}}};
  };
  return {{"Diagnosis", DiagnosisSchema()},
          {"Curves", CurvesSchema()},
          {"CurvesRequest", CurvesRequestSchema()},
          {"SimulationOrCurves", either("Simulation", "CurvesRequest")},
          {"ResponseOrCurves", either("Response", "Curves")}};
}

}  // namespace plenum::server
