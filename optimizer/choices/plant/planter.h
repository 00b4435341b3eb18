// Makes a plan: parts become choices with corners, slot by slot. Internal to make_plan.cc and
// choose_battery.cc, choose_bottle.cc, choose_compressor.cc, choose_fitting.cc,
// choose_regulator.cc, choose_reservoir.cc, choose_tubing.cc and choose_valve.cc, which say how the
// parts of a family combine.
#ifndef PLENUM_OPTIMIZER_CHOICES_PLANT_PLANTER_H_
#define PLENUM_OPTIMIZER_CHOICES_PLANT_PLANTER_H_

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/physics/storage.h"
#include "optimizer/choices/dominance.h"
#include "optimizer/choices/plan.h"
#include "optimizer/choices/plant/compared.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/kind.h"
#include "optimizer/pump/pump_slope.h"

namespace plenum::optimizer {

inline constexpr double kJoulePerWattHour = 3600.0;

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
inline double EnergyWeight(const Problem& problem) {
  return problem.objective.energy_wh / kJoulePerWattHour;
}

// The choices of a family and what dominance compares; PlantSlot adds what holds for all.
template <typename Corner>
struct Entry {
  Item<Corner>& item;
  Contender& contender;
};
template <typename Corner>
struct Entries {
  std::vector<Item<Corner>> items;
  std::vector<Contender> contenders;
  MatingClasses classes;

  void Reserve(std::size_t size) {
    items.reserve(size);
    contenders.reserve(size);
  }
  Entry<Corner> Add() { return {items.emplace_back(), contenders.emplace_back()}; }
};

// What of a line's parts must mate with what.
struct LineMates {
  bool fittings = false;  // without them nothing has to
  KindsOf<double> diameters;
  KindsOf<std::string> threads;  // of fittings
};

template <typename Corner>
void SetShare(const Problem& problem, const Amounts& amounts, Corner& corner) {
  corner.amounts = amounts;
  corner.objective = ObjectiveOf(problem.objective, amounts);
}

class Planter {
 public:
  Planter(const Problem& problem, Configuration configuration, bool name_left_out,
          const std::function<bool()>& stop)
      : problem_(problem),
        name_left_out_(name_left_out),
        stop_(stop),
        plan_(std::make_unique<Plan>()) {
    plan_->configuration = configuration;
    plan_->equal_flow = LinesMeet();
    may_stay_open_ = MayStayOpen();
    may_close_late_ = MayCloseLate();
    plan_->bottle_range = FindBottleRange();
    plan_->highest_pump_pa = HighestPumpPressure(problem);
    plan_->tie = LargestTie();
    useful_max_pa_ = HighestUseful();
  }

  std::unique_ptr<Plan> Plant() {
    const std::size_t groups = problem_.groups.size();
    plan_->groups.resize(groups);
    plan_->slots.reserve(kSlotsPerGroup * groups + 3);
    total_ = priced_ = kept_ = 1;
    for (int g = 0; g < static_cast<int>(groups) && !stopped(); ++g) PlantGroup(g);
    if (stopped()) return nullptr;
    if (IsPumped(plan_->configuration)) {
      plan_->compressor_slot = PlantCompressors();
      if (KeepsReservoir(plan_->configuration)) plan_->reservoir_slot = PlantReservoirs();
    } else {
      plan_->regulator_slot = PlantRegulators();
      if (plan_->configuration == Configuration::kCylinder) plan_->bottle_slot = PlantCylinders();
      if (plan_->configuration == Configuration::kCo2) plan_->bottle_slot = PlantCo2();
      if (plan_->configuration == Configuration::kTank) plan_->bottle_slot = PlantTanks();
    }
    if (plan_->configuration != Configuration::kMains) plan_->battery_slot = PlantBatteries();
    if (stopped()) return nullptr;
    plan_->combinations = total_;
    plan_->unpriced = total_ - priced_;
    plan_->dominated = priced_ - kept_;
    return std::move(plan_);
  }

 private:
  bool stopped() const { return stop_ && stop_(); }

  // A faster line is only sure to be no worse for the other groups where no two strokes take air at
  // the same time, as they never do of pumps without a reservoir, and for a pump only where more
  // pressure costs more energy per air.
  bool LinesMeet() const {
    if (!IsPumped(plan_->configuration)) return WindowsOverlap(problem_);
    if (KeepsReservoir(plan_->configuration) && MeetingOf(problem_) != Meeting::kAlone) return true;
    return !std::all_of(PumpsOf(problem_).begin(), PumpsOf(problem_).end(),
                        [&](const model::Compressor& c) {
                          return EnergyPerAirRises(c.curve, problem_.ambient.pressure_pa,
                                                   model::HighestPressure(c.curve));
                        });
  }

  // Whether a valve that cannot hold may be chosen, whose actuators take the more air the more
  // flows while it is open; the mains have enough of it.
  bool MayStayOpen() const {
    return plan_->configuration != Configuration::kMains &&
           std::any_of(problem_.parts.valves.begin(), problem_.parts.valves.end(),
                       [](const model::Valve& valve) { return !model::Holds(valve.kind); });
  }
  // Whether more flow may make a peak too high, where more of a valve's is weighed with its time.
  bool MayCloseLate() const {
    return !IsDirect(plan_->configuration) &&
           std::any_of(problem_.parts.valves.begin(), problem_.parts.valves.end(),
                       [](const model::Valve& valve) {
                         return model::Holds(valve.kind) && valve.closing_scatter_s > 0.0;
                       });
  }
  EqualFlow EqualFlowOf(Family family, int part) const {
    if (family == Family::kFitting && may_close_late_) return EqualFlow::kAlways;
    const bool closes = family == Family::kValve && model::Holds(problem_.parts.valves[part].kind);
    if (may_stay_open_ && !closes) return EqualFlow::kAlways;
    if (plan_->equal_flow) return EqualFlow::kShared;
    return may_stay_open_ ? EqualFlow::kPadded : EqualFlow::kNever;
  }

  // No source gives more: ratings beyond it are all the same.
  double HighestUseful() const {
    double highest_pa = plan_->highest_pump_pa;
    if (!IsPumped(plan_->configuration)) {
      highest_pa = 0.0;
      for (const model::Regulator& regulator : problem_.parts.regulators)
        highest_pa = std::max(highest_pa, regulator.outlet_pressure_max_pa);
    }
    if (plan_->configuration == Configuration::kTank)
      highest_pa = std::max(highest_pa, HighestTankPa(problem_));
    return std::min(problem_.source_pressure_max_pa, highest_pa);
  }

  BottleRange FindBottleRange() const {
    BottleRange range{problem_.ambient.pressure_pa, problem_.ambient.pressure_pa};
    double outlet_pa = range.low_pa;
    for (const model::Regulator& regulator : problem_.parts.regulators) {
      outlet_pa = std::max(outlet_pa, regulator.outlet_pressure_max_pa);
      range.high_pa = std::max(range.high_pa, regulator.inlet_pressure_min_pa);
    }
    range.high_pa = std::max(range.high_pa, std::min(outlet_pa, problem_.source_pressure_max_pa));
    if (plan_->configuration == Configuration::kTank)
      range.high_pa = std::max(range.high_pa, HighestTankPa(problem_));
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
    add(PumpsOf(problem_), problem_.limits.compressors);
    add(parts.batteries, problem_.limits.batteries);
    add(parts.reservoirs, problem_.limits.reservoirs);
    add(parts.tanks, problem_.limits.reservoirs);
    add(parts.manifolds, LineCount(problem_) + 32);  // of pumps, bottles and reservoirs
    for (const model::Cylinder& c : parts.cylinders)
      gas_kg_ = std::max(gas_kg_, model::CylinderCharge(c.water_volume_m3, c.fill_pressure_pa,
                                                        problem_.ambient.temperature_k));
    for (const model::Co2Bottle& bottle : parts.co2)
      gas_kg_ = std::max(gas_kg_, bottle.co2_mass_kg);
    for (int i = 0; i < static_cast<int>(parts.tanks.size()); ++i)
      gas_kg_ = std::max(gas_kg_,
                         model::TankCharge(parts.tanks[i].volume_m3, parts.tanks[i].pressure_max_pa,
                                           problem_.ambient.temperature_k));
    sum += problem_.objective.mass_kg * gas_kg_ *
           std::max({problem_.limits.cylinders, problem_.limits.co2, problem_.limits.reservoirs});
    sum += ObjectiveOf(problem_.objective, CustomReservoir(problem_, model::kMadeReservoirLargestM3,
                                                           CustomRatingPa(problem_)));
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
    for (const model::Regulator& regulator : problem_.parts.regulators)
      regulator_w = std::max(regulator_w, regulator.electrical_power_w);
    return problem_.actuations / problem_.frequency_hz *
           (LineCount(problem_) * power_w + regulator_w);
  }

  // Leaves out what is dominated, plants the rest and adds the slot; returns its number.
  template <typename Corner>
  int PlantSlot(Family family, int group, long long total, Entries<Corner> entries,
                BoxTree<Corner>& tree) {
    if (stopped()) return -1;
    std::vector<Contender>& contenders = entries.contenders;
    const bool kinds = problem_.list == ListOf::kKinds;
    if (kinds) SetSeries(family, entries);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      Contender& contender = contenders[i];
      Item<Corner>& item = entries.items[i];
      contender.item = {item.option.index, item.option.quantity};
      contender.objective = item.corner.objective + contender.beyond;
      const Amounts& amounts = item.corner.amounts;
      item.tie = contender.tie = TieShareOf(problem_.objective, amounts);
      if (std::isfinite(problem_.mass_max_kg))
        contender.losses.push_back(amounts.mass_kg + amounts.mass_slack_kg);
      if (std::isfinite(problem_.volume_max_l))
        contender.losses.push_back(amounts.volume_m3 + amounts.volume_slack_m3);
      if (std::isfinite(problem_.cost_max_eur)) contender.losses.push_back(amounts.cost_eur);
    }
    const int others = kinds ? OtherSeriesNeeded(problem_, family) : problem_.count;
    Skyband skyband = KeepBest(contenders, others, plan_->tie, name_left_out_, stop_);
    if (stopped()) return -1;
    std::vector<const Item<Corner>*> items;
    items.reserve(skyband.kept.size());
    for (int i : skyband.kept) {
      if (!kinds) entries.items[i].outdone = skyband.outdone[i];
      items.push_back(&entries.items[i]);
    }
    tree = MakeBoxTree(items);
    plan_->slots.push_back(
        {family, group, &tree.nodes, &tree.options, std::move(skyband.left_out)});
    total_ *= total;
    priced_ *= static_cast<long long>(contenders.size());
    kept_ *= static_cast<long long>(items.size());
    return static_cast<int>(plan_->slots.size()) - 1;
  }

  // A part that has nothing to do with the kind is of the same series as all others.
  template <typename Corner>
  void SetSeries(Family family, Entries<Corner>& entries) const {
    std::vector<int> series;
    if (SpecOf(family).kind_role != KindRole::kApart) series = SeriesOf(problem_.parts, family);
    for (std::size_t i = 0; i < entries.items.size(); ++i) {
      const int part = entries.items[i].option.index;
      const bool none = part == kNone && !series.empty();
      entries.items[i].series = none ? kNoPart : series.empty() ? 0 : series[part];
      entries.contenders[i].series = none ? -1 : entries.items[i].series;
    }
  }

  bool Priced(const model::PartBasics& basics) const {
    return !PricesNeeded(problem_) || basics.cost_eur.has_value();
  }

  // How many pieces a choice has: those that weigh and cost, and those whose numbers count; and
  // what joins them.
  struct Count {
    double bought, counted;
    Amounts joint = {};
  };

  // Each part of the family × 1…the most that may stand in parallel that has the price it needs.
  // `count(part, quantity)`; `rule(part, quantity, entry)` adds what the table does not say.
  // `mates`: fields of Use::kMate count.
  template <typename Corner, typename CountOf, typename Rule>
  Entries<Corner> MakeEntries(Family family, bool mates, const CountOf& count,
                              const Rule& rule) const {
    constexpr int kBetweenLooks = 256;
    const FamilySpec& spec = SpecOf(family);
    const int most = QuantityMax(problem_, family);
    const int size = FamilySize(problem_.parts, family);
    Entries<Corner> entries;
    entries.Reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(most) + 1);
    for (int i = 0; i < size; ++i) {
      if (i % kBetweenLooks == 0 && stopped()) break;
      const model::PartBasics& basics = spec.basics(problem_.parts, i);
      if (!Priced(basics)) continue;
      for (int quantity = 1; quantity <= most; ++quantity) {
        const Entry<Corner> entry = entries.Add();
        const Count pieces = count(i, quantity);
        entry.item.option = {i, quantity, pieces.bought * basics};
        entry.item.option.amounts += pieces.joint;
        SetShare(problem_, entry.item.option.amounts, entry.item.corner);
        const PartNumbers numbers{problem_.parts, i, pieces.counted, useful_max_pa_};
        SetNumbers(numbers, entry.item.corner);
        entry.contender.id = basics.id;
        entry.contender.mates = entries.classes.Of(numbers, spec.fields, mates);
        AddLosses(numbers, spec.fields, EqualFlowOf(family, i), entry.contender.losses);
        rule(i, quantity, entry);
      }
    }
    return entries;
  }
  // The same of a family of the source.
  template <typename Corner, typename Rule>
  Entries<Corner> MakeSourceEntries(Family family, const Rule& rule) const {
    return MakeEntries<Corner>(
        family, true,
        [&](int part, int quantity) {
          const double pieces = quantity;
          return Count{pieces, pieces,
                       JointAmounts(problem_, JointOfPieces(problem_, family, part, quantity))};
        },
        rule);
  }
  // How many choices that makes, were there a price for each.
  long long ChoicesOf(Family family) const {
    return static_cast<long long>(FamilySize(problem_.parts, family)) *
           QuantityMax(problem_, family);
  }

  void PlantGroup(int g);
  void PlantTubing(int g, const LineMates& mates);
  void PlantFittings(int g, LineMates& mates);
  void PlantValves(int g, const LineMates& mates);

  // `full_m3`: gas down to an inlet pressure of nothing; `water_m3`: what holds gas back.
  void SetBottle(double gas_kg, double full_m3, double water_m3,
                 const Entry<BottleCorner>& entry) const;
  void AddMadeReservoir(int mates, const Entry<ReservoirCorner>& entry) const;

  // Each returns the number of its slot.
  int PlantRegulators();
  int PlantCylinders();
  int PlantCo2();
  int PlantTanks();
  int PlantCompressors();
  int PlantReservoirs();
  int PlantBatteries();

  const Problem& problem_;
  bool name_left_out_;
  const std::function<bool()>& stop_;
  std::unique_ptr<Plan> plan_;
  double useful_max_pa_ = kUnlimited;
  bool may_stay_open_ = false, may_close_late_ = false;
  KindsOf<double> voltages_;  // of compressors
  BigCount total_, priced_, kept_;
  mutable double gas_kg_ = 0.0;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_PLANTER_H_
