// The regulator of a cylinder, a CO2 bottle or the mains: one.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

constexpr std::tuple kRows{
    Flow{FieldNamed(kRegulatorFields, "sonic_conductance_dm3_per_s_bar"), &RegulatorCorner::flow},
    Best{FieldNamed(kRegulatorFields, "flow_max_l_per_min_anr"),
         &RegulatorCorner::flow_max_m3_per_s},
    Best{FieldNamed(kRegulatorFields, "inlet_pressure_min_kpa_gauge"),
         &RegulatorCorner::inlet_min_pa},
    Best{FieldNamed(kRegulatorFields, "inlet_pressure_max_kpa_gauge"),
         &RegulatorCorner::inlet_max_pa},
    Best{FieldNamed(kRegulatorFields, "outlet_pressure_min_kpa_gauge"),
         &RegulatorCorner::outlet_min_pa},
    Best{FieldNamed(kRegulatorFields, "outlet_pressure_max_kpa_gauge"),
         &RegulatorCorner::outlet_max_pa},
    Best{FieldNamed(kRegulatorFields, "electrical_power_w"), &RegulatorCorner::electrical_power_w}};

}  // namespace

void Widen(RegulatorCorner& a, const RegulatorCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 6> SplitKeys(const RegulatorCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, RegulatorCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

int Planter::PlantRegulators() {
  const auto rule = [&](int, int, const Entry<RegulatorCorner>& entry) {
    RegulatorCorner& corner = entry.item.corner;
    corner.objective += EnergyWeight(problem_) * problem_.actuations * corner.electrical_power_w /
                        problem_.frequency_hz;
  };
  return PlantSlot(Family::kRegulator, -1, ChoicesOf(Family::kRegulator),
                   MakeSourceEntries<RegulatorCorner>(Family::kRegulator, rule), plan_->regulators);
}

}  // namespace plenum::optimizer
