// Valves: one kind for each group, in as many pieces as its channels ask.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

// Whether all hold, or some do.
struct Holding {};
void Widen(const Holding&, ValveCorner& a, const ValveCorner& b) {
  a.some_hold = a.some_hold || b.some_hold;
  a.all_hold = a.all_hold && b.all_hold;
}
constexpr std::size_t KeyCount(const Holding&) { return 0; }
void AddKeys(const Holding&, const ValveCorner&, const auto&) {}
void SetNumber(const Holding&, const PartNumbers& numbers, ValveCorner& c) {
  c.some_hold = c.all_hold = numbers.Rated(FieldNamed(kValveFields, "function")) > 0.0;
}

constexpr std::tuple kRows{
    Mates{&ValveCorner::threads},
    Holding{},
    Flow{FieldNamed(kValveFields, "sonic_conductance_fill_dm3_per_s_bar"), &ValveCorner::fill},
    Flow{FieldNamed(kValveFields, "sonic_conductance_exhaust_dm3_per_s_bar"),
         &ValveCorner::exhaust},
    Best{FieldNamed(kValveFields, "coil_power_w"), &ValveCorner::coil_power_w},
    Best{FieldNamed(kValveFields, "pressure_max_kpa_gauge"), &ValveCorner::pressure_max_pa},
    Best{FieldNamed(kValveFields, "pressure_min_kpa_gauge"), &ValveCorner::pressure_min_pa}};

}  // namespace

void Widen(ValveCorner& a, const ValveCorner& b) {
  WidenBy(kRows, a, b);
  ToLeastFlow(a.late_fill, b.late_fill);
  ToLeast(a.late_s, b.late_s);
}
std::array<double, 7> SplitKeys(const ValveCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, ValveCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
  const model::Valve& valve = numbers.parts.valves[numbers.part];
  corner.late_fill = valve.fill_most.value_or(valve.fill);
  corner.late_s = valve.closing_scatter_s;
}

void Planter::PlantValves(int g, const LineMates& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  const std::vector<model::Valve>& parts = problem_.parts.valves;
  std::map<std::string, Kinds> threads_of;  // by port
  const auto count = [&](int i, int) {
    const int pieces = (group.count + parts[i].channels - 1) / parts[i].channels;
    return Count{static_cast<double>(pieces), static_cast<double>(group.count)};
  };
  const auto rule = [&](int i, int, const Entry<ValveCorner>& entry) {
    const std::string& port = parts[i].port;
    const auto [kinds, fresh] = threads_of.try_emplace(port, ~Kinds{0});
    if (fresh && mates.fittings)
      kinds->second =
          mates.threads.Where([&](const std::string& thread) { return thread == port; });
    ValveCorner& corner = entry.item.corner;
    corner.threads = kinds->second;
    if (IsDirect(plan_->configuration))
      corner.late_s = 0.0;  // the pumps stop
    else  // sources with a pressure of their own, which is no lower than the operating pressure
      corner.pressure_min_pa =
          std::max(corner.pressure_min_pa, group.chamber.operating_pressure_pa);
    // A coil takes power for so long at least.
    corner.objective += EnergyWeight(problem_) * problem_.actuations * corner.coil_power_w *
                        CoilSeconds(problem_, g, model::Holds(parts[i].kind));
  };
  PlantSlot(Family::kValve, g, ChoicesOf(Family::kValve),
            MakeEntries<ValveCorner>(Family::kValve, mates.fittings, count, rule),
            plan_->groups[g].valves);
}

}  // namespace plenum::optimizer
