#include "optimizer/choices/outline.h"

#include <algorithm>

#include "model/physics/storage.h"
#include "optimizer/choices/plan.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

constexpr double kRounding = 1.0 - 1e-9;  // of sums in another order

class Sketch {
 public:
  Sketch(const Problem& problem, const Layout& layout) : problem_(problem) {
    outline_.layout = layout;
    outline_.combinations = outline_.priced = 1;
  }

  Outline Draw() {
    const model::Parts& parts = problem_.parts;
    const Limits& most = problem_.limits;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) AddGroup(g);
    if (IsPumped(configuration())) {
      Add(PumpsOf(problem_, configuration()), most.compressors, Pieces(FeedsOf(problem_)));
      if (KeepsReservoir(configuration())) AddReservoirs();
    } else if (outline_.layout.own_regulators) {
      for (std::size_t g = 0; g < problem_.groups.size(); ++g) Add(parts.regulators, 1, Pieces());
    } else {
      const bool none = MayLack(configuration(), Family::kRegulator);
      Add(parts.regulators, 1, Pieces(), none ? 1 : 0, none ? 0.0 : kUnlimited, true);
    }
    if (configuration() == Configuration::kCylinder) AddCylinders();
    if (configuration() == Configuration::kCo2) AddCo2();
    if (HasTank(configuration())) AddTanks();
    if (configuration() == Configuration::kTankAndPump)
      Add(PumpsOf(problem_, configuration()), most.compressors, Pieces());
    if (PumpsRail(problem_)) {
      Add(parts.vacuum_pumps, most.compressors, Pieces());
      Add(parts.reservoirs, most.reservoirs, Pieces());
    }
    if (configuration() != Configuration::kMains) AddBatteries();
    outline_.bound *= kRounding;
    return outline_;
  }

 private:
  Configuration configuration() const { return outline_.layout.configuration; }
  double Share(const Amounts& amounts) const { return ObjectiveOf(problem_.objective, amounts); }

  struct PiecesShare {
    const Objective& objective;
    int pieces;
    template <typename Part>
    double operator()(const Part& part, int quantity) const {
      return ObjectiveOf(objective, static_cast<double>(pieces * quantity) * part.basics);
    }
  };
  PiecesShare Pieces(int pieces = 1) const { return {problem_.objective, pieces}; }

  // `share(part, quantity)` of the objective, +∞ where no design can have that; `made`: choices
  // beside the parts, with their least share; `free`: these need no price.
  template <typename Part, typename ShareOf>
  void Add(const std::vector<Part>& parts, int quantity_max, const ShareOf& share, int made = 0,
           double made_share = kUnlimited, bool free = false) {
    const bool left_out = PricesNeeded(problem_) && !free;
    long long priced = left_out ? 0 : made;
    double least = left_out ? kUnlimited : made_share;
    for (const Part& part : parts) {
      if (PricesNeeded(problem_) && !BasicsOf(part).cost_eur) continue;
      priced += quantity_max;
      for (int quantity = 1; quantity <= quantity_max; ++quantity)
        least = std::min(least, share(part, quantity));
    }
    outline_.combinations *= static_cast<long long>(parts.size()) * quantity_max + made;
    outline_.priced *= priced;
    outline_.bound += least;
  }

  static const model::PartBasics& BasicsOf(const model::Tubing& part) { return part.per_metre; }
  template <typename Part>
  static const model::PartBasics& BasicsOf(const Part& part) {
    return part.basics;
  }

  void AddGroup(int g) {
    const ActuatorGroup& group = problem_.groups[g];
    const model::Parts& parts = problem_.parts;
    Add(parts.tubing, 1, [&](const model::Tubing& part, int) {
      return Share(group.count * group.tube_length_m * part.per_metre);
    });
    if (group.fittings_per_line > 0)
      Add(parts.fittings, 1, Pieces(group.count * group.fittings_per_line));
    Add(parts.valves, 1, [&](const model::Valve& part, int) {
      const int pieces = (group.count + part.channels - 1) / part.channels;
      return Share(static_cast<double>(pieces) * part.basics);
    });
    double coil_w = kUnlimited;
    for (const model::Valve& valve : parts.valves) coil_w = std::min(coil_w, valve.coil_power_w);
    const double coil_s = std::min(CoilSeconds(problem_, g, false), CoilSeconds(problem_, g, true));
    coils_j_ += problem_.actuations * coil_s * group.count * coil_w;
    const model::Chamber& chamber = group.chamber;
    const double content = model::Content(chamber, chamber.operating_pressure_pa) -
                           model::Content(chamber, model::RestPa(chamber));
    air_m3_ += problem_.actuations * group.gait.strokes_per_period * group.count *
               model::StandardVolume(content, problem_.ambient.temperature_k);
  }

  void AddReservoirs() {
    const bool made = MadeToMeasureAllowed(problem_, Family::kReservoir);
    Add(problem_.parts.reservoirs, problem_.limits.reservoirs, Pieces(), made ? 1 : 0,
        made ? Share(CustomReservoir(problem_, model::kMadeReservoirSmallestM3,
                                     LeastSourcePa(problem_)))
             : kUnlimited);
  }

  double GasAt(double pressure_pa) const { return GasLeft(problem_, configuration(), pressure_pa); }

  // Of bottles that hold so much gas and give it down to ambient pressure.
  double BottleShare(const model::PartBasics& basics, int quantity, double gas_kg, double gas_m3,
                     double water_m3) const {
    const double given_m3 = gas_m3 - water_m3 * GasAt(problem_.ambient.pressure_pa);
    if (quantity * given_m3 < kRounding * air_m3_) return kUnlimited;
    Amounts amounts = static_cast<double>(quantity) * basics;
    amounts.mass_kg += quantity * gas_kg;
    return Share(amounts);
  }

  void AddCylinders() {
    const double temperature_k = problem_.ambient.temperature_k;
    Add(problem_.parts.cylinders, problem_.limits.cylinders,
        [&](const model::Cylinder& part, int quantity) {
          const double water_m3 = part.water_volume_m3, fill_pa = part.fill_pressure_pa;
          return BottleShare(part.basics, quantity,
                             model::CylinderCharge(water_m3, fill_pa, temperature_k),
                             water_m3 * GasAt(fill_pa), water_m3);
        });
  }

  void AddCo2() {
    Add(problem_.parts.co2, problem_.limits.co2, [&](const model::Co2Bottle& part, int quantity) {
      return BottleShare(part.basics, quantity, part.co2_mass_kg,
                         part.co2_mass_kg / model::kReferenceDensityCo2KgPerM3,
                         part.water_volume_m3);
    });
  }

  // What pumps go on filling need not hold all the air.
  void AddTanks() {
    const bool alone = configuration() == Configuration::kTank;
    const double held_kg = alone ? air_m3_ * model::kReferenceDensityKgPerM3 : 0.0;
    Add(problem_.parts.tanks, problem_.limits.reservoirs,
        [&](const model::Reservoir& part, int quantity) {
          const int i = static_cast<int>(&part - problem_.parts.tanks.data());
          const double full_m3 =
              alone ? part.volume_m3 * GasAt(TankRatingPa(problem_, i)) : kUnlimited;
          const double share = BottleShare(part.basics, quantity, LeastTankCharge(problem_, i),
                                           full_m3, part.volume_m3);
          return share + problem_.objective.mass_kg * held_kg;
        });
  }

  void AddBatteries() {
    std::vector<model::Battery> batteries = problem_.parts.batteries;
    batteries.resize(
        static_cast<std::size_t>(ChoicesIn(problem_, configuration(), Family::kBattery)));
    Add(batteries, problem_.limits.batteries, [&](const model::Battery& part, int quantity) {
      const double energy_j =
          quantity * model::UsableEnergy(part.capacity_ah, part.nominal_voltage_v);
      return energy_j < kRounding * coils_j_ ? kUnlimited : Pieces()(part, quantity);
    });
  }

  const Problem& problem_;
  Outline outline_;
  double coils_j_ = 0.0, air_m3_ = 0.0;  // of the mission, at least
};

}  // namespace

Outline MakeOutline(const Problem& problem, const Layout& layout) {
  return Sketch(problem, layout).Draw();
}

}  // namespace plenum::optimizer
