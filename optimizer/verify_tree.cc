#include "optimizer/verify_tree.h"

#include <map>
#include <set>

#include "optimizer/verify_dominance.h"

namespace plenum::optimizer {
namespace {

std::string In(const ProofPlan& plan) { return std::string(" (") + Name(plan.configuration) + ")"; }

using Key = std::pair<int, int>;
Key KeyOf(const ProofItem& item) { return {item.part, item.part == -1 ? 0 : item.quantity}; }

void CheckSlot(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
               const std::vector<ProofItem>& entries, Findings& findings) {
  const std::string where = std::string(Name(slot.family)) + In(plan);
  std::multiset<Key> expected, found;
  for (const ProofItem& item : entries) expected.insert(KeyOf(item));
  std::set<Key> choices;
  for (const ProofItem& item : slot.choices) {
    found.insert(KeyOf(item));
    choices.insert(KeyOf(item));
  }
  for (const ProofDominated& dominated : slot.dominated) found.insert(KeyOf(dominated.item));
  if (found != expected) {
    findings.push_back({"choices", where + ": the choices and those left out are not the family"});
    return;
  }
  for (const ProofDominated& dominated : slot.dominated) {
    std::set<Key> different;
    for (const ProofItem& dominator : dominated.dominators) {
      different.insert(KeyOf(dominator));
      if (!choices.contains(KeyOf(dominator)) ||
          !Dominates(problem, plan, slot, dominator, dominated.item))
        findings.push_back({"dominance", where + ": a choice left out is not dominated"});
    }
    if (static_cast<int>(different.size()) < problem.count)
      findings.push_back({"dominance", where + ": a choice left out has too few dominators"});
  }
}

class Walk {
 public:
  Walk(const ProofPlan& plan, Findings& findings) : plan_(plan), findings_(findings) {}

  std::vector<ClosedBox> Run() {
    Ranges all;
    for (const ProofSlot& slot : plan_.slots)
      all.emplace_back(0, static_cast<int>(slot.choices.size()));
    std::vector<Ranges> open{all};
    for (const ProofBox& box : plan_.boxes) {
      if (open.empty()) return Fail("more boxes than the tree has");
      const Ranges ranges = std::move(open.back());
      open.pop_back();
      if (box.kind != BoxKind::kSplit) {
        closed_.push_back({box, ranges});
        continue;
      }
      if (box.slot < 0 || box.slot >= static_cast<int>(ranges.size()))
        return Fail("a split of a slot that is not there");
      const auto [first, last] = ranges[box.slot];
      if (box.middle <= first || box.middle >= last) return Fail("a split outside its box");
      Ranges left = ranges, right = ranges;
      left[box.slot].second = right[box.slot].first = box.middle;
      open.push_back(std::move(right));
      open.push_back(std::move(left));
    }
    if (!open.empty()) return Fail("boxes are missing");
    return std::move(closed_);
  }

 private:
  std::vector<ClosedBox> Fail(const std::string& why) {
    findings_.push_back({"boxes", why + In(plan_)});
    return {};
  }

  const ProofPlan& plan_;
  Findings& findings_;
  std::vector<ClosedBox> closed_;
};

}  // namespace

std::vector<ProofItem> EntriesOf(const Problem& problem, const ProofSlot& slot) {
  if (slot.family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
    return {{-1, 0}};
  const bool cost = problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
  std::vector<ProofItem> entries;
  for (int part = 0; part < FamilySize(problem, slot.family); ++part)
    for (int quantity = 1; quantity <= QuantityMax(problem, slot.family); ++quantity)
      if (!cost || BasicsOf(problem, slot.family, part)->cost_eur)
        entries.push_back({part, quantity});
  if (slot.family == Family::kReservoir && MadeReservoirAllowed(problem) && !cost)
    entries.push_back({-2, 1});
  return entries;
}

BigCount CountOf(const Ranges& ranges) {
  BigCount count = 1;
  for (const auto& [first, last] : ranges) count *= last - first;
  return count;
}

std::vector<ClosedBox> Replay(const ProofPlan& plan, Findings& findings) {
  return Walk(plan, findings).Run();
}

const model::PartBasics* BasicsOf(const Problem& problem, Family family, int part) {
  const model::Parts& parts = problem.parts;
  switch (family) {
    case Family::kTubing:
      return &parts.tubing[part].per_metre;
    case Family::kFitting:
      return &parts.fittings[part].basics;
    case Family::kValve:
      return &parts.valves[part].basics;
    case Family::kCompressor:
      return &parts.compressors[part].basics;
    case Family::kCylinder:
      return &parts.cylinders[part].basics;
    case Family::kCo2:
      return &parts.co2[part].basics;
    case Family::kBattery:
      return &parts.batteries[part].basics;
    case Family::kRegulator:
      return &parts.regulators[part].basics;
    case Family::kReservoir:
      return &parts.reservoirs[part].basics;
  }
  return nullptr;
}

int FamilySize(const Problem& problem, Family family) {
  const model::Parts& parts = problem.parts;
  const std::map<Family, std::size_t> sizes{
      {Family::kTubing, parts.tubing.size()},       {Family::kFitting, parts.fittings.size()},
      {Family::kValve, parts.valves.size()},        {Family::kCompressor, parts.compressors.size()},
      {Family::kCylinder, parts.cylinders.size()},  {Family::kCo2, parts.co2.size()},
      {Family::kBattery, parts.batteries.size()},   {Family::kRegulator, parts.regulators.size()},
      {Family::kReservoir, parts.reservoirs.size()}};
  return static_cast<int>(sizes.at(family));
}

int QuantityMax(const Problem& problem, Family family) {
  switch (family) {
    case Family::kCompressor:
      return problem.limits.compressors;
    case Family::kBattery:
      return problem.limits.batteries;
    case Family::kCylinder:
      return problem.limits.cylinders;
    case Family::kCo2:
      return problem.limits.co2;
    case Family::kReservoir:
      return problem.limits.reservoirs;
    default:
      return 1;
  }
}

std::vector<Family> SourceFamilies(Configuration configuration) {
  switch (configuration) {
    case Configuration::kCylinder:
      return {Family::kRegulator, Family::kCylinder, Family::kBattery};
    case Configuration::kCo2:
      return {Family::kRegulator, Family::kCo2, Family::kBattery};
    case Configuration::kCompressor:
      return {Family::kCompressor, Family::kReservoir, Family::kBattery};
    case Configuration::kMains:
      return {Family::kRegulator};
  }
  return {};
}

bool MadeReservoirAllowed(const Problem& problem) {
  const auto required = problem.require.find(Family::kReservoir);
  return !problem.exclude.contains("custom") &&
         (required == problem.require.end() || required->second.contains("custom"));
}

BigCount Combinations(const Problem& problem, Configuration configuration) {
  BigCount count = 1;
  for (const ActuatorGroup& group : problem.groups) {
    count *= FamilySize(problem, Family::kTubing);
    count *= FamilySize(problem, Family::kValve);
    if (group.fittings_per_line > 0) count *= FamilySize(problem, Family::kFitting);
  }
  for (Family family : SourceFamilies(configuration)) {
    const bool made = family == Family::kReservoir && MadeReservoirAllowed(problem);
    count *= FamilySize(problem, family) * QuantityMax(problem, family) + (made ? 1 : 0);
  }
  return count;
}

void CheckSlots(const Problem& problem, const ProofPlan& plan, Pruned& counts, Findings& findings) {
  std::set<std::pair<Family, int>> expected, found;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    for (Family family : {Family::kTubing, Family::kFitting, Family::kValve})
      expected.insert({family, g});
  for (Family family : SourceFamilies(plan.configuration)) expected.insert({family, -1});
  for (const ProofSlot& slot : plan.slots) found.insert({slot.family, slot.group});
  if (found != expected || found.size() != plan.slots.size()) {
    findings.push_back({"choices", "the slots are not one for each family" + In(plan)});
    return;
  }
  BigCount priced = 1, kept = 1;
  for (const ProofSlot& slot : plan.slots) {
    const std::vector<ProofItem> entries = EntriesOf(problem, slot);
    CheckSlot(problem, plan, slot, entries, findings);
    priced *= entries.size();
    kept *= slot.choices.size();
  }
  counts.unpriced += Combinations(problem, plan.configuration) - priced;
  counts.dominated += priced - kept;
}

}  // namespace plenum::optimizer
