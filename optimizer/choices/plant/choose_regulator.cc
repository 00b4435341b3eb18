// The regulator of a cylinder, a CO2 bottle or the mains: one for all groups, which a tank may do
// without, or one for each.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

// Whether all are none, or some.
struct Lacking {};
void Widen(const Lacking&, RegulatorCorner& a, const RegulatorCorner& b) {
  a.some_none = a.some_none || b.some_none;
  a.all_none = a.all_none && b.all_none;
}
constexpr std::size_t KeyCount(const Lacking&) { return 0; }
void AddKeys(const Lacking&, const RegulatorCorner&, const auto&) {}
void SetNumber(const Lacking&, const PartNumbers&, RegulatorCorner&) {}

// None holds nothing back: a conductance that no line comes near, and pressures that no tank has.
constexpr double kEndless = 1.0;  // m³/(s·Pa)
constexpr double kEndlessPa = 1e12;

constexpr std::tuple kRows{
    Lacking{},
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

// No regulator stands for another choice, and none stands for it.
void AddNone(const Problem& problem, Entries<RegulatorCorner>& entries) {
  const int mates = entries.classes.size();
  const std::size_t losses =
      entries.contenders.empty() ? 0 : entries.contenders.front().losses.size();
  const Entry<RegulatorCorner> none = entries.Add();
  none.item.option.index = kNone;
  RegulatorCorner& corner = none.item.corner;
  corner.some_none = corner.all_none = true;
  corner.flow = {kEndless, 0.5};
  corner.flow_max_m3_per_s = kUnlimited;
  corner.inlet_max_pa = kEndlessPa;
  corner.outlet_max_pa = HighestTankPa(problem);
  none.contender.mates = mates;
  none.contender.losses.assign(losses, 0.0);
}

}  // namespace

void Widen(RegulatorCorner& a, const RegulatorCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 6> SplitKeys(const RegulatorCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, RegulatorCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

int Planter::PlantRegulator(int group, BoxTree<RegulatorCorner>& tree) {
  const Amounts joint = OwnRegulatorJointAtMains(problem_, plan_->configuration, group);
  const auto count = [&](int, int) { return Count{1.0, 1.0, joint}; };
  const auto rule = [&](int, int, const Entry<RegulatorCorner>& entry) {
    RegulatorCorner& corner = entry.item.corner;
    corner.objective += EnergyWeight(problem_) * problem_.actuations * corner.electrical_power_w /
                        problem_.frequency_hz;
  };
  Entries<RegulatorCorner> entries =
      MakeEntries<RegulatorCorner>(Family::kRegulator, true, count, rule);
  long long total = ChoicesOf(Family::kRegulator);
  if (group < 0 && MayLack(plan_->configuration, Family::kRegulator)) {
    ++total;
    AddNone(problem_, entries);
  }
  return PlantSlot(Family::kRegulator, group, total, std::move(entries), tree);
}

void Planter::PlantRegulators() {
  const int groups = static_cast<int>(problem_.groups.size());
  plan_->regulators.resize(plan_->own_regulators ? groups : 1);
  for (int i = 0; i < static_cast<int>(plan_->regulators.size()); ++i)
    plan_->regulator_slots.push_back(
        PlantRegulator(plan_->own_regulators ? i : -1, plan_->regulators[i]));
}

}  // namespace plenum::optimizer
