#include "optimizer/evaluate/packs.h"

#include <algorithm>
#include <cmath>

#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

bool IsSold(const model::PartBasics& basics) { return basics.pack > 0.0 && basics.cost_eur; }

// A part of a design, all its rows together.
struct Need {
  Family family;
  int part;
  double quantity;
};

class Needs {
 public:
  void Add(Family family, int part, double quantity) {
    if (part < 0) return;
    const auto same = std::find_if(list_.begin(), list_.end(), [&](const Need& need) {
      return need.family == family && need.part == part;
    });
    if (same == list_.end())
      list_.push_back({family, part, quantity});
    else
      same->quantity += quantity;
  }
  void Add(const Problem& problem, const Choice& row) {
    Add(row.family, FindPart(problem.parts, row.family, row.id), row.quantity);
  }
  double Of(const Problem& problem, const Choice& row) const {
    for (const Need& need : list_)
      if (need.family == row.family && BasicsOf(problem.parts, need.family, need.part).id == row.id)
        return need.quantity;
    return 0.0;
  }
  const std::vector<Need>& list() const { return list_; }

 private:
  std::vector<Need> list_;
};

Needs AllOf(const Problem& problem, const std::vector<Choice>& rows) {
  Needs needs;
  for (const Choice& row : rows) needs.Add(problem, row);
  return needs;
}

}  // namespace

PackRange& PackRange::operator+=(const PackRange& other) {
  more_eur += other.more_eur;
  less_eur += other.less_eur;
  return *this;
}

PackRange RangeOf(double quantity, const model::PartBasics& basics) {
  if (!IsSold(basics)) return {};
  const double counted = quantity * *basics.cost_eur;
  const double own = std::floor(quantity / basics.pack) * basics.pack * *basics.cost_eur;
  return {std::max(0.0, PackCost(quantity, basics) - counted), std::max(0.0, counted - own)};
}

double PiecesOf(const Problem& problem, Family family, int g, int part, int quantity) {
  if (g < 0 || !SpecOf(family).in_line) return quantity * FeedsOf(problem, family);
  const ActuatorGroup& group = problem.groups[g];
  if (family == Family::kTubing) return group.count * group.tube_length_m;
  if (family == Family::kFitting) return group.count * group.fittings_per_line;
  const int channels = problem.parts.valves[part].channels;
  const int valves = (group.count + channels - 1) / channels;
  return valves;
}

bool AnySharedPacks(const Problem& problem) {
  for (const FamilySpec& spec : Families()) {
    const bool regulators = spec.family == Family::kRegulator;
    if (!spec.joins && !((spec.in_line || regulators) && problem.groups.size() > 1)) continue;
    for (int part = 0; part < FamilySize(problem.parts, spec.family); ++part)
      if (IsSold(spec.basics(problem.parts, part))) return true;
  }
  return false;
}

double PackSurplus(const Problem& problem, const std::vector<Choice>& rows) {
  Needs shared;
  for (const Choice& row : rows)
    if (!SpecOf(row.family).joins && SharesPacks(problem, row.group)) shared.Add(problem, row);
  for (const Joint& joint : JointsOf(problem, rows))
    shared.Add(joint.family, joint.part, joint.quantity);
  double surplus_eur = 0.0;
  for (const Need& need : shared.list())
    surplus_eur += RangeOf(need.quantity, BasicsOf(problem.parts, need.family, need.part)).more_eur;
  return surplus_eur;
}

void SetCosts(const Problem& problem, std::vector<Choice>& rows) {
  const Needs needs = AllOf(problem, rows);
  for (Choice& row : rows) {
    const int part = FindPart(problem.parts, row.family, row.id);
    if (part < 0) continue;
    const model::PartBasics& basics = BasicsOf(problem.parts, row.family, part);
    const double all = needs.Of(problem, row);
    if (basics.cost_eur)
      row.cost_eur = all > 0.0 ? PackCost(all, basics) * (row.quantity / all) : 0.0;
  }
}

std::vector<PackRow> PacksOf(const Problem& problem, const std::vector<Choice>& rows) {
  const Needs needs = AllOf(problem, rows);
  std::vector<PackRow> packs;
  for (const Need& need : needs.list()) {
    const model::PartBasics& basics = BasicsOf(problem.parts, need.family, need.part);
    if (!IsSold(basics)) continue;
    packs.push_back({need.family, basics.id, need.quantity, basics.pack,
                     PacksFor(need.quantity, basics), PackCost(need.quantity, basics)});
  }
  return packs;
}

}  // namespace plenum::optimizer
