#include "server/resources/schemas/diagnosis_schemas.h"

#include "api/measure/stated_document.h"
#include "server/resources/schemas/schema_forms.h"

namespace plenum::server {
namespace {

using api::Json;

// Declared numbers that are named as wrong.
Json NumbersSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", {"number", "null"}}};
  Json schema = Object({{"name", text},
                        {"declared", number},
                        {"fitted", number},
                        {"unit", text},
                        {"deviation_sigma", number},
                        {"instead_of", ListOf(text)}});
  schema["properties"]["specimen"] = {{"type", {"string", "null"}}};  // where one has it for itself
  schema["properties"]["chamber"] = {{"type", "string"}};             // the same of several
  return ListOf(schema);
}

// Pieces of the actuator, where runs name them.
Json SpecimensSchema() {
  const Json text = {{"type", "string"}}, name = {{"type", {"string", "null"}}};
  return ListOf(Object(
      {{"name", name}, {"runs", ListOf(text)}, {"fitted", {{"type", "object"}}}, {"words", text}}));
}

// What changed readings say of the names.
Json StabilitySchema() {
  return ListOf(Object({{"change", {{"type", "string"}}},
                        {"delta_bic", {{"type", {"number", "null"}}}},
                        {"holds", {{"type", "boolean"}}}}));
}

// Numbers of parts that the runs measure, and what was written into the catalogue.
Json MeasuredSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", {"number", "null"}}};
  return ListOf(Object({{"part", text},
                        {"number", text},
                        {"field", text},
                        {"declared", number},
                        {"fitted", number},
                        {"unit", text},
                        {"uncertainty", number},
                        {"interval_95", ListOf(number)},
                        {"refused", {{"type", {"string", "null"}}}}}));
}
// What runs with other bottles say of the same numbers.
Json BottlesSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", {"number", "null"}}};
  return ListOf(Object({{"specimen", {{"type", {"string", "null"}}}},
                        {"runs", ListOf(text)},
                        {"rest_volume_ml", number},
                        {"verdict", text},
                        {"numbers", ListOf(Object({{"number", text},
                                                   {"pressure_kpa_gauge", number},
                                                   {"fitted", number},
                                                   {"uncertainty", number},
                                                   {"agrees", {{"type", "boolean"}}}}))}}));
}
Json SavedPartSchema() {
  const Json text = {{"type", "string"}};
  return Object({{"part", text},
                 {"specimen", {{"type", {"string", "null"}}}},
                 {"numbers", ListOf({{"type", "object"}})},
                 {"refused", ListOf(text)},
                 {"revision", {{"type", {"object", "null"}}}}});
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
  schema["properties"]["chamber_factors"] = {{"type", "object"}};  // of several chambers
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
       {"saved_part", Ref("schemas", "SavedPart")},
       {"numbers", NumbersSchema()},
       {"specimens", SpecimensSchema()},
       {"specimen_spread", {{"type", "object"}}},
       {"chambers", SpecimensSchema()},
       {"stability", StabilitySchema()},
       {"slips", ListOf(Object({{"what", text}, {"assume", text}}))},
       {"predicts_better",
        {{"type", {"boolean", "null"}},
         {"description", "whether `after` predicts runs that no fit saw better than `before`"}}},
       {"measured", MeasuredSchema()},
       {"measured_refused", ListOf(text)},
       {"bottles", BottlesSchema()},
       {"candidates",
        ListOf({{"type", "object"}, {"properties", {{"reason", {{"type", {"string", "null"}}}}}}})},
       {"tied_sets", ListOf(Object({{"effects", ListOf({{"type", "object"}})},
                                    {"numbers", ListOf({{"type", "object"}})}}))},
       {"next_experiment", {{"type", {"object", "null"}}}},
       {"reason",
        {{"type", {"string", "null"}}, {"description", "why a tie has no next experiment"}}}});
  return schema;
}

Json ProtocolSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", "number"}};
  const Json maybe_object = {{"type", {"object", "null"}}};
  const Json precision = Object({{"field", text},
                                 {"uncertainty", number},
                                 {"from_noise", number},
                                 {"from_rig", number},
                                 {"told", {{"type", "boolean"}}},
                                 {"how", text}});
  Json schema = Versioned("protocol/1");
  schema["properties"].update({{"part", text},
                               {"family", text},
                               {"sensor", {{"type", "object"}}},
                               {"tests", ListOf(Object({{"protocol", text},
                                                        {"numbers", ListOf(text)},
                                                        {"steps", ListOf(text)},
                                                        {"equipment", maybe_object},
                                                        {"recording", maybe_object},
                                                        {"precision", ListOf(precision)},
                                                        {"warnings", ListOf(text)}}))}});
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
          {"SavedPart", SavedPartSchema()},
          {"Protocol", ProtocolSchema()},
          {"Curves", CurvesSchema()},
          {"CurvesRequest", CurvesRequestSchema()},
          {"SimulationOrCurves", either("Simulation", "CurvesRequest")},
          {"ResponseOrCurves", either("Response", "Curves")}};
}

}  // namespace plenum::server
