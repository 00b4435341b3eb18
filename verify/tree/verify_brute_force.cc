#include "verify/tree/verify_brute_force.h"

#include <map>
#include <optional>
#include <set>

#include "model/physics/storage.h"
#include "verify/design/verify_choice.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_size.h"
#include "verify/tree/verify_box.h"

namespace plenum::verify {
namespace {

// A combination is feasible or not only if that holds with this to spare.
constexpr double kToSpare = 1e-6;
constexpr long long kReportEvery = 1 << 16;  // combinations

// Sums of parts are exact; where settings count they are sought in two ways that agree to this.
double ObjectiveTolerance(const Problem& problem, const Assembly& assembly) {
  const bool settings =
      assembly.tank || (assembly.pump() && !assembly.reservoir && !assembly.direct());
  return problem.objective.energy_wh > 0.0 ? 1e-4 : settings ? 1e-5 : kSumTolerance;
}

ProofPlan AllOf(const Problem& problem, const Layout& layout) {
  ProofPlan plan = EmptyPlan(problem, layout);
  for (ProofSlot& slot : plan.slots) slot.choices = EntriesOf(problem, layout, slot);
  return plan;
}

class Enumeration {
 public:
  Enumeration(const Problem& problem, const Answer& answer, const BruteForceOptions& options,
              Findings& findings)
      : problem_(problem),
        answer_(answer),
        options_(options),
        claims_(problem, answer),
        findings_(findings),
        sizer_(problem, options.stop) {
    enough_ = claims_.all().enough();
    if (!answer.designs.empty())
      enough_ = std::max(enough_, answer.designs.back().objective * (1.0 + TieOf(problem)));
    for (std::size_t i = 0; i < answer.designs.size(); ++i)
      listed_[{answer.designs[i].configuration, IdsOf(answer.designs[i])}] = i;
  }

  BruteForceCounts Run() {
    for (const Layout& layout : LayoutsOf(problem_)) {
      const ProofPlan plan = AllOf(problem_, layout);
      BigCount priced = 1;
      for (const ProofSlot& slot : plan.slots) priced *= slot.choices.size();
      counts_.unpriced += Combinations(problem_, layout) - priced;
      series_.emplace(problem_, plan);
      single_.assign(plan.slots.size(), {0, 0});
      amounts_.clear();
      for (const ProofSlot& slot : plan.slots) {
        amounts_.emplace_back();
        for (const ProofItem& item : slot.choices)
          amounts_.back().push_back(ChoiceAmounts(problem_, layout, slot, item));
      }
      From(0, {});
    }
    counts_.combinations = counts_.incompatible + counts_.unpriced + counts_.beyond +
                           counts_.infeasible + counts_.feasible + counts_.undecided;
    if (!counts_.cancelled) Compare();
    return counts_;
  }

 private:
  const ProofPlan& plan() const { return series_->plan(); }

  // Every choice of this slot and the ones behind it.
  void From(std::size_t slot, const ItemAmounts& before) {
    if (slot == single_.size()) {
      Look(before);
      return;
    }
    BigCount behind = 1;
    for (std::size_t s = slot + 1; s < single_.size(); ++s)
      behind *= plan().slots[s].choices.size();
    const int choices = static_cast<int>(plan().slots[slot].choices.size());
    for (int i = 0; i < choices && !counts_.cancelled; ++i) {
      single_[slot] = {i, i + 1};
      if (!FitsUpTo(slot)) {
        counts_.incompatible += behind;
        continue;
      }
      ItemAmounts sum = before;
      From(slot + 1, sum += amounts_[slot][i]);
    }
  }

  const ProofItem& ItemAt(std::size_t slot) const {
    return plan().slots[slot].choices[single_[slot].first];
  }

  // Whether the choice of a slot fits those before it: plans have valves before fittings before
  // tubes, regulators before bottles, compressors before batteries.
  bool FitsUpTo(std::size_t slot) const {
    const model::Parts& parts = problem_.parts;
    const int part = ItemAt(slot).part;
    Assembly source;
    source.configuration = plan().configuration;
    const int group = plan().slots[slot].group;
    const auto part_of = [&](Family family) {
      return ItemAt(static_cast<std::size_t>(SlotOf(plan(), family, group))).part;
    };
    switch (plan().slots[slot].family) {
      case Family::kFitting:
        return part < 0 || Fit(parts.fittings[part], parts.valves[part_of(Family::kValve)]);
      case Family::kTubing: {
        const int fitting = part_of(Family::kFitting);
        return fitting < 0 || Fit(parts.tubing[part], parts.fittings[fitting]);
      }
      case Family::kRegulator:
        if (plan().configuration == Configuration::kCylinder) return true;  // asked with the bottle
        if (HasTank(plan().configuration)) return true;
        source.regulators = {&parts.regulators[part]};
        if (plan().configuration == Configuration::kCo2 && !parts.co2.empty())
          source.co2 = &parts.co2.front();
        return Fit(problem_, source);
      case Family::kCylinder:
        for (const ProofSlot& chosen : plan().slots) {
          if (chosen.family != Family::kRegulator) continue;
          const auto at = static_cast<std::size_t>(&chosen - plan().slots.data());
          source.regulators.push_back(&parts.regulators[ItemAt(at).part]);
        }
        source.cylinder = &parts.cylinders[part];
        return Fit(problem_, source);
      case Family::kBattery:
        source.battery = &parts.batteries[part];
        if (PumpsRail(problem_)) {
          source.rail.pump = &parts.vacuum_pumps[part_of(Family::kVacuumPump)];
          return model::VoltageMatches(source.battery->nominal_voltage_v,
                                       source.rail.pump->curve.voltage_v);
        }
        if (!HasPump(plan().configuration)) return true;
        source.compressor =
            &PumpsOf(problem_, plan().configuration)[part_of(PumpFamily(plan().configuration))];
        return Fit(problem_, source);
      default:
        return true;
    }
  }

  void Look(const ItemAmounts& sum) {
    if (++looked_ % kReportEvery == 0) Report();
    if (sum.objective > enough_ * (1.0 + kSumTolerance)) {
      counts_.beyond += 1;
      return;
    }
    if (TooMuch(problem_, sum, kToSpare)) {
      counts_.infeasible += 1;
      return;
    }
    if (++sized_ % 64 == 0) Report();
    const Assembly assembly = AssemblyAt(problem_, plan(), single_);
    const Sizing surely = sizer_.Size(assembly, -kToSpare, enough_);
    if (surely.status == Sized::kUnknown && surely.lower_bound > enough_) {
      counts_.beyond += 1;
      return;
    }
    if (surely.status == Sized::kFeasible) {
      counts_.feasible += 1;
      Judge(assembly, surely.objective, true);
      return;
    }
    const Sizing perhaps = sizer_.Size(assembly, kToSpare, enough_);
    (perhaps.status == Sized::kInfeasible ? counts_.infeasible : counts_.undecided) += 1;
    if (perhaps.status == Sized::kFeasible) Judge(assembly, perhaps.objective, false);
    if (perhaps.status == Sized::kUnknown) Judge(assembly, kUnlimited, false);
  }

  // Where a requirement binds steeply what is kept with something to spare costs more than what is
  // kept with nothing: an objective may lie between that and what it comes to perhaps.
  bool IsWithin(const Assembly& assembly, double given, double surely, double tolerance) {
    if (given > surely) return false;
    const Sizing perhaps = sizer_.Size(assembly, kToSpare, surely);
    return perhaps.status == Sized::kFeasible && given * (1.0 + tolerance) >= perhaps.objective;
  }

  // A combination that is surely or perhaps feasible.
  void Judge(const Assembly& assembly, double objective, bool surely) {
    const Ids ids = EarliestIds(problem_, plan(), single_);
    const double tolerance = ObjectiveTolerance(problem_, assembly);
    const auto rank = listed_.find({plan().configuration, ids});
    if (rank != listed_.end()) {
      seen_.insert(rank->second);
      const double given = answer_.designs[rank->second].objective;
      if (std::isfinite(objective) && !Near(given, objective, tolerance) &&
          !(surely && IsWithin(assembly, given, objective, tolerance)))
        Add("rank " + std::to_string(rank->second + 1) + " comes to " + std::to_string(objective) +
            ", not " + std::to_string(given));
      return;
    }
    TieKey key{{}, ids};
    double counted_eur = 0.0;
    for (std::size_t s = 0; s < single_.size(); ++s) {
      const ItemAmounts& amounts = amounts_[s][single_[s].first];
      counted_eur += amounts.cost_eur;
      key.share += ShareOfTies(problem_, amounts);
    }
    if (HasPacks(problem_))
      key.share +=
          SurplusOfTies(problem_, TotalsOf(problem_, assembly, {}).cost_known_eur, counted_eur);
    const Claim& claim = series_->ClaimOn(claims_, single_);
    // The end of the ties has room for rounding of its own.
    const bool past_ties = objective * (1.0 + tolerance - kSumTolerance) > claim.tie_end;
    const bool worse =
        objective * (1.0 + tolerance) >= claim.least && (past_ties || key > claim.last);
    if (!surely || worse) return;
    Add("a " + std::string(Name(plan().configuration)) + " design that is not listed comes to " +
        std::to_string(objective) + ": " + Text(ids));
  }

  void Report() {
    counts_.cancelled = counts_.cancelled || Stopped(options_.stop);
    if (options_.progress)
      options_.progress(counts_.incompatible + counts_.unpriced + counts_.beyond +
                        counts_.infeasible + counts_.feasible + counts_.undecided);
  }

  void Compare() {
    for (std::size_t i = 0; i < answer_.designs.size(); ++i)
      if (!seen_.contains(i))
        Add("rank " + std::to_string(i + 1) + " is no combination that meets the requirements");
    const Proof& proof = answer_.proof;
    const auto differ = [&](const char* what, const BigCount& given, const BigCount& counted) {
      Add(std::string(what) + " is given as " + given.str() + ", counted " + counted.str());
    };
    if (proof.combinations != counts_.combinations)
      differ("combinations", proof.combinations, counts_.combinations);
    if (proof.pruned.unpriced != counts_.unpriced)
      differ("unpriced", proof.pruned.unpriced, counts_.unpriced);
    // Boxes closed as incompatible or infeasible hold nothing else.
    if (proof.pruned.incompatible > counts_.incompatible)
      differ("incompatible", proof.pruned.incompatible, counts_.incompatible);
    const BigCount not_feasible = counts_.combinations - counts_.unpriced - counts_.feasible;
    if (proof.pruned.incompatible + proof.pruned.infeasible > not_feasible)
      differ("infeasible", proof.pruned.infeasible, not_feasible - proof.pruned.incompatible);
    if (answer_.status == Status::kInfeasible && counts_.feasible > 0)
      Add("infeasible, but " + counts_.feasible.str() + " combinations meet the requirements");
  }

  void Add(std::string detail) { findings_.push_back({"brute_force", std::move(detail)}); }

  const Problem& problem_;
  const Answer& answer_;
  const BruteForceOptions& options_;
  const Claims claims_;
  double enough_;  // parts that come to more are beyond the list
  Findings& findings_;
  std::map<std::pair<Configuration, Ids>, std::size_t> listed_;
  std::set<std::size_t> seen_;
  std::optional<SeriesOfPlan> series_;
  Ranges single_;
  SlotAmounts amounts_;
  Sizer sizer_;
  BruteForceCounts counts_;
  long long looked_ = 0, sized_ = 0;
};

}  // namespace

BigCount CombinationsOf(const Problem& problem) {
  BigCount sum = 0;
  for (const Layout& layout : LayoutsOf(problem)) sum += Combinations(problem, layout);
  return sum;
}

BruteForceCounts CheckByBruteForce(const Problem& problem, const Answer& answer,
                                   const BruteForceOptions& options, Findings& findings) {
  return Enumeration(problem, answer, options, findings).Run();
}

}  // namespace plenum::verify
