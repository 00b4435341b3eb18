// Tubes: one kind for each group.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

constexpr std::tuple kRows{
    Mates{&TubeCorner::diameters},
    Ends{FieldNamed(kTubingFields, "inner_diameter_mm"), &TubeCorner::inner_low_m,
         &TubeCorner::inner_high_m},
    Best{FieldNamed(kTubingFields, "pressure_max_kpa_gauge"), &TubeCorner::pressure_max_pa}};

}  // namespace

void Widen(TubeCorner& a, const TubeCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 3> SplitKeys(const TubeCorner& c) { return KeysBy<KeyCountOf(kRows)>(kRows, c); }
void SetNumbers(const PartNumbers& numbers, TubeCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

void Planter::PlantTubing(int g, const LineMates& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  std::map<double, Kinds> diameters_of;  // by outer diameter of the tube
  const Amounts joint = LineJointShare(problem_, g, plan_->own_regulators);
  const auto count = [&](int, int) {
    return Count{group.count * group.tube_length_m, static_cast<double>(group.count), joint};
  };
  const auto rule = [&](int i, int, const Entry<TubeCorner>& entry) {
    const double outer_m = problem_.parts.tubing[i].outer_diameter_m;
    const auto [kinds, fresh] = diameters_of.try_emplace(outer_m, ~Kinds{0});
    if (fresh && mates.fittings)
      kinds->second = mates.diameters.Where([&](double d) { return DiametersMate(outer_m, d); });
    entry.item.corner.diameters = kinds->second;
  };
  PlantSlot(Family::kTubing, g, ChoicesOf(Family::kTubing),
            MakeEntries<TubeCorner>(Family::kTubing, mates.fittings, count, rule),
            plan_->groups[g].tubes);
}

}  // namespace plenum::optimizer
