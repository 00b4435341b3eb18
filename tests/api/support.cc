#include "tests/api/support.h"

#include <map>
#include <stdexcept>

#include "api/json/request_limits.h"

namespace plenum::api {
namespace {

catalog::Part MakePart(const std::string& family, const std::map<std::string, double>& numbers,
                       const std::map<std::string, std::string>& texts) {
  catalog::Part part;
  part.id = family + "-1";
  part.family = family;
  part.manufacturer = "Acme";
  part.part_number = family + " 1";
  for (const auto& [name, value] : numbers)
    part.numbers[name] = {value, catalog::Provenance::kDatasheet, "sheet 1"};
  for (const auto& [name, value] : texts)
    part.texts[name] = {value, catalog::Provenance::kDatasheet, "sheet 1"};
  return part;
}

}  // namespace

std::string RequirementsText() {
  return R"({
    "schema": "requirements/1",
    "name": "exosuit",
    "actuators": [
      { "name": "spa_pack", "count": 6,
        "rest_volume_ml": 50.0, "expansion_ratio": 2.0, "operating_pressure_kpa_gauge": 100.0,
        "tube_length_m": 0.5, "fittings_per_line": 2,
        "rise_time_s_max": 0.5, "fall_time_s_max": 0.6, "pressure_kpa_gauge_max": 105.0 }
    ],
    "duty": { "frequency_hz": 0.1, "actuations": 1000, "simultaneous": true },
    "rise": { "to_fraction": 0.95 }, "fall": { "to_fraction": 0.05 },
    "supply": { "configurations": ["cylinder", "co2", "compressor", "mains"],
                "mains": { "pressure_kpa_gauge": 600.0, "flow_l_per_min_anr_max": 200.0 },
                "source_pressure_kpa_gauge_max": 600.0,
                "mass_kg_max": null, "volume_l_max": null, "cost_eur_max": null },
    "ambient": { "pressure_kpa_abs": 100.0, "temperature_k": 293.15 },
    "objective": { "minimize": "mass_kg" },
    "ranking": { "count": 20, "time_limit_s": 30.0 },
    "limits": { "compressors_max": 2, "batteries_max": 4, "cylinders_max": 4, "co2_max": 4,
                "reservoirs_max": 2 },
    "require": { "valve": ["valve-1"] }, "exclude": ["reservoir-1"],
    "model": "nominal"
  })";
}

std::string SimulationText() {
  return R"({
    "schema": "simulation/1",
    "actuators": [ { "name": "a", "count": 1, "rest_volume_ml": 50.0, "expansion_ratio": 2.0,
      "operating_pressure_kpa_gauge": 100.0,
      "line": { "elements": [
        { "sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35 },
        { "tube": { "inner_diameter_mm": 2.5, "length_m": 0.5 } },
        { "part": "tubing-1", "length_m": 0.5 } ] } } ],
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200.0 },
    "valve": [ { "t_s": 0.0, "state": "inflate" }, { "t_s": 1.07, "state": "hold" },
               { "t_s": 6.0, "state": "deflate" } ],
    "initial": { "pressure_kpa_gauge": 0.0 },
    "rise": { "to_fraction": 0.95 }, "fall": { "to_fraction": 0.05 },
    "ambient": { "pressure_kpa_abs": 100.0, "temperature_k": 293.15 },
    "t_end_s": 8.0, "sample_hz": 200
  })";
}

std::string MapText() {
  return R"({ "schema": "map/1", "source_pressure_ratio": [1.5, 2, 3],
    "operating_pressure_ratio": [2.0], "expansion_ratio": [1, 2], "critical_ratio": [0.3],
    "rise": { "to_fraction": 0.95 }, "fall": { "to_fraction": 0.05 } })";
}

Json Parse(std::string_view text) {
  Parsed<Json> parsed = ParseJson(text, kResultBytesMax);  // as answers are read from files
  if (const Errors* errors = std::get_if<Errors>(&parsed))
    throw std::runtime_error("test document: " + errors->front().detail);
  return std::get<Json>(std::move(parsed));
}

std::vector<catalog::Part> SmallCatalogue() {
  std::vector<catalog::Part> parts{
      MakePart("tubing",
               {{"outer_diameter_mm", 4},
                {"inner_diameter_mm", 2.5},
                {"mass_kg_per_m", 0.009},
                {"price_eur_per_m", 0.8},
                {"pressure_max_kpa_gauge", 800}},
               {{"material", "polyurethane"}}),
      MakePart("fitting",
               {{"tube_outer_diameter_mm", 4},
                {"sonic_conductance_dm3_per_s_bar", 0.9},
                {"critical_ratio", 0.5},
                {"mass_kg", 0.005},
                {"body_volume_ml", 2},
                {"pressure_max_kpa_gauge", 1000}},
               {{"thread", "M5"}}),
      MakePart("valve",
               {{"channels", 2},
                {"sonic_conductance_fill_dm3_per_s_bar", 0.3},
                {"critical_ratio_fill", 0.35},
                {"sonic_conductance_exhaust_dm3_per_s_bar", 0.25},
                {"critical_ratio_exhaust", 0.3},
                {"coil_power_w", 1.5},
                {"response_time_ms", 5},
                {"mass_kg", 0.02},
                {"body_volume_ml", 8},
                {"price_eur", 30},
                {"pressure_max_kpa_gauge", 700}},
               {{"function", "2/2 pair"}, {"port", "M5"}}),
      MakePart("compressor",
               {{"voltage_v", 12},
                {"duty_max", 0.5},
                {"mass_kg", 1.1},
                {"body_volume_ml", 900},
                {"pressure_max_kpa_gauge", 700}},
               {{"type", "piston"}}),
      MakePart("cylinder",
               {{"water_volume_l", 1.1},
                {"fill_pressure_kpa_gauge", 20000},
                {"mass_kg", 1.3},
                {"body_volume_ml", 1500}},
               {}),
      MakePart("co2",
               {{"co2_mass_kg", 0.5},
                {"water_volume_l", 0.75},
                {"flow_sustained_l_per_min_anr", 6},
                {"mass_kg", 0.6},
                {"body_volume_ml", 1000}},
               {}),
      MakePart("battery",
               {{"cells_series", 3},
                {"nominal_voltage_v", 11.1},
                {"capacity_ah", 5},
                {"current_max_a", 50},
                {"mass_kg", 0.4},
                {"body_volume_ml", 250}},
               {}),
      MakePart("regulator",
               {{"sonic_conductance_dm3_per_s_bar", 0.7},
                {"critical_ratio", 0.4},
                {"inlet_pressure_min_kpa_gauge", 700},
                {"inlet_pressure_max_kpa_gauge", 30000},
                {"outlet_pressure_min_kpa_gauge", 20},
                {"outlet_pressure_max_kpa_gauge", 850},
                {"electrical_power_w", 0},
                {"mass_kg", 0.3},
                {"body_volume_ml", 200}},
               {}),
      MakePart("reservoir",
               {{"internal_volume_ml", 500},
                {"mass_kg", 0.35},
                {"body_volume_ml", 650},
                {"pressure_max_kpa_gauge", 1000}},
               {}),
  };
  catalog::Curve curve;
  curve.points = {{0, 24.9, 7}, {69, 14.2, 8}, {689, 6.5, 11}};
  curve.free_air_provenance = catalog::Provenance::kDatasheet;
  curve.free_air_source = curve.current_source = "sheet 1";
  curve.current_provenance = catalog::Provenance::kDerived;
  parts[3].curve = curve;
  return parts;
}

std::vector<catalog::Part> SmallCatalogueWithVacuum() {
  std::vector<catalog::Part> parts = SmallCatalogue();
  catalog::Part pump = MakePart(
      "vacuum_pump",
      {{"voltage_v", 12}, {"vacuum_max_kpa_gauge", -80}, {"mass_kg", 0.3}, {"body_volume_ml", 290}},
      {{"type", "diaphragm"}});
  catalog::Curve curve;
  curve.points = {{-80, 0, 1.3}, {-40, 6.7, 1.3}, {0, 15, 0.6}};
  curve.free_air_provenance = catalog::Provenance::kDatasheet;
  curve.free_air_source = curve.current_source = "sheet 2";
  curve.current_provenance = catalog::Provenance::kDerived;
  pump.curve = curve;
  parts.push_back(pump);
  return parts;
}

catalog::Part PartOf(std::string_view family) {
  for (catalog::Part& part : SmallCatalogue())
    if (part.family == family) return part;
  throw std::runtime_error("no such family: " + std::string(family));
}

std::string DetailAt(const Errors& errors, std::string_view pointer) {
  std::string details;
  for (const Error& error : errors)
    if (error.pointer == pointer) details += (details.empty() ? "" : "\n") + error.detail;
  return details;
}

Json With(Json document, const std::string& pointer, Json value) {
  document[Json::json_pointer(pointer)] = std::move(value);
  return document;
}

Json Without(Json document, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  document[place.parent_pointer()].erase(place.back());
  return document;
}

}  // namespace plenum::api
