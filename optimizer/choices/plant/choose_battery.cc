// Batteries: some of one kind, which drive a pump or feed coils.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

constexpr std::tuple kRows{
    Mates{&BatteryCorner::voltages},
    Best{FieldNamed(kBatteryFields, "capacity_ah"), &BatteryCorner::energy_j},
    Best{FieldNamed(kBatteryFields, "current_max_a"), &BatteryCorner::current_max_a},
    Best{FieldNamed(kBatteryFields, "nominal_voltage_v"), &BatteryCorner::voltage_v}};

}  // namespace

void Widen(BatteryCorner& a, const BatteryCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 3> SplitKeys(const BatteryCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, BatteryCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

int Planter::PlantBatteries() {
  const bool pump = HasPump(plan_->configuration) || PumpsRail(problem_);
  std::map<double, std::pair<int, Kinds>> packs;  // by voltage: a number, and pumps it drives
  const auto rule = [&](int, int, const Entry<BatteryCorner>& entry) {
    const double pack_v = entry.item.corner.voltage_v;
    const auto [pack, fresh] = packs.try_emplace(pack_v, static_cast<int>(packs.size()), ~Kinds{0});
    if (fresh && pump)
      pack->second.second =
          voltages_.Where([&](double pump_v) { return model::VoltageMatches(pack_v, pump_v); });
    entry.item.corner.voltages = pack->second.second;
    if (pump) entry.contender.mates = pack->second.first;
  };
  return PlantSlot(Family::kBattery, -1, ChoicesOf(Family::kBattery),
                   MakeSourceEntries<BatteryCorner>(Family::kBattery, rule), plan_->batteries);
}

}  // namespace plenum::optimizer
