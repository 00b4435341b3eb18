// Reservoirs: some of one kind, or one made to measure.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

// Whether one may be made to measure.
struct Making {};
void Widen(const Making&, ReservoirCorner& a, const ReservoirCorner& b) {
  a.custom = a.custom || b.custom;
}
constexpr std::size_t KeyCount(const Making&) { return 0; }
void AddKeys(const Making&, const ReservoirCorner&, const auto&) {}
void SetNumber(const Making&, const PartNumbers&, ReservoirCorner&) {}

constexpr std::tuple kRows{Making{},
                           Ends{FieldNamed(kReservoirFields, "internal_volume_ml"),
                                &ReservoirCorner::low_m3, &ReservoirCorner::high_m3},
                           Best{FieldNamed(kReservoirFields, "pressure_max_kpa_gauge"),
                                &ReservoirCorner::pressure_max_pa}};

}  // namespace

void Widen(ReservoirCorner& a, const ReservoirCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 3> SplitKeys(const ReservoirCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, ReservoirCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

void Planter::AddMadeReservoir(int mates, const Entry<ReservoirCorner>& entry) const {
  entry.item.option.index = kCustom;
  entry.item.option.quantity = 1;
  ReservoirCorner& corner = entry.item.corner;
  SetShare(problem_,
           CustomReservoir(problem_, model::kMadeReservoirSmallestM3, LeastSourcePa(problem_)),
           corner);
  corner.custom = true;
  corner.low_m3 = model::kMadeReservoirSmallestM3;
  corner.high_m3 = model::kMadeReservoirLargestM3;
  corner.pressure_max_pa = CustomRatingPa(problem_);
  entry.contender.id = "custom";
  entry.contender.mates = mates;
  entry.contender.losses = {0.0};
}

int Planter::PlantReservoirs(Family family, BoxTree<ReservoirCorner>& tree) {
  Entries<ReservoirCorner> entries =
      MakeSourceEntries<ReservoirCorner>(family, [](int, int, const Entry<ReservoirCorner>&) {});
  long long total = ChoicesOf(family);
  if (MadeToMeasureAllowed(problem_, family)) {
    ++total;
    if (!PricesNeeded(problem_)) AddMadeReservoir(entries.classes.size(), entries.Add());
  }
  return PlantSlot(family, -1, total, std::move(entries), tree);
}

}  // namespace plenum::optimizer
