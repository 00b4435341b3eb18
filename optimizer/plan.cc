#include "optimizer/plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "model/storage.h"
#include "optimizer/dominance.h"
#include "optimizer/line.h"

namespace plenum::optimizer {
namespace {

constexpr double kJoulePerWattHour = 3600.0;

// Numbers distinct values, so that parts can tell by bits which they mate with.
template <typename Value>
class KindsOf {
 public:
  Kinds Bit(const Value& value) {
    const auto [entry, fresh] = number_.try_emplace(value, number_.size());
    return Kinds{1} << (entry->second % 64);
  }
  template <typename Mates>
  Kinds Where(const Mates& mates) const {
    Kinds kinds = 0;
    for (const auto& [value, number] : number_)
      if (mates(value)) kinds |= Kinds{1} << (number % 64);
    return kinds;
  }

 private:
  std::map<Value, std::size_t> number_;
};

// Objective per joule.
double EnergyWeight(const Problem& problem) {
  return problem.objective.energy_wh / kJoulePerWattHour;
}

// A choice with what dominance compares; PlantSlot adds the amounts that limits are on.
template <typename Corner>
struct Entry {
  Item<Corner> item;
  std::string id;
  std::string mates;
  std::vector<double> losses;
};

template <typename Corner>
Corner CornerOf(const Problem& problem, const Amounts& amounts) {
  Corner corner;
  corner.amounts = amounts;
  corner.objective = ObjectiveOf(problem.objective, amounts);
  return corner;
}

std::string Bytes(std::initializer_list<double> values) {
  std::string bytes;
  for (double value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

std::string Bytes(std::span<const double> values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

class Planter {
 public:
  Planter(const Problem& problem, Configuration configuration)
      : problem_(problem), plan_(std::make_unique<Plan>()) {
    plan_->configuration = configuration;
    plan_->equal_flow = EqualFlow();
    plan_->bottle_range = FindBottleRange();
    plan_->highest_pump_pa = HighestPumpPressure(problem);
    plan_->tie = LargestTie();
  }

  std::unique_ptr<Plan> Plant() {
    const std::size_t groups = problem_.groups.size();
    plan_->groups.resize(groups);
    plan_->slots.reserve(kSlotsPerGroup * groups + 3);
    total_ = priced_ = kept_ = 1;
    for (int g = 0; g < static_cast<int>(groups); ++g) PlantGroup(g);
    if (plan_->configuration == Configuration::kCompressor) {
      plan_->compressor_slot = PlantCompressors();
      plan_->reservoir_slot = PlantReservoirs();
    } else {
      plan_->regulator_slot = PlantRegulators();
      if (plan_->configuration == Configuration::kCylinder) plan_->bottle_slot = PlantCylinders();
      if (plan_->configuration == Configuration::kCo2) plan_->bottle_slot = PlantCo2();
    }
    if (plan_->configuration != Configuration::kMains) plan_->battery_slot = PlantBatteries();
    plan_->combinations = total_;
    plan_->unpriced = total_ - priced_;
    plan_->dominated = priced_ - kept_;
    return std::move(plan_);
  }

 private:
  // A faster line is only sure to be no worse for the other groups where no two strokes take air at
  // the same time, and for a pump only where more pressure costs more energy per air.
  bool EqualFlow() const {
    const int groups = static_cast<int>(problem_.groups.size());
    if (plan_->configuration != Configuration::kCompressor)
      return groups > 1 && (problem_.simultaneous || groups > 2);
    if (groups > 1) return true;
    return !std::all_of(problem_.parts.compressors.begin(), problem_.parts.compressors.end(),
                        [&](const model::Compressor& c) {
                          return EnergyPerAirRises(c.curve, problem_.ambient.pressure_pa,
                                                   model::HighestPressure(c.curve));
                        });
  }

  BottleRange FindBottleRange() const {
    BottleRange range{problem_.ambient.pressure_pa, problem_.ambient.pressure_pa};
    double outlet_pa = range.low_pa;
    for (const model::Regulator& regulator : problem_.parts.regulators) {
      outlet_pa = std::max(outlet_pa, regulator.outlet_pressure_max_pa);
      range.high_pa = std::max(range.high_pa, regulator.inlet_pressure_min_pa);
    }
    range.high_pa = std::max(range.high_pa, std::min(outlet_pa, problem_.source_pressure_max_pa));
    return range;
  }

  // Objectives this close may tie: the tie of the largest objective there is.
  double LargestTie() const {
    double sum = 0.0;
    const auto add = [&](const auto& family, double pieces) {
      double most = 0.0;
      for (const auto& part : family) {
        if constexpr (requires { part.per_metre; })
          most = std::max(most, ObjectiveOf(problem_.objective, pieces * part.per_metre));
        else
          most = std::max(most, ObjectiveOf(problem_.objective, pieces * part.basics));
      }
      sum += most;
    };
    const model::Parts& parts = problem_.parts;
    for (const ActuatorGroup& group : problem_.groups) {
      add(parts.tubing, group.count * group.tube_length_m);
      add(parts.fittings, group.count * group.fittings_per_line);
      add(parts.valves, group.count);
    }
    add(parts.regulators, 1);
    add(parts.cylinders, problem_.limits.cylinders);
    add(parts.co2, problem_.limits.co2);
    add(parts.compressors, problem_.limits.compressors);
    add(parts.batteries, problem_.limits.batteries);
    add(parts.reservoirs, problem_.limits.reservoirs);
    for (const model::Cylinder& c : parts.cylinders)
      gas_kg_ = std::max(gas_kg_, model::CylinderCharge(c.water_volume_m3, c.fill_pressure_pa,
                                                        problem_.ambient.temperature_k));
    for (const model::Co2Bottle& bottle : parts.co2)
      gas_kg_ = std::max(gas_kg_, bottle.co2_mass_kg);
    sum += problem_.objective.mass_kg * gas_kg_ *
           std::max(problem_.limits.cylinders, problem_.limits.co2);
    sum +=
        ObjectiveOf(problem_.objective, CustomReservoir(problem_, model::kMadeReservoirLargestM3));
    double energy_j = 0.0;  // no design uses more than its batteries give
    for (const model::Battery& battery : parts.batteries)
      energy_j = std::max(energy_j,
                          problem_.limits.batteries *
                              model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v));
    if (plan_->configuration == Configuration::kMains) energy_j = MainsEnergy();
    return kTie * (sum + EnergyWeight(problem_) * energy_j);
  }

  double MainsEnergy() const {
    double power_w = 0.0, regulator_w = 0.0;
    for (const model::Valve& valve : problem_.parts.valves)
      power_w = std::max(power_w, valve.coil_power_w);
    int actuators = 0;
    for (const ActuatorGroup& group : problem_.groups) actuators += group.count;
    for (const model::Regulator& regulator : problem_.parts.regulators)
      regulator_w = std::max(regulator_w, regulator.electrical_power_w);
    return problem_.actuations / problem_.frequency_hz * (actuators * power_w + regulator_w);
  }

  // Leaves out what is dominated, plants the rest and adds the slot; returns its number.
  template <typename Corner>
  int PlantSlot(Family family, int group, long long total, std::vector<Entry<Corner>> entries,
                BoxTree<Corner>& tree) {
    std::vector<Contender> contenders;
    for (Entry<Corner>& entry : entries) {
      Contender contender;
      contender.item = {entry.item.option.index, entry.item.option.quantity};
      contender.id = std::move(entry.id);
      contender.objective = entry.item.corner.objective;
      contender.mates = std::move(entry.mates);
      contender.losses = std::move(entry.losses);
      const Amounts& amounts = entry.item.corner.amounts;
      if (std::isfinite(problem_.mass_max_kg)) contender.losses.push_back(amounts.mass_kg);
      if (std::isfinite(problem_.volume_max_l)) contender.losses.push_back(amounts.volume_m3);
      if (std::isfinite(problem_.cost_max_eur)) contender.losses.push_back(amounts.cost_eur);
      contenders.push_back(std::move(contender));
    }
    Skyband skyband = KeepBest(contenders, problem_.count, plan_->tie);
    std::sort(skyband.kept.begin(), skyband.kept.end(), [&](int a, int b) {
      const Contender &x = contenders[a], &y = contenders[b];
      return x.id != y.id ? x.id < y.id : x.item.quantity < y.item.quantity;
    });
    std::vector<Item<Corner>> items;
    for (int i : skyband.kept) {
      items.push_back(entries[i].item);
      items.back().rank = static_cast<int>(items.size());
    }
    tree = MakeBoxTree(items);
    plan_->slots.push_back(
        {family, group, &tree.nodes, &tree.options, std::move(skyband.left_out)});
    total_ *= total;
    priced_ *= static_cast<long long>(entries.size());
    kept_ *= static_cast<long long>(items.size());
    return static_cast<int>(plan_->slots.size()) - 1;
  }

  bool Priced(const model::PartBasics& basics) const {
    return !CostMatters(problem_) || basics.cost_eur.has_value();
  }

  // C and b as losses, also the other way round where only equal flow compares.
  void AddFlow(const model::FlowElement& flow, std::vector<double>& losses) const {
    losses.push_back(-flow.sonic_conductance_m3_per_s_pa);
    losses.push_back(-flow.critical_ratio);
    losses.push_back(flow.subsonic_index);
    if (!plan_->equal_flow) return;
    losses.push_back(flow.sonic_conductance_m3_per_s_pa);
    losses.push_back(flow.critical_ratio);
    losses.push_back(-flow.subsonic_index);
  }

  void PlantGroup(int g) {
    const ActuatorGroup& group = problem_.groups[g];
    const model::Parts& parts = problem_.parts;
    GroupTrees& trees = plan_->groups[g];
    const bool needs_fittings = group.fittings_per_line > 0;
    KindsOf<double> diameters;
    KindsOf<std::string> threads;
    for (const model::Fitting& fitting : parts.fittings) {
      diameters.Bit(fitting.tube_outer_diameter_m);
      threads.Bit(fitting.thread);
    }

    std::map<double, Kinds> diameters_of;  // by outer diameter of the tube
    std::vector<Entry<TubeCorner>> tubes;
    for (int i = 0; i < static_cast<int>(parts.tubing.size()); ++i) {
      const model::Tubing& part = parts.tubing[i];
      if (!Priced(part.per_metre)) continue;
      const double outer_m = part.outer_diameter_m;
      const auto [kinds, fresh] = diameters_of.try_emplace(outer_m, ~Kinds{0});
      if (fresh && needs_fittings)
        kinds->second = diameters.Where([&](double d) { return DiametersMate(outer_m, d); });
      Entry<TubeCorner> entry;
      entry.item.option = {i, 1, group.count * group.tube_length_m * part.per_metre};
      entry.item.corner = CornerOf<TubeCorner>(problem_, entry.item.option.amounts);
      entry.item.corner.diameters = kinds->second;
      entry.item.corner.inner_low_m = entry.item.corner.inner_high_m = part.inner_diameter_m;
      entry.item.corner.pressure_max_pa = part.pressure_max_pa;
      entry.id = part.per_metre.id;
      entry.mates = Bytes({needs_fittings ? outer_m : 0.0, part.inner_diameter_m});
      entry.losses = {-part.pressure_max_pa};
      tubes.push_back(std::move(entry));
    }
    PlantSlot(Family::kTubing, g, static_cast<long long>(parts.tubing.size()), std::move(tubes),
              trees.tubes);

    std::vector<Entry<FittingCorner>> fittings;
    if (!needs_fittings) {
      Entry<FittingCorner> none;
      none.item.option.index = kNone;
      none.item.corner.diameters = none.item.corner.threads = ~Kinds{0};
      none.item.corner.pressure_max_pa = kUnlimited;
      fittings.push_back(none);
    }
    for (int i = 0; needs_fittings && i < static_cast<int>(parts.fittings.size()); ++i) {
      const model::Fitting& part = parts.fittings[i];
      if (!Priced(part.basics)) continue;
      Entry<FittingCorner> entry;
      entry.item.option = {
          i, 1, static_cast<double>(group.count * group.fittings_per_line) * part.basics};
      entry.item.corner = CornerOf<FittingCorner>(problem_, entry.item.option.amounts);
      entry.item.corner.diameters = diameters.Bit(part.tube_outer_diameter_m);
      entry.item.corner.threads = threads.Bit(part.thread);
      entry.item.corner.flow = part.flow;
      entry.item.corner.pressure_max_pa = part.pressure_max_pa;
      entry.id = part.basics.id;
      entry.mates = Bytes({part.tube_outer_diameter_m}) + part.thread;
      entry.losses = {-part.pressure_max_pa};
      AddFlow(part.flow, entry.losses);
      fittings.push_back(std::move(entry));
    }
    PlantSlot(Family::kFitting, g,
              needs_fittings ? static_cast<long long>(parts.fittings.size()) : 1,
              std::move(fittings), trees.fittings);

    std::vector<Entry<ValveCorner>> valves;
    for (int i = 0; i < static_cast<int>(parts.valves.size()); ++i) {
      const model::Valve& part = parts.valves[i];
      if (!Priced(part.basics)) continue;
      const int pieces = (group.count + part.channels - 1) / part.channels;
      Entry<ValveCorner> entry;
      entry.item.option = {i, 1, static_cast<double>(pieces) * part.basics};
      ValveCorner& corner = entry.item.corner;
      corner = CornerOf<ValveCorner>(problem_, entry.item.option.amounts);
      corner.threads =
          needs_fittings
              ? threads.Where([&](const std::string& thread) { return thread == part.port; })
              : ~Kinds{0};
      corner.some_hold = corner.all_hold = model::Holds(part.kind);
      corner.fill = part.fill;
      corner.exhaust = part.exhaust;
      corner.coil_power_w = part.coil_power_w * group.count;
      corner.pressure_min_pa = part.pressure_min_pa;
      corner.pressure_max_pa = part.pressure_max_pa;
      corner.objective +=
          EnergyWeight(problem_) * problem_.actuations * corner.coil_power_w * HalfPeriod(problem_);
      entry.id = part.basics.id;
      entry.mates = (corner.some_hold ? "holds " : "vents ") + (needs_fittings ? part.port : "");
      entry.losses = {corner.coil_power_w, -part.pressure_max_pa, part.pressure_min_pa};
      AddFlow(part.fill, entry.losses);
      AddFlow(part.exhaust, entry.losses);
      valves.push_back(std::move(entry));
    }
    PlantSlot(Family::kValve, g, static_cast<long long>(parts.valves.size()), std::move(valves),
              trees.valves);
  }

  int PlantRegulators() {
    std::vector<Entry<RegulatorCorner>> entries;
    for (int i = 0; i < static_cast<int>(problem_.parts.regulators.size()); ++i) {
      const model::Regulator& part = problem_.parts.regulators[i];
      if (!Priced(part.basics)) continue;
      Entry<RegulatorCorner> entry;
      entry.item.option = {i, 1, 1.0 * part.basics};
      RegulatorCorner& corner = entry.item.corner;
      corner = CornerOf<RegulatorCorner>(problem_, entry.item.option.amounts);
      corner.flow = part.flow;
      corner.flow_max_m3_per_s = part.flow_max_m3_per_s;
      corner.inlet_min_pa = part.inlet_pressure_min_pa;
      corner.inlet_max_pa = part.inlet_pressure_max_pa;
      corner.outlet_min_pa = part.outlet_pressure_min_pa;
      corner.outlet_max_pa = part.outlet_pressure_max_pa;
      corner.electrical_power_w = part.electrical_power_w;
      corner.objective += EnergyWeight(problem_) * problem_.actuations * part.electrical_power_w /
                          problem_.frequency_hz;
      entry.id = part.basics.id;
      entry.losses = {-part.flow.sonic_conductance_m3_per_s_pa,
                      -part.flow.critical_ratio,
                      part.flow.subsonic_index,
                      -part.flow_max_m3_per_s,
                      part.inlet_pressure_min_pa,
                      -part.inlet_pressure_max_pa,
                      part.outlet_pressure_min_pa,
                      -part.outlet_pressure_max_pa,
                      part.electrical_power_w};
      entries.push_back(std::move(entry));
    }
    return PlantSlot(Family::kRegulator, -1,
                     static_cast<long long>(problem_.parts.regulators.size()), std::move(entries),
                     plan_->regulators);
  }

  // `make(part, quantity, entry)` for each part × 1…quantity_max that has the price it needs.
  template <typename Corner, typename Part, typename Make>
  std::vector<Entry<Corner>> InParallel(const std::vector<Part>& parts, int quantity_max,
                                        const Make& make) const {
    std::vector<Entry<Corner>> entries;
    for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
      if (!Priced(parts[i].basics)) continue;
      for (int quantity = 1; quantity <= quantity_max; ++quantity) {
        Entry<Corner> entry;
        entry.item.option = {i, quantity, static_cast<double>(quantity) * parts[i].basics};
        entry.id = parts[i].basics.id;
        make(parts[i], quantity, entry);
        entries.push_back(std::move(entry));
      }
    }
    return entries;
  }

  // `full_m3`: gas down to an inlet pressure of nothing; `water_m3`: what holds gas back.
  void SetBottle(double gas_kg, double full_m3, double water_m3, double fill_pa,
                 double flow_m3_per_s, Entry<BottleCorner>& entry) const {
    entry.item.option.amounts.mass_kg += gas_kg;
    BottleCorner& corner = entry.item.corner;
    corner = CornerOf<BottleCorner>(problem_, entry.item.option.amounts);
    const auto gas_m3 = [&](double inlet_pa) {
      return full_m3 - water_m3 * GasLeft(problem_, plan_->configuration, inlet_pa);
    };
    corner.gas_to_low_m3 = gas_m3(plan_->bottle_range.low_pa);
    corner.gas_to_high_m3 = gas_m3(plan_->bottle_range.high_pa);
    corner.fill_pressure_pa = fill_pa;
    corner.flow_sustained_m3_per_s = flow_m3_per_s;
    entry.losses = {-corner.gas_to_low_m3, -corner.gas_to_high_m3, fill_pa, -flow_m3_per_s};
  }

  int PlantCylinders() {
    const double temperature_k = problem_.ambient.temperature_k;
    const auto make = [&](const model::Cylinder& part, int quantity, Entry<BottleCorner>& entry) {
      const double full_m3 =
          part.water_volume_m3 * GasLeft(problem_, plan_->configuration, part.fill_pressure_pa);
      SetBottle(quantity * model::CylinderCharge(part.water_volume_m3, part.fill_pressure_pa,
                                                 temperature_k),
                quantity * full_m3, quantity * part.water_volume_m3, part.fill_pressure_pa,
                kUnlimited, entry);
    };
    const int most = problem_.limits.cylinders;
    const auto& parts = problem_.parts.cylinders;
    return PlantSlot(Family::kCylinder, -1, static_cast<long long>(parts.size()) * most,
                     InParallel<BottleCorner>(parts, most, make), plan_->bottles);
  }

  int PlantCo2() {
    const auto make = [&](const model::Co2Bottle& part, int quantity, Entry<BottleCorner>& entry) {
      SetBottle(quantity * part.co2_mass_kg,
                quantity * part.co2_mass_kg / model::kReferenceDensityCo2KgPerM3,
                quantity * part.water_volume_m3, 0.0, quantity * part.flow_sustained_m3_per_s,
                entry);
    };
    const int most = problem_.limits.co2;
    const auto& parts = problem_.parts.co2;
    return PlantSlot(Family::kCo2, -1, static_cast<long long>(parts.size()) * most,
                     InParallel<BottleCorner>(parts, most, make), plan_->bottles);
  }

  int PlantCompressors() {
    for (const model::Compressor& part : problem_.parts.compressors)
      voltages_.Bit(part.curve.voltage_v);
    const auto make = [&](const model::Compressor& part, int quantity,
                          Entry<CompressorCorner>& entry) {
      const model::CompressorCurve& curve = part.curve;
      CompressorCorner& corner = entry.item.corner;
      corner = CornerOf<CompressorCorner>(problem_, entry.item.option.amounts);
      corner.voltages = voltages_.Bit(curve.voltage_v);
      corner.duty_max = part.duty_max;
      corner.pressure_max_pa = model::HighestPressure(curve);
      corner.pump = MakeCoarsePump(problem_, plan_->highest_pump_pa, curve, quantity);
      entry.mates = Bytes({static_cast<double>(quantity), curve.voltage_v, curve.pressure_max_pa}) +
                    Bytes(curve.free_air_m3_per_s.x()) + Bytes(curve.free_air_m3_per_s.y()) +
                    Bytes(curve.current_a.x()) + Bytes(curve.current_a.y());
      entry.losses = {-part.duty_max};
    };
    const int most = problem_.limits.compressors;
    const auto& parts = problem_.parts.compressors;
    return PlantSlot(Family::kCompressor, -1, static_cast<long long>(parts.size()) * most,
                     InParallel<CompressorCorner>(parts, most, make), plan_->compressors);
  }

  int PlantReservoirs() {
    const auto make = [&](const model::Reservoir& part, int quantity,
                          Entry<ReservoirCorner>& entry) {
      ReservoirCorner& corner = entry.item.corner;
      corner = CornerOf<ReservoirCorner>(problem_, entry.item.option.amounts);
      corner.low_m3 = corner.high_m3 = quantity * part.volume_m3;
      corner.pressure_max_pa = part.pressure_max_pa;
      entry.mates = Bytes({corner.low_m3});
      entry.losses = {-part.pressure_max_pa};
    };
    const int most = problem_.limits.reservoirs;
    const auto& parts = problem_.parts.reservoirs;
    long long total = static_cast<long long>(parts.size()) * most;
    std::vector<Entry<ReservoirCorner>> entries = InParallel<ReservoirCorner>(parts, most, make);
    const auto required = problem_.require.find(Family::kReservoir);
    if (!problem_.exclude.contains("custom") &&
        (required == problem_.require.end() || required->second.contains("custom"))) {
      ++total;
      Entry<ReservoirCorner> custom;
      custom.item.option.index = kCustom;
      custom.item.option.quantity = 1;
      custom.item.corner = CornerOf<ReservoirCorner>(
          problem_, CustomReservoir(problem_, model::kMadeReservoirSmallestM3));
      custom.item.corner.custom = true;
      custom.item.corner.low_m3 = model::kMadeReservoirSmallestM3;
      custom.item.corner.high_m3 = model::kMadeReservoirLargestM3;
      custom.item.corner.pressure_max_pa = CustomRatingPa(problem_);
      custom.id = "custom";
      custom.mates = "custom";
      custom.losses = {0.0};
      if (!CostMatters(problem_)) entries.push_back(std::move(custom));
    }
    return PlantSlot(Family::kReservoir, -1, total, std::move(entries), plan_->reservoirs);
  }

  int PlantBatteries() {
    std::map<double, Kinds> drives;  // by pack voltage
    const auto make = [&](const model::Battery& part, int quantity, Entry<BatteryCorner>& entry) {
      const double pack_v = part.nominal_voltage_v;
      const auto [kinds, fresh] = drives.try_emplace(pack_v, ~Kinds{0});
      if (fresh && plan_->configuration == Configuration::kCompressor)
        kinds->second =
            voltages_.Where([&](double pump_v) { return model::VoltageMatches(pack_v, pump_v); });
      BatteryCorner& corner = entry.item.corner;
      corner = CornerOf<BatteryCorner>(problem_, entry.item.option.amounts);
      corner.voltages = kinds->second;
      corner.energy_j = quantity * model::UsableEnergy(part.capacity_ah, pack_v);
      corner.current_max_a = quantity * part.current_max_a;
      corner.voltage_v = pack_v;
      if (plan_->configuration == Configuration::kCompressor) entry.mates = Bytes({pack_v});
      entry.losses = {-corner.energy_j, -corner.current_max_a, -pack_v};
    };
    const int most = problem_.limits.batteries;
    const auto& parts = problem_.parts.batteries;
    return PlantSlot(Family::kBattery, -1, static_cast<long long>(parts.size()) * most,
                     InParallel<BatteryCorner>(parts, most, make), plan_->batteries);
  }

  const Problem& problem_;
  std::unique_ptr<Plan> plan_;
  KindsOf<double> voltages_;  // of compressors
  BigCount total_, priced_, kept_;
  mutable double gas_kg_ = 0.0;
};

}  // namespace

bool Plan::empty() const {
  return std::any_of(slots.begin(), slots.end(),
                     [](const Slot& slot) { return slot.nodes->empty(); });
}

double GasLeft(const Problem& problem, Configuration configuration, double inlet_pa) {
  const double compressibility =
      configuration == Configuration::kCylinder ? model::CompressibilityOfAir(inlet_pa) : 1.0;
  return model::StandardVolume(inlet_pa / compressibility, problem.ambient.temperature_k);
}

std::unique_ptr<Plan> MakePlan(const Problem& problem, Configuration configuration) {
  return Planter(problem, configuration).Plant();
}

}  // namespace plenum::optimizer
