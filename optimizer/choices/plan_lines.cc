// Tubes, fittings and valves of a group.
#include "optimizer/choices/planter.h"

namespace plenum::optimizer {

void Planter::PlantGroup(int g) {
  FittingKinds mates;
  for (const model::Fitting& fitting : problem_.parts.fittings) {
    mates.diameters.Bit(fitting.tube_outer_diameter_m);
    mates.threads.Bit(fitting.thread);
  }
  PlantTubes(g, mates);
  PlantFittings(g, mates);
  PlantValves(g, mates);
}

void Planter::PlantTubes(int g, const FittingKinds& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  const model::Parts& parts = problem_.parts;
  const bool needs_fittings = group.fittings_per_line > 0;
  std::map<double, Kinds> diameters_of;  // by outer diameter of the tube
  NumbersOf<std::pair<double, double>> bores;
  Entries<TubeCorner> tubes;
  tubes.Reserve(parts.tubing.size());
  for (int i = 0; i < static_cast<int>(parts.tubing.size()); ++i) {
    const model::Tubing& part = parts.tubing[i];
    if (!Priced(part.per_metre)) continue;
    const double outer_m = part.outer_diameter_m;
    const auto [kinds, fresh] = diameters_of.try_emplace(outer_m, ~Kinds{0});
    if (fresh && needs_fittings)
      kinds->second = mates.diameters.Where([&](double d) { return DiametersMate(outer_m, d); });
    const Entry<TubeCorner> entry = tubes.Add();
    entry.item.option = {i, 1, group.count * group.tube_length_m * part.per_metre};
    SetShare(problem_, entry.item.option.amounts, entry.item.corner);
    entry.item.corner.diameters = kinds->second;
    entry.item.corner.inner_low_m = entry.item.corner.inner_high_m = part.inner_diameter_m;
    entry.item.corner.pressure_max_pa = std::min(part.pressure_max_pa, useful_max_pa_);
    entry.contender.id = part.per_metre.id;
    entry.contender.mates = bores.Of({needs_fittings ? outer_m : 0.0, part.inner_diameter_m});
    entry.contender.losses = {-part.pressure_max_pa};
  }
  PlantSlot(Family::kTubing, g, static_cast<long long>(parts.tubing.size()), std::move(tubes),
            plan_->groups[g].tubes);
}

void Planter::PlantFittings(int g, FittingKinds& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  const model::Parts& parts = problem_.parts;
  const bool needs_fittings = group.fittings_per_line > 0;
  NumbersOf<std::pair<double, std::string>> ends;
  Entries<FittingCorner> fittings;
  fittings.Reserve(parts.fittings.size() + 1);
  if (!needs_fittings) {
    const Entry<FittingCorner> none = fittings.Add();
    none.item.option.index = kNone;
    none.item.corner.diameters = none.item.corner.threads = ~Kinds{0};
    none.item.corner.pressure_max_pa = kUnlimited;
  }
  for (int i = 0; needs_fittings && i < static_cast<int>(parts.fittings.size()); ++i) {
    const model::Fitting& part = parts.fittings[i];
    if (!Priced(part.basics)) continue;
    const Entry<FittingCorner> entry = fittings.Add();
    entry.item.option = {i, 1,
                         static_cast<double>(group.count * group.fittings_per_line) * part.basics};
    SetShare(problem_, entry.item.option.amounts, entry.item.corner);
    entry.item.corner.diameters = mates.diameters.Bit(part.tube_outer_diameter_m);
    entry.item.corner.threads = mates.threads.Bit(part.thread);
    entry.item.corner.flow = part.flow;
    entry.item.corner.pressure_max_pa = std::min(part.pressure_max_pa, useful_max_pa_);
    entry.contender.id = part.basics.id;
    entry.contender.mates = ends.Of({part.tube_outer_diameter_m, part.thread});
    entry.contender.losses = {-part.pressure_max_pa};
    AddFlow(part.flow, entry.contender.losses);
  }
  PlantSlot(Family::kFitting, g, needs_fittings ? static_cast<long long>(parts.fittings.size()) : 1,
            std::move(fittings), plan_->groups[g].fittings);
}

void Planter::PlantValves(int g, const FittingKinds& mates) {
  const ActuatorGroup& group = problem_.groups[g];
  const model::Parts& parts = problem_.parts;
  const bool needs_fittings = group.fittings_per_line > 0;
  NumbersOf<std::pair<bool, std::string>> ports;
  std::map<std::string, Kinds> threads_of;  // by port
  Entries<ValveCorner> valves;
  valves.Reserve(parts.valves.size());
  for (int i = 0; i < static_cast<int>(parts.valves.size()); ++i) {
    const model::Valve& part = parts.valves[i];
    if (!Priced(part.basics)) continue;
    const int pieces = (group.count + part.channels - 1) / part.channels;
    const Entry<ValveCorner> entry = valves.Add();
    entry.item.option = {i, 1, static_cast<double>(pieces) * part.basics};
    ValveCorner& corner = entry.item.corner;
    SetShare(problem_, entry.item.option.amounts, corner);
    const auto [kinds, fresh] = threads_of.try_emplace(part.port, ~Kinds{0});
    if (fresh && needs_fittings)
      kinds->second =
          mates.threads.Where([&](const std::string& thread) { return thread == part.port; });
    corner.threads = kinds->second;
    corner.some_hold = corner.all_hold = model::Holds(part.kind);
    corner.fill = part.fill;
    corner.exhaust = part.exhaust;
    corner.coil_power_w = part.coil_power_w * group.count;
    corner.pressure_min_pa = std::max(part.pressure_min_pa, group.chamber.operating_pressure_pa);
    corner.pressure_max_pa = std::min(part.pressure_max_pa, useful_max_pa_);
    corner.objective +=
        EnergyWeight(problem_) * problem_.actuations * corner.coil_power_w * HalfPeriod(problem_);
    entry.contender.id = part.basics.id;
    entry.contender.mates = ports.Of({corner.some_hold, needs_fittings ? part.port : ""});
    entry.contender.losses = {corner.coil_power_w, -part.pressure_max_pa, part.pressure_min_pa};
    AddFlow(part.fill, entry.contender.losses);
    AddFlow(part.exhaust, entry.contender.losses);
  }
  PlantSlot(Family::kValve, g, static_cast<long long>(parts.valves.size()), std::move(valves),
            plan_->groups[g].valves);
}

}  // namespace plenum::optimizer
