// Cylinders, CO2 bottles and tanks: some of one kind, whose gas depends on the regulators behind
// them.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

constexpr std::tuple kRows{
    Ruled{Use::kMore, 1.0, &BottleCorner::gas_to_low_m3},
    Ruled{Use::kMore, 0.0, &BottleCorner::gas_to_high_m3},
    Best{FieldNamed(kCylinderFields, "fill_pressure_kpa_gauge"), &BottleCorner::fill_pressure_pa},
    Best{FieldNamed(kCo2Fields, "flow_sustained_l_per_min_anr"),
         &BottleCorner::flow_sustained_m3_per_s},
    Ruled{Use::kMore, 0.0, &BottleCorner::water_m3},
    Ruled{Use::kMore, 0.0, &BottleCorner::fill_max_pa}};

}  // namespace

void Widen(BottleCorner& a, const BottleCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 4> SplitKeys(const BottleCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
// They are of three families: SetBottle() and the rules below set them.
void SetNumbers(const PartNumbers&, BottleCorner&) {}

void Planter::SetBottle(double gas_kg, double full_m3, double water_m3,
                        const Entry<BottleCorner>& entry) const {
  entry.item.option.amounts.mass_kg += gas_kg;
  BottleCorner& corner = entry.item.corner;
  SetShare(problem_, entry.item.option.amounts, corner);
  const auto gas_m3 = [&](double inlet_pa) {
    return full_m3 - water_m3 * GasLeft(problem_, plan_->configuration, inlet_pa);
  };
  corner.gas_to_low_m3 = gas_m3(plan_->bottle_range.low_pa);
  corner.gas_to_high_m3 = gas_m3(plan_->bottle_range.high_pa);
  entry.contender.losses.push_back(-corner.gas_to_low_m3);
  entry.contender.losses.push_back(-corner.gas_to_high_m3);
}

int Planter::PlantCylinders() {
  const double temperature_k = problem_.ambient.temperature_k;
  const auto rule = [&](int i, int quantity, const Entry<BottleCorner>& entry) {
    const model::Cylinder& part = problem_.parts.cylinders[i];
    const double full_m3 =
        part.water_volume_m3 * GasLeft(problem_, plan_->configuration, part.fill_pressure_pa);
    SetBottle(quantity *
                  model::CylinderCharge(part.water_volume_m3, part.fill_pressure_pa, temperature_k),
              quantity * full_m3, quantity * part.water_volume_m3, entry);
    entry.item.corner.fill_pressure_pa = read::FullPressure(part);
    entry.item.corner.flow_sustained_m3_per_s = kUnlimited;
  };
  return PlantSlot(Family::kCylinder, -1, ChoicesOf(Family::kCylinder),
                   MakeSourceEntries<BottleCorner>(Family::kCylinder, rule), plan_->bottles);
}

int Planter::PlantCo2() {
  const auto rule = [&](int i, int quantity, const Entry<BottleCorner>& entry) {
    const model::Co2Bottle& part = problem_.parts.co2[i];
    SetBottle(quantity * part.co2_mass_kg,
              quantity * part.co2_mass_kg / model::kReferenceDensityCo2KgPerM3,
              quantity * part.water_volume_m3, entry);
    entry.item.corner.flow_sustained_m3_per_s = quantity * part.flow_sustained_m3_per_s;
  };
  return PlantSlot(Family::kCo2, -1, ChoicesOf(Family::kCo2),
                   MakeSourceEntries<BottleCorner>(Family::kCo2, rule), plan_->bottles);
}

// What any design with it carries of air counts as its own. A larger one may keep more at the end,
// at the highest inlet pressure most: it takes the place of another only if it weighs no more then.
int Planter::PlantTanks() {
  const auto rule = [&](int i, int quantity, const Entry<BottleCorner>& entry) {
    const model::Reservoir& part = problem_.parts.tanks[i];
    const double fill_pa = TankRatingPa(problem_, i), water_m3 = quantity * part.volume_m3;
    SetBottle(quantity * LeastTankCharge(problem_, i),
              water_m3 * GasLeft(problem_, plan_->configuration, fill_pa), water_m3, entry);
    BottleCorner& corner = entry.item.corner;
    corner.flow_sustained_m3_per_s = kUnlimited;
    corner.water_m3 = water_m3;
    corner.fill_max_pa = fill_pa;
    const double beyond_kg =
        model::TankCharge(water_m3, plan_->bottle_range.high_pa - LeastSourcePa(problem_),
                          problem_.ambient.temperature_k);
    entry.contender.beyond = problem_.objective.mass_kg * beyond_kg;
    entry.contender.losses.push_back(corner.amounts.mass_kg + beyond_kg);
  };
  return PlantSlot(Family::kTank, -1, ChoicesOf(Family::kTank),
                   MakeSourceEntries<BottleCorner>(Family::kTank, rule), plan_->bottles);
}

}  // namespace plenum::optimizer
