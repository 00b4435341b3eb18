// Fittings: one kind for each group, or none where it needs none.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

constexpr std::tuple kRows{
    Mates{&FittingCorner::diameters}, Mates{&FittingCorner::threads},
    Flow{FieldNamed(kFittingFields, "sonic_conductance_dm3_per_s_bar"), &FittingCorner::flow},
    Best{FieldNamed(kFittingFields, "pressure_max_kpa_gauge"), &FittingCorner::pressure_max_pa}};

}  // namespace

void Widen(FittingCorner& a, const FittingCorner& b) {
  WidenBy(kRows, a, b);
  ToLeastFlow(a.late_flow, b.late_flow);
}
std::array<double, 4> SplitKeys(const FittingCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, FittingCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
  const model::Fitting& fitting = numbers.parts.fittings[numbers.part];
  corner.late_flow = fitting.flow_most.value_or(fitting.flow);
}

void Planter::PlantFittings(int g, LineMates& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  BoxTree<FittingCorner>& tree = plan_->groups[g].fittings;
  if (!mates.fittings) {
    Entries<FittingCorner> entries;
    const Entry<FittingCorner> none = entries.Add();
    none.item.option.index = kNone;
    none.item.corner.diameters = none.item.corner.threads = ~Kinds{0};
    none.item.corner.pressure_max_pa = kUnlimited;
    PlantSlot(Family::kFitting, g, 1, std::move(entries), tree);
    return;
  }
  const auto count = [&](int, int) {
    return Count{static_cast<double>(group.count * group.fittings_per_line),
                 static_cast<double>(group.count)};
  };
  const auto rule = [&](int i, int, const Entry<FittingCorner>& entry) {
    const model::Fitting& part = problem_.parts.fittings[i];
    entry.item.corner.diameters = mates.diameters.Bit(part.tube_outer_diameter_m);
    entry.item.corner.threads = mates.threads.Bit(part.thread);
  };
  PlantSlot(Family::kFitting, g, ChoicesOf(Family::kFitting),
            MakeEntries<FittingCorner>(Family::kFitting, true, count, rule), tree);
}

}  // namespace plenum::optimizer
