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
#include "optimizer/choices/plant/ranges.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/packs.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/kind.h"
#include "optimizer/problem/pump_feed.h"
#include "optimizer/pump/pump_slope.h"

namespace plenum::optimizer {

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
  std::vector<PackRange> packs;  // of the contenders, where choices share packs; or fewer

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
  Planter(const Problem& problem, const Layout& layout, bool name_left_out,
          const std::function<bool()>& stop)
      : problem_(problem),
        name_left_out_(name_left_out),
        stop_(stop),
        plan_(std::make_unique<Plan>()) {
    plan_->configuration = layout.configuration;
    plan_->own_regulators = layout.own_regulators;
    plan_->equal_flow = LinesMeet();
    plan_->shares_packs = AnySharedPacks(problem);
    may_stay_open_ = MayStayOpen();
    may_close_late_ = MayCloseLate();
    plan_->bottle_range = FindBottleRange(problem, layout.configuration);
    plan_->highest_pump_pa = HighestPumpPressure(problem, plan_->configuration);
    plan_->tie = LargestTie(problem, layout);
    useful_max_pa_ = HighestUseful(problem, layout.configuration, plan_->highest_pump_pa);
  }

  std::unique_ptr<Plan> Plant() {
    const std::size_t groups = problem_.groups.size();
    plan_->groups.resize(groups);
    plan_->slots.reserve((kSlotsPerGroup + 1) * groups + 5);
    total_ = priced_ = kept_ = 1;
    for (int g = 0; g < static_cast<int>(groups) && !stopped(); ++g) PlantGroup(g);
    if (stopped()) return nullptr;
    if (IsPumped(plan_->configuration)) {
      plan_->compressor_slot = PlantPumps(PumpFamily(plan_->configuration), plan_->compressors);
      if (KeepsReservoir(plan_->configuration))
        plan_->reservoir_slot = PlantReservoirs(Family::kReservoir, plan_->reservoirs);
    } else {
      PlantRegulators();
      if (plan_->configuration == Configuration::kCylinder) plan_->bottle_slot = PlantCylinders();
      if (plan_->configuration == Configuration::kCo2) plan_->bottle_slot = PlantCo2();
      if (HasTank(plan_->configuration)) plan_->bottle_slot = PlantTanks();
      if (HasPump(plan_->configuration))
        plan_->compressor_slot = PlantPumps(PumpFamily(plan_->configuration), plan_->compressors);
      if (PumpsRail(problem_)) {
        plan_->rail.pump_slot = PlantPumps(Family::kVacuumPump, plan_->rail.pumps);
        plan_->rail.reservoir_slot =
            PlantReservoirs(Family::kVacuumReservoir, plan_->rail.reservoirs);
      }
    }
    if (plan_->configuration != Configuration::kMains) plan_->battery_slot = PlantBatteries();
    if (stopped()) return nullptr;
    plan_->combinations = total_;
    plan_->pruned.unpriced = total_ - priced_;
    plan_->pruned.dominated = priced_ - kept_;
    return std::move(plan_);
  }

 private:
  bool stopped() const { return stop_ && stop_(); }

  // A faster line is only sure to be no worse for the other groups where no two strokes take air at
  // the same time, as they never do of pumps without a reservoir, and for a pump only where more
  // pressure costs more energy per air, and it does not hold on.
  bool LinesMeet() const {
    if (!IsPumped(plan_->configuration)) return SquadsOverlap();
    if (KeepsReservoir(plan_->configuration) && MeetingOf(problem_) != Meeting::kAlone) return true;
    if (PumpsHoldOn(problem_)) return true;  // what is full sooner is held longer
    const std::vector<model::Compressor>& pumps = PumpsOf(problem_, plan_->configuration);
    return !std::all_of(pumps.begin(), pumps.end(), [&](const model::Compressor& c) {
      return EnergyPerAirRises(c.curve, problem_.ambient.pressure_pa,
                               model::HighestPressure(c.curve));
    });
  }

  // With regulators of their own only squads of one group have a regulator in common.
  bool SquadsOverlap() const {
    return WindowsOverlap(problem_) &&
           (!plan_->own_regulators ||
            std::any_of(problem_.groups.begin(), problem_.groups.end(),
                        [](const ActuatorGroup& group) { return group.gait.phases.size() > 1; }));
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

  // Leaves out what is dominated, plants the rest and adds the slot; returns its number.
  template <typename Corner>
  int PlantSlot(Family family, int group, long long total, Entries<Corner> entries,
                BoxTree<Corner>& tree) {
    if (stopped()) return -1;
    std::vector<Contender>& contenders = entries.contenders;
    if (plan_->shares_packs) entries.packs.resize(contenders.size());
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
    const int others =
        kinds ? OtherSeriesNeeded(problem_, family, plan_->own_regulators) : problem_.count;
    const std::vector<PackEnds> ends = EndsOf(entries);
    Skyband skyband = KeepBest(contenders, others, plan_->tie, name_left_out_, stop_, ends);
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

  // Empty where choices share no packs.
  template <typename Corner>
  std::vector<PackEnds> EndsOf(const Entries<Corner>& entries) const {
    std::vector<PackEnds> ends;
    for (std::size_t i = 0; i < entries.packs.size(); ++i) {
      const auto at = [&](double beyond_eur) {
        Amounts amounts = entries.items[i].corner.amounts;
        amounts.cost_eur += beyond_eur;
        return PackEnd{entries.contenders[i].objective + problem_.objective.cost_eur * beyond_eur,
                       std::isfinite(problem_.cost_max_eur) ? amounts.cost_eur : 0.0,
                       TieShareOf(problem_.objective, amounts)};
      };
      ends.push_back({at(entries.packs[i].more_eur), at(-entries.packs[i].less_eur)});
    }
    return ends;
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
    PackRange joint_packs = {};
  };
  // Whether another choice of a design may have the same part.
  bool Shares(Family family) const {
    const bool of_group =
        SpecOf(family).in_line || (family == Family::kRegulator && plan_->own_regulators);
    return SharesPacks(problem_, of_group ? 0 : -1);
  }

  // Each part of the family × 1…the most that may stand in parallel that has the price it needs.
  // `count(part, quantity)`; `rule(part, quantity, entry)` adds what the table does not say.
  // `mates`: fields of Use::kMate count.
  template <typename Corner, typename CountOf, typename Rule>
  Entries<Corner> MakeEntries(Family family, bool mates, const CountOf& count,
                              const Rule& rule) const {
    constexpr int kBetweenLooks = 256;
    const FamilySpec& spec = SpecOf(family);
    const bool shared = Shares(family);
    const int most = QuantityMax(problem_, family);
    const int size = ChoicesIn(problem_, plan_->configuration, family);
    Entries<Corner> entries;
    entries.Reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(most) + 1);
    for (int i = 0; i < size; ++i) {
      if (i % kBetweenLooks == 0 && stopped()) break;
      const model::PartBasics& basics = spec.basics(problem_.parts, i);
      if (!Priced(basics)) continue;
      for (int quantity = 1; quantity <= most; ++quantity) {
        const Entry<Corner> entry = entries.Add();
        const Count pieces = count(i, quantity);
        entry.item.option = {i, quantity, Counted(pieces.bought, basics, shared)};
        entry.item.option.amounts += pieces.joint;
        SetShare(problem_, entry.item.option.amounts, entry.item.corner);
        const PartNumbers numbers{problem_.parts, i, pieces.counted, useful_max_pa_};
        SetNumbers(numbers, entry.item.corner);
        entry.contender.id = basics.id;
        entry.contender.mates = entries.classes.Of(numbers, spec.fields, mates);
        AddLosses(numbers, spec.fields, EqualFlowOf(family, i), entry.contender.losses);
        if (plan_->shares_packs) {
          entries.packs.push_back(shared ? RangeOf(pieces.bought, basics) : PackRange{});
          entries.packs.back() += pieces.joint_packs;
        }
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
          Count all{pieces * FeedsOf(problem_, family), pieces};
          for (const Joint& joint :
               SourceJoints(problem_, family, part, quantity, plan_->own_regulators)) {
            all.joint += JointAmounts(problem_, joint);
            if (plan_->shares_packs)
              all.joint_packs +=
                  RangeOf(joint.quantity, BasicsOf(problem_.parts, joint.family, joint.part));
          }
          return all;
        },
        rule);
  }
  // How many choices that makes, were there a price for each.
  long long ChoicesOf(Family family) const {
    return static_cast<long long>(ChoicesIn(problem_, plan_->configuration, family)) *
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

  void PlantRegulators();  // one for all, or one for each group
  // Each returns the number of its slot.
  int PlantRegulator(int group, BoxTree<RegulatorCorner>& tree);
  int PlantCylinders();
  int PlantCo2();
  int PlantTanks();
  int PlantPumps(Family family, BoxTree<CompressorCorner>& tree);
  int PlantReservoirs(Family family, BoxTree<ReservoirCorner>& tree);
  int PlantBatteries();

  const Problem& problem_;
  bool name_left_out_;
  const std::function<bool()>& stop_;
  std::unique_ptr<Plan> plan_;
  double useful_max_pa_ = kUnlimited;
  bool may_stay_open_ = false, may_close_late_ = false;
  KindsOf<double> voltages_;  // of pumps
  BigCount total_, priced_, kept_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_PLANTER_H_
