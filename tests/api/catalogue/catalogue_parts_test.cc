#include "api/catalogue/catalogue_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "api/json/units.h"
#include "catalog/fields/fields.h"
#include "model/physics/storage.h"
#include "optimizer/problem/family_specs.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace catalogue_parts_test {

TEST(Units, AgreeWithNumbersWorkedOutByHand) {
  const model::Ambient ambient{.pressure_pa = 95e3, .temperature_k = 300.0};
  EXPECT_DOUBLE_EQ(PaFromKpaGauge(100.0, ambient), 195e3);
  EXPECT_DOUBLE_EQ(KpaGaugeFromPa(195e3, ambient), 100.0);
  EXPECT_DOUBLE_EQ(PaFromKpaAbs(101.3), 101300.0);
  EXPECT_DOUBLE_EQ(M3FromMl(50.0), 5e-5);
  EXPECT_DOUBLE_EQ(MlFromM3(7.3e-4), 730.0);
  EXPECT_DOUBLE_EQ(LFromM3(0.897), 897.0);
  EXPECT_DOUBLE_EQ(MFromMm(2.5), 0.0025);
  EXPECT_DOUBLE_EQ(M3PerSFromLPerMin(60.0), 1e-3);
  EXPECT_DOUBLE_EQ(LPerMinFromM3PerS(0.02), 1200.0);
  EXPECT_DOUBLE_EQ(ConductanceFromDm3PerSBar(0.05), 5e-10);
  EXPECT_DOUBLE_EQ(WhFromJ(219600.0), 61.0);
  // C = 2 dm³/(s·bar) choked at 5 bar absolute passes 600 L/min (SMC's rule 600·C·p[MPa]).
  EXPECT_NEAR(LPerMinFromM3PerS(ConductanceFromDm3PerSBar(2.0) * 5e5), 600.0, 1e-9);
}

TEST(ToModelParts, ConvertsEveryFamilyToSiAndAbsolute) {
  const model::Ambient ambient{.pressure_pa = 90e3, .temperature_k = 293.15};
  const model::Parts parts = ToModelParts(SmallCatalogue(), ambient);

  ASSERT_EQ(parts.tubing.size(), 1u);
  EXPECT_EQ(parts.tubing[0].per_metre.id, "tubing-1");
  EXPECT_DOUBLE_EQ(parts.tubing[0].per_metre.mass_kg, 0.009);
  EXPECT_NEAR(parts.tubing[0].per_metre.body_volume_m3, 1.2566370614e-5, 1e-14);  // π/4·(4 mm)²·1 m
  EXPECT_EQ(parts.tubing[0].per_metre.cost_eur, 0.8);
  EXPECT_DOUBLE_EQ(parts.tubing[0].inner_diameter_m, 0.0025);
  EXPECT_DOUBLE_EQ(parts.tubing[0].pressure_max_pa, 890e3);

  ASSERT_EQ(parts.fittings.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.fittings[0].flow.sonic_conductance_m3_per_s_pa, 0.9e-8);
  EXPECT_DOUBLE_EQ(parts.fittings[0].flow.critical_ratio, 0.5);
  EXPECT_EQ(parts.fittings[0].thread, "M5");
  EXPECT_EQ(parts.fittings[0].basics.cost_eur, std::nullopt);

  ASSERT_EQ(parts.valves.size(), 1u);
  EXPECT_EQ(parts.valves[0].kind, model::ValveKind::kPair);
  EXPECT_EQ(parts.valves[0].channels, 2);
  EXPECT_DOUBLE_EQ(parts.valves[0].fill.sonic_conductance_m3_per_s_pa, 0.3e-8);
  EXPECT_DOUBLE_EQ(parts.valves[0].exhaust.sonic_conductance_m3_per_s_pa, 0.25e-8);
  EXPECT_DOUBLE_EQ(parts.valves[0].basics.body_volume_m3, 8e-6);

  ASSERT_EQ(parts.compressors.size(), 1u);
  const model::CompressorCurve& curve = parts.compressors[0].curve;
  EXPECT_DOUBLE_EQ(curve.free_air_m3_per_s(90e3), 0.9 * 24.9e-3 / 60);
  EXPECT_DOUBLE_EQ(curve.free_air_m3_per_s(90e3 + 0.9 * 69e3), 0.9 * 14.2e-3 / 60);
  EXPECT_DOUBLE_EQ(curve.current_a(779e3), 11.0);
  EXPECT_DOUBLE_EQ(curve.pressure_max_pa, 790e3);
  EXPECT_DOUBLE_EQ(parts.compressors[0].duty_max, 0.5);

  ASSERT_EQ(parts.cylinders.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.cylinders[0].water_volume_m3, 1.1e-3);
  EXPECT_DOUBLE_EQ(parts.cylinders[0].fill_pressure_pa, 20.09e6);
  ASSERT_EQ(parts.co2.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.co2[0].water_volume_m3, 0.75e-3);
  EXPECT_DOUBLE_EQ(parts.co2[0].flow_sustained_m3_per_s, 1e-4);
  ASSERT_EQ(parts.batteries.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.batteries[0].nominal_voltage_v, 11.1);
  ASSERT_EQ(parts.regulators.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.regulators[0].inlet_pressure_min_pa, 790e3);
  EXPECT_DOUBLE_EQ(parts.regulators[0].outlet_pressure_max_pa, 940e3);
  EXPECT_TRUE(std::isinf(parts.regulators[0].flow_max_m3_per_s));
  ASSERT_EQ(parts.reservoirs.size(), 1u);
  EXPECT_DOUBLE_EQ(parts.reservoirs[0].volume_m3, 5e-4);
}

TEST(ToModelParts, GivesMissingNumbersTheirDocumentedDefaults) {
  catalog::Part bottle = PartOf("co2"), regulator = PartOf("regulator");
  bottle.numbers.erase("water_volume_l");
  regulator.numbers["flow_max_l_per_min_anr"] = {120.0, catalog::Provenance::kDatasheet, ""};
  const model::Parts parts = ToModelParts({bottle, regulator}, {});
  EXPECT_EQ(parts.co2[0].water_volume_m3, 0.0);
  EXPECT_DOUBLE_EQ(parts.regulators[0].flow_max_m3_per_s, 2e-3);
}

TEST(ToModelParts, KnowsTheFunctionsOfValves) {
  EXPECT_EQ(ValveKindFromFunction("3/2"), model::ValveKind::kThreeWay);
  EXPECT_EQ(ValveKindFromFunction("2/2 pair"), model::ValveKind::kPair);
  EXPECT_EQ(ValveKindFromFunction("proportional"), model::ValveKind::kProportional);
}

// A number of the catalogue in SI, by the unit in its name.
double InSi(const std::string& name, double value, const model::Ambient& ambient) {
  if (name.ends_with("_kpa_gauge")) return ambient.pressure_pa + 1e3 * value;
  if (name.ends_with("_mm")) return 1e-3 * value;
  if (name.ends_with("_ml")) return 1e-6 * value;
  if (name.ends_with("_l")) return 1e-3 * value;
  if (name.ends_with("_l_per_min_anr")) return 1e-3 / 60 * value;
  if (name.ends_with("_dm3_per_s_bar")) return 1e-8 * value;
  return value;
}

// The search's table of a family and the catalogue's speak of the same fields, each of the number
// that it names.
TEST(FamilyTables, AgreeWithTheCatalogue) {
  const std::set<std::string> kAmounts{"mass_kg", "body_volume_ml", "price_eur", "mass_kg_per_m",
                                       "price_eur_per_m"};
  const std::set<std::string> kUnused{"battery.cells_series",
                                      "compressor.power_min_w",
                                      "compressor.power_max_w",
                                      "compressor.vacuum_max_kpa_gauge",
                                      "vacuum_pump.power_min_w",
                                      "vacuum_pump.power_max_w",
                                      "vacuum_pump.pressure_max_kpa_gauge",
                                      "manifold.critical_ratio",
                                      "check_valve.critical_ratio",
                                      "ejector.supply_pressure_kpa_gauge",  // of the selection
                                      "ejector.nozzle_diameter_mm",
                                      "ejector.stages"};
  const model::Ambient ambient{.pressure_pa = 90e3, .temperature_k = 293.15};
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    SCOPED_TRACE(spec.name);
    EXPECT_EQ(optimizer::SpecOf(spec.family).name, spec.name);
    const catalog::Family* family = catalog::FindFamily(spec.name);
    ASSERT_NE(family, nullptr);
    std::set<std::string> names;
    for (const catalog::NumberField& field : family->numbers) {
      const std::string name(field.name);
      names.insert(name);
      EXPECT_NE(UseInSearch(spec.name, name).has_value(),
                kUnused.contains(std::string(spec.name) + "." + name))
          << name;
      EXPECT_EQ(UseInSearch(spec.name, name) == "adds up", kAmounts.contains(name)) << name;
    }
    for (const catalog::TextField& field : family->texts) names.emplace(field.name);
    for (const catalog::Part& row : SmallCatalogue()) {
      if (row.family != spec.name) continue;
      const model::Parts parts = ToModelParts({row}, ambient);
      ASSERT_EQ(optimizer::FamilySize(parts, spec.family), 1);
      EXPECT_EQ(optimizer::BasicsOf(parts, spec.family, 0).id, row.id);
      for (const optimizer::PartField& field : spec.fields) {
        const std::string name(field.name);
        EXPECT_TRUE(names.contains(name)) << name;
        const optimizer::FieldValue value = field.of(parts, 0);
        const auto number = row.numbers.find(name);
        if (const auto* text = std::get_if<std::string_view>(&value)) {
          EXPECT_EQ(*text, row.texts.at(name).value);
        } else if (number == row.numbers.end()) {
          const auto optional = std::find_if(
              family->numbers.begin(), family->numbers.end(),
              [&](const catalog::NumberField& f) { return f.name == name && !f.required; });
          EXPECT_TRUE(name == "function" || optional != family->numbers.end()) << name;
        } else if (const auto* flow = std::get_if<model::FlowElement>(&value)) {
          EXPECT_DOUBLE_EQ(flow->sonic_conductance_m3_per_s_pa,
                           InSi(name, number->second.value, ambient));
        } else if (name == "response_time_ms") {  // what a third of it lets by: t·C/√(1 − b)
          const double c =
              InSi("_dm3_per_s_bar", row.numbers.at("sonic_conductance_fill_dm3_per_s_bar").value,
                   ambient);
          const double b = row.numbers.at("critical_ratio_fill").value;
          EXPECT_DOUBLE_EQ(std::get<double>(value),
                           number->second.value / 3e3 * c / std::sqrt(1.0 - b));
        } else if (name == "capacity_ah") {
          EXPECT_DOUBLE_EQ(
              std::get<double>(value),
              model::UsableEnergy(number->second.value, row.numbers.at("nominal_voltage_v").value));
        } else {
          EXPECT_DOUBLE_EQ(std::get<double>(value), InSi(name, number->second.value, ambient))
              << name;
        }
      }
    }
  }
}

}  // namespace catalogue_parts_test
}  // namespace plenum::api
