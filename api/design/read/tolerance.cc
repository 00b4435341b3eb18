#include "api/design/read/tolerance.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/selection.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/power.h"
#include "api/json/units.h"
#include "catalog/fields/fields.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

// FNV-1a.
std::uint64_t Hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

// The finaliser of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// What the made-to-measure reservoir of a design that says its volume is as a part.
catalog::Part MadeReservoirRow(const optimizer::Problem& problem, const optimizer::Design& design,
                               const optimizer::Choice& choice) {
  using catalog::Provenance;
  catalog::Part row;
  row.id = choice.id;
  row.family = "reservoir";
  row.numbers = {{"mass_kg", {choice.mass_kg, Provenance::kEstimated, ""}},
                 {"body_volume_ml", {MlFromM3(choice.volume_m3), Provenance::kEstimated, ""}},
                 {"internal_volume_ml",
                  {MlFromM3(*design.settings.reservoir_volume_m3), Provenance::kDatasheet, ""}},
                 {"pressure_max_kpa_gauge",
                  {KpaGaugeFromPa(optimizer::CustomRatingPa(problem), problem.ambient),
                   Provenance::kDatasheet, ""}}};
  return row;
}

}  // namespace

Tolerance ReadTolerance(Reader& request) {
  Tolerance tolerance;
  auto reader = request.OptionalObject("tolerance");
  if (!reader) return tolerance;
  const auto read = [&](const char* name, double& share) {
    share = reader->Number(name, Below(0, 1), share);
  };
  read("datasheet", tolerance.datasheet);
  read("third_party", tolerance.third_party);
  read("derived", tolerance.derived);
  read("estimated", tolerance.estimated);
  read("measured", tolerance.measured);
  reader->Finish();
  return tolerance;
}

Json RenderTolerance(const Tolerance& tolerance) {
  return {{"datasheet", tolerance.datasheet},
          {"third_party", tolerance.third_party},
          {"derived", tolerance.derived},
          {"estimated", tolerance.estimated},
          {"measured", tolerance.measured}};
}

bool IsExact(std::string_view field) {
  static const std::set<std::string_view> kExact{
      "outer_diameter_mm", "tube_outer_diameter_mm", "inner_diameter_mm", "channels",
      "stations",          "cells_series",           "voltage_v",         "nominal_voltage_v"};
  return kExact.contains(field);
}

double WithinRange(const catalog::Part& row, std::string_view field, double value) {
  if (const catalog::Family* family = catalog::FindFamily(row.family))
    for (const catalog::NumberField& known : family->numbers)
      if (known.name == field) return std::clamp(value, known.min, known.max);
  return value;
}

double Factor(std::uint64_t seed, int draw, const std::string& id, const std::string& field,
              double half_width) {
  const std::uint64_t number =
      Mix(Mix(Mix(Mix(seed) ^ static_cast<std::uint64_t>(draw)) ^ Hash(id)) ^ Hash(field));
  const double unit = static_cast<double>(number >> 11) * 0x1.0p-53;  // [0, 1)
  return 1.0 + half_width * (2.0 * unit - 1.0);
}

catalog::Part Perturbed(catalog::Part row, const Tolerance& tolerance, std::uint64_t seed,
                        int draw) {
  const auto factor = [&](const std::string& field, catalog::Provenance provenance,
                          const std::optional<double>& uncertainty) {
    return Factor(seed, draw, row.id, field, tolerance.Of(provenance, uncertainty));
  };
  for (auto& [field, number] : row.numbers)
    if (!IsExact(field))
      number.value = WithinRange(
          row, field, number.value * factor(field, number.provenance, number.uncertainty));
  if (row.curve) {
    catalog::Curve& curve = *row.curve;
    const double delivery =
        factor("free_air", curve.free_air_provenance, curve.free_air_uncertainty);
    const double current = factor("current", curve.current_provenance, curve.current_uncertainty);
    for (catalog::CurvePoint& point : curve.points) {
      point.free_air_l_per_min *= delivery;
      point.current_a *= current;
    }
  }
  return row;
}

optimizer::DrawParts MakeDraws(const std::vector<catalog::Part>& rows,
                               const optimizer::Problem& problem, PerturbRow perturb) {
  std::map<std::string, const catalog::Part*> by_id;
  for (const catalog::Part& row : rows) by_id[row.id] = &row;
  return [by_id = std::move(by_id), &problem, perturb = std::move(perturb)](
             const optimizer::Design& design, int draw) {
    std::vector<catalog::Part> drawn;
    std::set<std::string> seen;  // groups may share a part
    for (const optimizer::Choice& choice : design.parts) {
      if (!seen.insert(choice.id).second) continue;
      if (choice.id == kCustomReservoir && optimizer::SpecOf(choice.family).made_to_measure &&
          design.settings.reservoir_volume_m3) {
        drawn.push_back(perturb(MadeReservoirRow(problem, design, choice), draw));
      } else if (const auto row = by_id.find(choice.id); row != by_id.end()) {
        drawn.push_back(perturb(AsCounted(*row->second, problem), draw));
      }
    }
    model::Parts parts = ModelPartsFor(problem, drawn);
    if (HasOutsidePower(problem)) parts.batteries = problem.parts.batteries;
    if (HasWallVacuum(problem)) parts.regulators = problem.parts.regulators;
    return parts;
  };
}

optimizer::DrawParts MakeDraws(const std::vector<catalog::Part>& rows,
                               const optimizer::Problem& problem, const Tolerance& tolerance,
                               std::uint64_t seed) {
  return MakeDraws(rows, problem, [tolerance, seed](catalog::Part row, int draw) {
    return Perturbed(std::move(row), tolerance, seed, draw);
  });
}

}  // namespace plenum::api
