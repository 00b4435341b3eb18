#include "server/resources/schemas/sweep_schemas.h"

#include "api/describe/descriptions.h"
#include "api/json/request_limits.h"
#include "server/resources/schemas/schema_forms.h"

namespace plenum::server {
namespace {

using api::Json;

Json MaybeForm(const char* type) { return {{"type", {type, "null"}}}; }

Json RowSchema() {
  Json row = {{"name", {{"type", "string"}}}, {"status", MaybeForm("string")}};
  row["values"] = ListOf(Json::object());
  for (const char* text : {"outcome", "configuration"}) row[text] = MaybeForm("string");
  for (const char* number : {"objective", "mass_kg", "volume_l", "cost_eur", "energy_wh"})
    row[number] = MaybeForm("number");
  row["parts"] = {{"type", {"array", "null"}}, {"items", {{"type", "string"}}}};
  for (const char* number : {"lower_bound", "gap", "seconds"}) row[number] = MaybeForm("number");
  for (const char* text : {"conflict", "detail", "link"}) row[text] = MaybeForm("string");
  return Object(row);
}

// sweep/1. With the patches the requirements are complete; alone they need not be.
Json RequestSchema() {
  const Json name = {{"type", "string"}, {"minLength", 1}, {"maxLength", api::kTextCharactersMax}};
  Json patch = Object(
      {{"name", name},
       {"merge",
        {{"type", "object"}, {"description", "JSON Merge Patch (RFC 7396) of the requirements"}}}});
  patch["properties"]["note"] = Json::object();
  patch["additionalProperties"] = false;
  Json sweep = Object(
      {{"schema", {{"const", "sweep/1"}}},
       {"requirements",
        {{"type", "object"}, {"description", "requirements/1, complete with each of the patches"}}},
       {"patches",
        {{"type", "array"},
         {"minItems", 1},
         {"maxItems", api::kSweepPatchesMax},
         {"items", patch}}}});
  sweep["properties"]["name"] = name;
  sweep["properties"]["note"] = Json::object();
  sweep["additionalProperties"] = false;
  return sweep;
}

}  // namespace

Json ExampleSweep() {
  return {{"schema", "sweep/1"},
          {"name", "how often"},
          {"requirements", api::ExampleRequirements()},
          {"patches",
           {{{"name", "slow"}, {"merge", {{"duty", {{"frequency_hz", 0.05}}}}}},
            {{"name", "fast"}, {"merge", {{"duty", {{"frequency_hz", 0.2}}}}}}}}};
}

Json SweepSchemas() {
  const Json text = {{"type", "string"}}, integer = {{"type", "integer"}};
  const Json status = {{"enum", {"queued", "running", "done", "cancelled", "failed"}}};
  const Json links = Object({{"self", text}, {"table", text}});
  const Json revision = Object({{"number", integer}, {"hash", text}});
  Json counts = Json::object();
  for (const Json& name : status.at("enum")) counts[name.get<std::string>()] = integer;
  const Json sweep = Object({{"id", text},
                             {"name", text},
                             {"status", status},
                             {"submitted_at", text},
                             {"ended_at", MaybeForm("string")},
                             {"catalogue_revision", revision},
                             {"jobs", Object(counts)},
                             {"links", links}});
  const Json job = Object({{"name", text},
                           {"id", MaybeForm("string")},
                           {"status", MaybeForm("string")},
                           {"link", MaybeForm("string")}});
  Json table = Versioned("sweep_table/1");
  table["properties"].update(Object({{"name", text},
                                     {"objective", MaybeForm("object")},
                                     {"varied", ListOf(text)},
                                     {"rows", ListOf(RowSchema())},
                                     {"catalogue_revision", revision}})
                                 .at("properties"));
  for (const char* name : {"name", "objective", "varied", "rows"})
    table["required"].push_back(name);
  return {{"Sweep", RequestSchema()},
          {"SweepAccepted", Object({{"id", text}, {"status", status}, {"links", links}})},
          {"Sweeps", NamedListOf("sweeps", sweep)},
          {"SweepWithJobs", {{"allOf", {sweep, NamedListOf("patches", job)}}}},
          {"SweepTable", table},
          {"SweepTableOrValid",
           {{"anyOf",
             {Ref("schemas", "SweepTable"),
              Object({{"valid", {{"const", true}}}, {"patches", integer}})}}}}};
}

}  // namespace plenum::server
