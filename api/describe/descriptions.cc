#include "api/describe/descriptions.h"

#include <utility>
#include <vector>

#include "api/describe/part_forms.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/shared_fields.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/measurement.h"
#include "api/measure/model_document.h"
#include "api/protocol/part_revision.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "catalog/fields/fields.h"

namespace plenum::api {
namespace {

Json Document(const char* text) { return std::get<Json>(ParseJson(text)); }

// What `read` asks of `documents`, which together lead it into each of its branches.
template <typename Read>
Json Heard(const std::vector<Json>& documents, Read&& read) {
  SchemaRecorder recorder;
  for (const Json& document : documents) read(document);
  return recorder.Schema();
}

// Every option of requirements beyond those of the example.
Json AllRequirements() {
  return Document(R"({
    "schema": "requirements/1", "name": "all",
    "actuators": [
      { "name": "a", "count": 1, "rest_volume_ml": 50, "operating_pressure_kpa_gauge": 100,
        "pressure_volume": [ { "pressure_kpa_gauge": 0, "volume_ml": 50 },
                             { "pressure_kpa_gauge": 120, "volume_ml": 90 } ],
        "tube_length_m": 0.5, "fittings_per_line": 2, "rise_time_s_max": 1, "fall_time_s_max": 1,
        "pressure_kpa_gauge_max": 105,
        "phase": 0.5, "inflate_fraction": 0.4, "strokes_per_period": 2,
        "relative_uncertainty": { "rest_volume": 0.02, "expansion_ratio": 0.02 } },
      { "cylinder": { "bore_mm": 10, "stroke_mm": 50, "rod_mm": 4, "acting": "single",
                      "dead_volume_ml": 1 }, "count": 2, "phase": [0, 0.5] },
      { "muscle": { "length_mm": 100, "diameter_mm": 10, "braid_angle_deg": 25,
                    "contraction": 0.2 } },
      { "pouch": { "width_mm": 30, "length_mm": 60, "cells": 2 } },
      { "body": { "diameter_mm": 50, "length_m": 1 } } ],
    "duty": { "frequency_hz": 0.1, "actuations": 10, "simultaneous": true },
    "rise": { "to_fraction": 0.95 }, "fall": { "to_fraction": 0.05 },
    "supply": { "configurations": ["mains", "tank", "direct_pump"], "pumps": "shared",
                "hold_on": false, "regulation": "shared",
                "mains": { "pressure_kpa_gauge": 600, "flow_l_per_min_anr_max": 200 },
                "source_pressure_kpa_gauge_max": 600, "tank_fill_kpa_gauge_max": 800,
                "mass_kg_max": 10, "volume_l_max": 10,
                "cost_eur_max": 1000, "parts": "any",
                "power": { "kind": "robot", "voltage_v": 24, "energy_wh_max": 50,
                           "current_a_max": 5 } },
    "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 },
    "objective": { "minimize": { "mass_kg": 1 }, "pareto": ["mass_kg", "volume_l"] },
    "ranking": { "count": 1, "time_limit_s": 1, "probability_min": 0, "proof": false,
                 "solver": "ipopt", "list": "combinations", "per_source": 3 },
    "prices": "known",
    "robust": { "draws": 1, "time_limit_s": 1, "seed": 0,
                "tolerance": { "datasheet": 0, "third_party": 0, "derived": 0, "estimated": 0,
                               "measured": 0 } },
    "guarantee": { "retune": false,
                   "tolerance": { "datasheet": 0, "third_party": 0, "derived": 0, "estimated": 0,
                                  "measured": 0 } },
    "explain": { "prices": false, "ranks": 0, "time_limit_s": 1 },
    "limits": { "compressors_max": 1, "batteries_max": 1, "cylinders_max": 1, "co2_max": 1,
                "reservoirs_max": 1 },
    "require": { "tubing": ["x"], "fitting": ["x"], "valve": ["x"], "compressor": ["x"],
                 "battery": ["x"], "cylinder": ["x"], "co2": ["x"], "regulator": ["x"],
                 "reservoir": ["x"] },
    "exclude": ["x"], "own": ["x"], "model": "nominal" })");
}

// What evacuated actuators say.
Json EvacuatedRequirements() {
  return Document(R"({
    "schema": "requirements/1",
    "actuators": [ { "rest_volume_ml": 200, "expansion_ratio": 0.8,
                     "operating_pressure_kpa_gauge": -60, "pressure_kpa_gauge_min": -65,
                     "tube_length_m": 1 } ],
    "duty": { "frequency_hz": 0.1, "actuations": 10 },
    "supply": { "mains": { "pressure_kpa_gauge": 600, "flow_l_per_min_anr_max": 100 },
                "vacuum": { "configurations": ["pump", "ejector", "mains"],
                            "vacuum_kpa_gauge_min": -80,
                            "mains": { "pressure_kpa_gauge": -85 } } },
    "require": { "vacuum_pump": ["x"], "ejector": ["x"], "manifold": ["x"], "check_valve": ["x"] } })");
}

// The ways to write a line, a source and a schedule that the example does not use. It runs
// nothing: "t_end_s" is missing.
std::vector<Json> AllSimulations() {
  return {Document(R"({
    "schema": "simulation/1", "gas": "air", "blocked": false,
    "actuators": [
      { "count": 1, "blocked": false, "close_at_operating_pressure": false, "effects": [],
        "operating_pressure_kpa_gauge": 100, "low_pressure_kpa_gauge": 0,
        "exhaust_pressure_kpa_gauge": 0, "close_at_low_pressure": false,
        "pressure_volume": [ {}, {} ], "cylinder": {}, "muscle": {}, "pouch": {}, "body": {},
        "valve": [ { "t_s": 0, "state": "hold" } ],
        "line": { "elements": [ { "part": "x", "length_m": 1 },
                                { "tube": { "inner_diameter_mm": 2.5, "length_m": 0.5 } },
                                { "sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.3,
                                  "exhaust": {} } ] } } ],
    "initial": {}, "ambient": { "pressure_kpa_abs": 200 },
    "source": { "kind": "compressor", "curve": [ {} ], "reservoir_volume_ml": 500 } })"),
          Document(R"({
    "schema": "simulation/1", "effects": [],
    "actuators": [ { "line": { "sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35,
                               "exhaust": {}, "tube": {} }, "cycle": {} } ],
    "cycle": { "frequency_hz": 1, "inflate_fraction": 0.5, "cycles": 1 }, "rise": {}, "fall": {},
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200, "regulator": {} } })")};
}

std::vector<Json> AllMeasurements() {
  return {Document(R"({
    "schema": "measurement/1", "relative_uncertainty": {}, "holdout": [], "assume": [], "understood": [],
    "rig": { "ambient": { "pressure_kpa_abs": 200 },
             "actuator": { "measure": [], "pressure_volume": [ {}, {} ], "cylinder": {}, "muscle": {}, "pouch": {},
                           "body": {} },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3,
                       "exhaust": {}, "tube": {} },
             "supply": { "kind": "compressor", "measure": [], "curve": [ {} ] },
             "sensor": {} },
    "runs": [ { "initial": {}, "channels": { "source_pressure_kpa_gauge": [],
                "inlet_pressure_kpa_gauge": [], "temperature_k": [], "volume_ml": [],
                "flow_l_per_min_anr": [], "valve_opening": [], "source_setpoint_kpa_gauge": [] },
                "valve": [ { "uncertainty_s": 0 } ], "cycle": {} } ] })"),
          Document(R"({
    "schema": "measurement/1",
    "rig": { "actuator": {}, "line": { "elements": [ { "measure": [], "exhaust": {} },
                                                         { "tube": {} } ] },
             "supply": { "kind": "regulated" } },
    "runs": [ { "cycle": {} } ] })"),
          Document(R"({
    "schema": "measurement/1",
    "rig": { "actuator": {}, "line": { "elements": [ { "exhaust": {} } ] },
             "supply": { "kind": "flow" } },
    "runs": [ { "cycle": {} } ] })"),
          Document(R"({
    "schema": "measurement/1",
    "rig": { "arrangement": "side_by_side", "pressure_of": "a",
             "chambers": [ { "name": "a", "part": "x", "from": "b", "pressure_volume": [ {}, {} ], "cylinder": {},
                             "muscle": {}, "pouch": {}, "body": {}, "line": { "exhaust": {}, "tube": {} } },
                           { "line": { "elements": [ { "exhaust": {} }, { "tube": {} } ] } } ],
             "supply": { "kind": "regulated" } },
    "runs": [ { "channels": {} } ] })")};
}

// The same without "required": of a rig each run may give a part.
Json InParts(Json schema) {
  if (schema.is_object() && schema.contains("properties")) schema.erase("required");
  for (auto& [name, inner] : schema.items())
    if (inner.is_structured() && name != "items") inner = InParts(std::move(inner));
  return schema;
}

}  // namespace

Json DescribeRequirements() {
  return Heard({ExampleRequirements(), AllRequirements(), EvacuatedRequirements(),
                Document(R"({ "guarantee": true })")},
               [](const Json& document) { ParseRequirements(document, {}); });
}

Json DescribeMeasurement() {
  std::vector<Json> documents = AllMeasurements();
  documents.push_back(ExampleMeasurement());
  Json schema = Heard(documents, [](const Json& document) { ParseMeasurement(document); });
  Json& properties = schema["properties"];
  properties["rig"]["properties"]["line"]["properties"]["elements"]["items"]["properties"]
            ["length_m"] = NumberForm(TubeLengthRange());  // of tubing of the catalogue
  properties["rig"] = InParts(properties["rig"]);
  properties["runs"]["items"]["properties"]["rig"] = properties["rig"];
  properties["model"] = {{"type", {"string", "null"}},
                         {"maxLength", kTextCharactersMax},
                         {"description", "a saved model that predicts the runs"}};
  properties["save"] = {{"type", {"string", "null"}},
                        {"maxLength", kTextCharactersMax},
                        {"description", "the name to save the model under"}};
  properties["save_part"] = {
      {"type", {"string", "null"}},
      {"maxLength", kTextCharactersMax},
      {"description", "the part that the measured numbers are written into"}};
  properties["save_part_anyway"] = {
      {"type", {"boolean", "null"}},
      {"description", "also where they contradict what stands there"}};
  properties["save_part_specimen"] = {
      {"type", {"string", "null"}},
      {"maxLength", kSpecimenNameMax},
      {"description", "the piece of the part's type that was measured"}};
  properties["time_limit_s"] = NumberOrQuantityForm("time_limit_s", {0.01, kDiagnosisTimeMaxS});
  return schema;
}

Json DescribeSimulation() {
  std::vector<Json> documents = AllSimulations();
  documents.push_back(ExampleSimulation());
  return Heard(documents, [](const Json& document) { RunSimulation(document, {}); });
}

Json DescribeMap() {
  Json compressor = ExampleMap();
  compressor["compressor_flow_normalised"] = {0.1};
  compressor["reservoir_volume_normalised"] = {100};
  compressor["actuator_count"] = {1};
  return Heard({ExampleMap(), compressor}, [](const Json& document) { RunMap(document); });
}

Json DescribeModel() {
  return Heard({ExampleModel()}, [](const Json& document) { ParseModel(document); });
}

Json DescribeGivenDesign() {
  return Heard({ExampleEvaluation().at("design")}, [](const Json& document) {
    Errors errors;
    ReadGivenDesign(Reader(document, "", errors), {});
  });
}

Json DescribePart() {
  Json forms = Json::array();
  for (const catalog::Family& family : catalog::Families()) forms.push_back(PartForm(family));
  return {{"oneOf", std::move(forms)}};
}

Json ExampleRequirements() {
  return Document(R"({
    "schema": "requirements/1", "name": "gripper",
    "actuators": [ { "name": "finger", "count": 3, "rest_volume_ml": 20.0, "expansion_ratio": 1.5,
                     "operating_pressure_kpa_gauge": 80.0, "tube_length_m": 0.4,
                     "fittings_per_line": 2, "rise_time_s_max": 0.5, "fall_time_s_max": 0.6 } ],
    "duty": { "frequency_hz": 0.1, "actuations": 100 },
    "objective": { "minimize": "mass_kg" },
    "ranking": { "count": 1, "time_limit_s": 5.0 } })");
}

Json ExampleMeasurement() {
  return Document(R"({
    "schema": "measurement/1", "name": "bench",
    "rig": { "actuator": { "rest_volume_ml": 50.0, "expansion_ratio": 1.0,
                           "operating_pressure_kpa_gauge": 100.0 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
             "supply": { "kind": "regulated" } },
    "relative_uncertainty": { "sonic_conductance": 0.03 },
    "runs": [ { "id": "r1", "blocked": true, "source_pressure_kpa_gauge": 200.0,
                "initial": { "pressure_kpa_gauge": 0.0 },
                "valve": [ { "t_s": 0.0, "state": "inflate" } ],
                "t_s": [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
                "pressure_kpa_gauge": [0.1, 29.6, 58.9, 86.2, 112.1, 134.8, 155.2, 171.9, 185.1, 194.0] } ] })");
}

Json ExampleSimulation() {
  return Document(R"({
    "schema": "simulation/1", "name": "one stroke",
    "actuators": [ { "name": "a", "rest_volume_ml": 50.0, "expansion_ratio": 2.0,
                     "operating_pressure_kpa_gauge": 100.0,
                     "line": { "sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35 } } ],
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200.0 },
    "valve": [ { "t_s": 0.0, "state": "inflate" } ],
    "initial": { "pressure_kpa_gauge": 0.0 }, "t_end_s": 0.5, "sample_hz": 20 })");
}

Json ExampleMap() {
  return Document(R"({ "schema": "map/1", "name": "coarse", "source_pressure_ratio": [2.5, 3],
    "operating_pressure_ratio": 2.0, "expansion_ratio": [1, 2], "critical_ratio": 0.3,
    "rise": { "to_fraction": 0.95 }, "fall": { "to_fraction": 0.05 } })");
}

Json ExampleEvaluation() {
  Json evaluation = Document(R"({
    "schema": "evaluation/1",
    "design": {
      "configuration": "compressor",
      "parts": [
        { "family": "valve", "id": "smc-vq110u-5m-m5", "quantity": 3, "group": "finger" },
        { "family": "fitting", "id": "generic-push-in-2mm-m5", "quantity": 6, "group": "finger" },
        { "family": "tubing", "id": "generic-polyurethane-2x1.2", "quantity": 1.2,
          "group": "finger" },
        { "family": "compressor", "id": "generic-diaphragm-12v-2lpm-150kpa", "quantity": 1 },
        { "family": "battery", "id": "generic-lipo-3s-450mah", "quantity": 1 },
        { "family": "reservoir", "id": "generic-pet-1500ml", "quantity": 1 } ],
      "settings": { "source_pressure_kpa_gauge": 83, "reservoir_volume_ml": 1500 } } })");
  evaluation["requirements"] = ExampleRequirements();
  return evaluation;
}

Json ExampleModel() {
  return Document(R"({ "schema": "model/1",
    "effects": [ { "id": "creep", "parameters": { "fraction": 0.15, "time_constant_s": 2.0 } } ],
    "factors": {}, "covariance": { "parameters": [], "matrix": [] },
    "data": [ { "name": "bench.json", "sha256": "e3b0c442" } ], "noise_kpa": 0.2 })");
}

Json ExamplePart() {
  return Document(R"({ "id": "my-pack", "family": "battery", "manufacturer": "me",
    "part_number": "3S 4 Ah", "cells_series": 3, "nominal_voltage_v": 11.1, "capacity_ah": 4.0,
    "current_max_a": 40, "mass_kg": 0.25, "body_volume_ml": 130 })");
}

}  // namespace plenum::api
