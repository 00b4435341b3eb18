#include "api/catalogue/catalogue_parts.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "api/json/units.h"
#include "catalog/fields/price.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

double Required(const catalog::Part& row, const char* field) { return row.numbers.at(field).value; }

std::optional<double> Optional(const catalog::Part& row, const char* field) {
  const auto found = row.numbers.find(field);
  if (found == row.numbers.end()) return std::nullopt;
  return found->second.value;
}

double Pressure(const catalog::Part& row, const char* field, const model::Ambient& ambient) {
  return PaFromKpaGauge(Required(row, field), ambient);
}

// The mirror image of the deepest vacuum.
double DeepestImagePa(const model::Ambient& ambient) {
  return 2.0 * ambient.pressure_pa - model::kDeepestVacuumPa;
}

model::PartBasics Basics(const catalog::Part& row) {
  return {.id = row.id,
          .mass_kg = Required(row, "mass_kg"),
          .body_volume_m3 = M3FromMl(Required(row, "body_volume_ml")),
          .cost_eur = Optional(row, "price_eur"),
          .series = row.series,
          .pack = catalog::PackOf(row)};
}

model::Tubing Tubing(const catalog::Part& row, const model::Ambient& ambient) {
  const double outer_m = MFromMm(Required(row, "outer_diameter_mm"));
  return {.per_metre = {.id = row.id,
                        .mass_kg = Required(row, "mass_kg_per_m"),
                        .body_volume_m3 = std::numbers::pi / 4.0 * outer_m * outer_m,
                        .cost_eur = Optional(row, "price_eur_per_m"),
                        .series = row.series,
                        .pack = catalog::PackOf(row)},
          .outer_diameter_m = outer_m,
          .inner_diameter_m = MFromMm(Required(row, "inner_diameter_mm")),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient)};
}

model::Fitting Fitting(const catalog::Part& row, const model::Ambient& ambient) {
  return {.basics = Basics(row),
          .tube_outer_diameter_m = MFromMm(Required(row, "tube_outer_diameter_mm")),
          .thread = row.texts.at("thread").value,
          .flow = ElementOf(row, "sonic_conductance_dm3_per_s_bar", "critical_ratio"),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient)};
}

// Of a row that does not say it, by its class: medians of the seed's rows.
double ResponseTimeMs(const catalog::Part& row) {
  constexpr double kDirectMs = 10.0, kPilotMs = 19.0, kProportionalMs = 5.0;
  const bool piloted = Optional(row, "pressure_min_kpa_gauge").value_or(0.0) > 0.0;
  const bool proportional = row.texts.at("function").value == "proportional";
  return Optional(row, "response_time_ms")
      .value_or(piloted        ? kPilotMs
                : proportional ? kProportionalMs
                               : kDirectMs);
}

model::Valve Valve(const catalog::Part& row, const model::Ambient& ambient) {
  constexpr double kScatter = 1.0 / 3.0;  // of the response time, where nothing is known
  return {.basics = Basics(row),
          .kind = ValveKindFromFunction(row.texts.at("function").value),
          .channels = static_cast<int>(Required(row, "channels")),
          .port = row.texts.at("port").value,
          .fill = ElementOf(row, "sonic_conductance_fill_dm3_per_s_bar", "critical_ratio_fill"),
          .exhaust =
              ElementOf(row, "sonic_conductance_exhaust_dm3_per_s_bar", "critical_ratio_exhaust"),
          .coil_power_w = Required(row, "coil_power_w"),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient),
          .pressure_min_pa =
              PaFromKpaGauge(Optional(row, "pressure_min_kpa_gauge").value_or(0.0), ambient),
          .closing_scatter_s = kScatter * SFromMs(ResponseTimeMs(row))};
}

// Pumps take in volume, not mass: at ambient p_a, with s = p_a/100 kPa of the table's, the delivery
// is s·Q read at the same ratio of pressures, so that a point at gauge pressure g stands at s·g.
struct PumpTable {
  std::vector<double> pressure_pa, flow_m3_per_s, current_a;

  void Add(const catalog::CurvePoint& point, double gauge_kpa, const model::Ambient& ambient) {
    const double share = ambient.pressure_pa / model::kReferencePressurePa;
    pressure_pa.push_back(PaFromKpaGauge(share * gauge_kpa, ambient));
    flow_m3_per_s.push_back(share * M3PerSFromLPerMin(point.free_air_l_per_min));
    current_a.push_back(point.current_a);
  }
  model::CompressorCurve Curve(double voltage_v, double pressure_max_pa) const {
    return {.free_air_m3_per_s = {pressure_pa, flow_m3_per_s},
            .current_a = {pressure_pa, current_a},
            .voltage_v = voltage_v,
            .pressure_max_pa = pressure_max_pa};
  }
};

// Of a pump that lets air back while it is off: the check valve that it needs is not known here.
std::optional<double> CheckValveCracking(const catalog::Part& row) {
  const auto found = row.texts.find("check_valve");
  if (found == row.texts.end() || found->second.value != "no") return std::nullopt;
  return 0.0;
}

// Over mirrored pressures (model/physics/chamber.h), from ambient up.
std::optional<model::Compressor> VacuumPump(const catalog::Part& row,
                                            const model::Ambient& ambient) {
  if (!StandsVacuum(row)) return std::nullopt;
  PumpTable table;
  const auto& points = row.curve->points;
  for (auto point = points.rbegin(); point != points.rend(); ++point)
    table.Add(*point, -point->pressure_kpa_gauge, ambient);
  const double deepest_kpa =
      Optional(row, "vacuum_max_kpa_gauge").value_or(points.front().pressure_kpa_gauge);
  return model::Compressor{.basics = Basics(row),
                           .curve = table.Curve(Required(row, "voltage_v"),
                                                std::min(PaFromKpaGauge(-deepest_kpa, ambient),
                                                         DeepestImagePa(ambient))),
                           .duty_max = Optional(row, "duty_max").value_or(1.0),
                           .check_valve_cracking_pa = CheckValveCracking(row)};
}

// An ejector's suction falls in a straight line from its flow without vacuum to its deepest one.
model::Compressor Ejector(const catalog::Part& row, const model::Ambient& ambient) {
  const double deepest_kpa = Required(row, "vacuum_max_kpa_gauge");
  PumpTable table;
  table.Add({0.0, Required(row, "suction_flow_l_per_min_anr"), 0.0}, 0.0, ambient);
  table.Add({deepest_kpa, 0.0, 0.0}, -deepest_kpa, ambient);
  return {.basics = Basics(row),
          .curve = table.Curve(
              0.0, std::min(PaFromKpaGauge(-deepest_kpa, ambient), DeepestImagePa(ambient))),
          .air_consumption_m3_per_s =
              M3PerSFromLPerMin(Required(row, "air_consumption_l_per_min_anr"))};
}

model::Compressor Compressor(const catalog::Part& row, const model::Ambient& ambient) {
  PumpTable table;
  for (const catalog::CurvePoint& point : row.curve.value().points)
    table.Add(point, point.pressure_kpa_gauge, ambient);
  return {.basics = Basics(row),
          .curve = table.Curve(Required(row, "voltage_v"),
                               Pressure(row, "pressure_max_kpa_gauge", ambient)),
          .duty_max = Required(row, "duty_max"),
          .check_valve_cracking_pa = CheckValveCracking(row)};
}

model::Battery Battery(const catalog::Part& row) {
  return {.basics = Basics(row),
          .nominal_voltage_v = Required(row, "nominal_voltage_v"),
          .capacity_ah = Required(row, "capacity_ah"),
          .current_max_a = Required(row, "current_max_a")};
}

model::Cylinder Cylinder(const catalog::Part& row, const model::Ambient& ambient) {
  return {.basics = Basics(row),
          .water_volume_m3 = M3FromL(Required(row, "water_volume_l")),
          .fill_pressure_pa = Pressure(row, "fill_pressure_kpa_gauge", ambient)};
}

model::Co2Bottle Co2Bottle(const catalog::Part& row) {
  const double flow_m3_per_s = M3PerSFromLPerMin(Required(row, "flow_sustained_l_per_min_anr"));
  return {.basics = Basics(row),
          .co2_mass_kg = Required(row, "co2_mass_kg"),
          .water_volume_m3 = M3FromL(Optional(row, "water_volume_l").value_or(0.0)),
          .flow_sustained_m3_per_s = flow_m3_per_s,
          .flow_endless_m3_per_s = flow_m3_per_s};
}

model::Regulator Regulator(const catalog::Part& row, const model::Ambient& ambient) {
  const auto flow_max = Optional(row, "flow_max_l_per_min_anr");
  return {.basics = Basics(row),
          .flow = ElementOf(row, "sonic_conductance_dm3_per_s_bar", "critical_ratio"),
          .flow_max_m3_per_s =
              flow_max ? M3PerSFromLPerMin(*flow_max) : std::numeric_limits<double>::infinity(),
          .inlet_pressure_min_pa = Pressure(row, "inlet_pressure_min_kpa_gauge", ambient),
          .inlet_pressure_max_pa = Pressure(row, "inlet_pressure_max_kpa_gauge", ambient),
          .outlet_pressure_min_pa = Pressure(row, "outlet_pressure_min_kpa_gauge", ambient),
          .outlet_pressure_max_pa = Pressure(row, "outlet_pressure_max_kpa_gauge", ambient),
          .electrical_power_w = Required(row, "electrical_power_w")};
}

model::Reservoir Reservoir(const catalog::Part& row, const model::Ambient& ambient) {
  return {.basics = Basics(row),
          .volume_m3 = M3FromMl(Required(row, "internal_volume_ml")),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient)};
}

model::Manifold Manifold(const catalog::Part& row, const model::Ambient& ambient) {
  return {.basics = Basics(row),
          .stations = static_cast<int>(Required(row, "stations")),
          .sonic_conductance_m3_per_s_pa =
              ConductanceFromDm3PerSBar(Required(row, "sonic_conductance_dm3_per_s_bar")),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient),
          .orderable = row.orderable.value_or(true)};
}

model::CheckValve CheckValve(const catalog::Part& row, const model::Ambient& ambient) {
  return {.basics = Basics(row),
          .sonic_conductance_m3_per_s_pa =
              ConductanceFromDm3PerSBar(Required(row, "sonic_conductance_dm3_per_s_bar")),
          .cracking_pressure_pa = kPaPerKpa * Required(row, "cracking_pressure_kpa_gauge"),
          .pressure_max_pa = Pressure(row, "pressure_max_kpa_gauge", ambient)};
}

// Without one of these it is not known what it takes from a pump.
constexpr const char* kCheckValveNumbers[] = {
    "sonic_conductance_dm3_per_s_bar", "cracking_pressure_kpa_gauge", "pressure_max_kpa_gauge",
    "mass_kg", "body_volume_ml"};

bool Has(const catalog::Part& row, std::span<const char* const> numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](const char* field) { return row.numbers.contains(field); });
}

bool IsFlow(optimizer::Use use) {
  return use == optimizer::Use::kFlow || use == optimizer::Use::kSharedFlow;
}

// The name of b beside that of C: sonic_conductance_fill_dm3_per_s_bar, critical_ratio_fill.
std::string RatioName(std::string_view conductance) {
  constexpr std::string_view kBefore = "sonic_conductance", kAfter = "_dm3_per_s_bar";
  const std::string_view of = conductance.substr(kBefore.size());
  return "critical_ratio" + std::string(of.substr(0, of.size() - kAfter.size()));
}

// The row of a family's table that a number of the catalogue belongs to; null: none.
const optimizer::PartField* FieldOf(std::string_view family, std::string_view number) {
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    if (family != spec.name) continue;
    for (const optimizer::PartField& field : spec.fields)
      if (field.name == number || (IsFlow(field.use) && RatioName(field.name) == number))
        return &field;
  }
  return nullptr;
}

}  // namespace

model::FlowElement ElementOf(const catalog::Part& row, const char* conductance, const char* ratio) {
  return {.sonic_conductance_m3_per_s_pa = ConductanceFromDm3PerSBar(Required(row, conductance)),
          .critical_ratio = Required(row, ratio)};
}

model::ValveKind ValveKindFromFunction(std::string_view function) {
  if (function == "2/2 pair") return model::ValveKind::kPair;
  if (function == "2/2") return model::ValveKind::kVent;
  if (function == "proportional") return model::ValveKind::kProportional;
  return model::ValveKind::kThreeWay;
}

model::Parts ToModelParts(const std::vector<catalog::Part>& rows, const model::Ambient& ambient) {
  model::Parts parts;
  for (const catalog::Part& row : rows) {
    if (row.family == "tubing") parts.tubing.push_back(Tubing(row, ambient));
    if (row.family == "fitting") parts.fittings.push_back(Fitting(row, ambient));
    if (row.family == "valve") parts.valves.push_back(Valve(row, ambient));
    if (row.family == "compressor") parts.compressors.push_back(Compressor(row, ambient));
    if (row.family == "battery") parts.batteries.push_back(Battery(row));
    if (row.family == "cylinder") parts.cylinders.push_back(Cylinder(row, ambient));
    if (row.family == "co2") parts.co2.push_back(Co2Bottle(row));
    if (row.family == "regulator") parts.regulators.push_back(Regulator(row, ambient));
    if (row.family == "reservoir") parts.reservoirs.push_back(Reservoir(row, ambient));
    if (row.family == "reservoir") parts.tanks.push_back(Reservoir(row, ambient));
    if (IsJoint(row)) parts.manifolds.push_back(Manifold(row, ambient));
    if (row.family == "vacuum_pump")
      if (auto pump = VacuumPump(row, ambient)) parts.vacuum_pumps.push_back(*std::move(pump));
    if (row.family == "ejector" && StandsVacuum(row))
      parts.ejectors.push_back(Ejector(row, ambient));
    if (row.family == "check_valve" && Has(row, kCheckValveNumbers))
      parts.check_valves.push_back(CheckValve(row, ambient));
  }
  return parts;
}

bool IsJoint(const catalog::Part& row) {
  const auto known = [&](const char* field) { return row.numbers.contains(field); };
  return row.family == "manifold" && !row.texts.contains("takes") &&
         Required(row, "stations") >= 2 && known("mass_kg") && known("body_volume_ml") &&
         known("sonic_conductance_dm3_per_s_bar") && known("pressure_max_kpa_gauge");
}

// Without one of these it cannot be sized.
constexpr const char* kEjectorNumbers[] = {"suction_flow_l_per_min_anr",
                                           "vacuum_max_kpa_gauge",
                                           "air_consumption_l_per_min_anr",
                                           "supply_pressure_kpa_gauge",
                                           "mass_kg",
                                           "body_volume_ml"};

bool StandsVacuum(const catalog::Part& row) {
  const auto text_is = [&](const char* field, std::string_view value) {
    const auto found = row.texts.find(field);
    return found != row.texts.end() && found->second.value == value;
  };
  if (row.family == "tubing") return !text_is("material", "silicone");
  if (row.family == "reservoir") return !text_is("material", "PET");
  if (row.family == "vacuum_pump")
    return row.numbers.contains("mass_kg") && row.numbers.contains("body_volume_ml") &&
           row.curve.has_value();
  // Of several stages the suction lies far below a straight line (Piab COAX: 78 in place of 205
  // L/min at −40 kPa).
  if (row.family == "ejector")
    return Optional(row, "stages").value_or(1.0) == 1.0 && Has(row, kEjectorNumbers);
  if (row.family != "valve") return true;
  if (row.texts.contains("vacuum_rated")) return text_is("vacuum_rated", "yes");
  return !(Optional(row, "pressure_min_kpa_gauge").value_or(0.0) > 0.0);
}

model::Parts ToVacuumParts(const std::vector<catalog::Part>& rows, const model::Ambient& ambient) {
  std::vector<catalog::Part> standing;
  for (const catalog::Part& row : rows)
    if (StandsVacuum(row)) standing.push_back(row);
  model::Parts parts = ToModelParts(standing, ambient);
  parts.compressors.clear();
  parts.cylinders.clear();
  parts.co2.clear();
  parts.regulators.clear();
  parts.tanks.clear();
  const auto stand = [&](auto& of_family) {
    for (auto& part : of_family) part.pressure_max_pa = DeepestImagePa(ambient);
  };
  stand(parts.tubing);
  stand(parts.fittings);
  stand(parts.valves);
  stand(parts.reservoirs);
  stand(parts.manifolds);
  stand(parts.check_valves);
  for (model::Valve& valve : parts.valves) valve.pressure_min_pa = ambient.pressure_pa;
  return parts;
}

std::optional<std::string_view> UseInSearch(std::string_view family, std::string_view field) {
  using optimizer::Use;
  const auto families = optimizer::Families();
  if (std::none_of(families.begin(), families.end(),
                   [&](const optimizer::FamilySpec& spec) { return family == spec.name; }))
    return std::nullopt;
  for (const std::string_view amount :
       {"mass_kg", "body_volume_ml", "price_eur", "mass_kg_per_m", "price_eur_per_m"})
    if (field == amount) return "adds up";
  if (field == "free_air" || field == "current") return "a rule of the family";
  const optimizer::PartField* found = FieldOf(family, field);
  if (found == nullptr) return std::nullopt;
  switch (found->use) {
    case Use::kMore:
    case Use::kFlow:
      return "more is better";
    case Use::kSharedFlow:
      return "more is better, but takes air from other lines";
    case Use::kLess:
      return "less is better";
    case Use::kRating:
      return "more is better, up to what a source gives";
    case Use::kBoth:
      return "better for one requirement, worse for another";
    case Use::kMate:
      return "decides what fits";
    case Use::kRule:
      return "a rule of the family";
  }
  return std::nullopt;
}

bool IsFlowData(std::string_view family, std::string_view field) {
  if (field == "free_air" || (family == "tubing" && field == "inner_diameter_mm")) return true;
  const optimizer::PartField* found = FieldOf(family, field);
  return found != nullptr && IsFlow(found->use);
}

}  // namespace plenum::api
