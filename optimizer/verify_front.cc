#include "optimizer/verify_front.h"

#include "optimizer/verify_box.h"
#include "optimizer/verify_dominance.h"
#include "optimizer/verify_record.h"
#include "optimizer/verify_tree.h"

namespace plenum::optimizer {
namespace {

// Resolutions that a front may have: of parts off the shelf, of a reservoir's volume made to
// measure, and where that trades against energy.
constexpr double kExact = 1e-6, kMade = 1e-4, kCurve = 1e-2;
constexpr double kNoLimit = 1e12;  // a limit that only asks for prices

using Point = std::vector<double>;

double AmountOf(Amount amount, const Totals& totals) {
  switch (amount) {
    case Amount::kMass:
      return totals.mass_kg;
    case Amount::kVolume:
      return totals.volume_m3 * 1e3;
    case Amount::kCost:
      return totals.cost_eur.value_or(kUnlimited);
    case Amount::kEnergy:
      return totals.energy_j / 3600.0;
  }
  return kUnlimited;
}

bool NoWorse(const Point& a, const Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i] * (1.0 + kTieTolerance)) return false;
  return true;
}

// The problem of the least of one amount within a limit on the other.
Problem Between(const Problem& problem, const std::vector<Amount>& amounts, double second_max) {
  Problem between = problem;
  const auto limit_of = [&](Amount amount) -> double& {
    return amount == Amount::kMass     ? between.mass_max_kg
           : amount == Amount::kVolume ? between.volume_max_l
                                       : between.cost_max_eur;
  };
  double& second = limit_of(amounts[1]);
  second = std::min(second, second_max);
  for (Amount amount : amounts)
    if (amount == Amount::kCost) limit_of(amount) = std::min(limit_of(amount), kNoLimit);
  between.objective = {};
  (amounts[0] == Amount::kMass     ? between.objective.mass_kg
   : amounts[0] == Amount::kVolume ? between.objective.volume_l
                                   : between.objective.cost_eur) = 1.0;
  return between;
}

// The choices that no other dominates, by their share of the objective.
ProofPlan WholePlan(const Problem& problem, Configuration configuration) {
  ProofPlan plan;
  plan.configuration = configuration;
  plan.equal_flow = FlowMustBeEqual(problem, configuration);
  for (int group = 0; group < static_cast<int>(problem.groups.size()); ++group)
    for (Family family : {Family::kTubing, Family::kFitting, Family::kValve})
      plan.slots.push_back({family, group, {}, {}});
  for (Family family : SourceFamilies(configuration)) plan.slots.push_back({family, -1, {}, {}});
  for (ProofSlot& slot : plan.slots) {
    const std::vector<ProofItem> entries = EntriesOf(problem, slot);
    std::vector<std::pair<double, ProofItem>> kept;
    for (const ProofItem& item : entries)
      if (std::none_of(entries.begin(), entries.end(), [&](const ProofItem& other) {
            return !(other == item) && Dominates(problem, plan, slot, other, item);
          }))
        kept.emplace_back(ChoiceAmounts(problem, slot, item).objective, item);
    std::stable_sort(kept.begin(), kept.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [share, item] : kept) slot.choices.push_back(item);
  }
  return plan;
}

// That no design within the limit on the second amount has less of the first.
void CheckBetween(const Problem& between, double least, Findings& findings, BigCount& open) {
  const Claim claim{least, -kUnlimited, {}};
  for (Configuration configuration : between.configurations) {
    const ProofPlan plan = WholePlan(between, configuration);
    Ranges all;
    bool empty = false;
    for (const ProofSlot& slot : plan.slots) {
      all.emplace_back(0, static_cast<int>(slot.choices.size()));
      empty = empty || slot.choices.empty();
    }
    if (!empty) open += BoxCheck(between, plan, claim).Recheck(all, findings);
  }
}

}  // namespace

void CheckFront(const Problem& problem, const Front& front, Findings& findings,
                std::vector<NotRechecked>& open) {
  const Answer& answer = front.answer;
  std::vector<Amount> amounts = front.amounts;  // the one that has no resolution first
  if (amounts.back() == Amount::kMass) std::swap(amounts.front(), amounts.back());
  std::vector<Point> points;
  for (const Design& design : answer.designs) {
    Point point;
    for (Amount amount : amounts) point.push_back(AmountOf(amount, design.totals));
    points.push_back(std::move(point));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      if (i != j && NoWorse(points[j], points[i]))
        findings.push_back({"front", "rank " + std::to_string(i + 1) + " is no better than rank " +
                                         std::to_string(j + 1)});
  const bool energy = std::find(amounts.begin(), amounts.end(), Amount::kEnergy) != amounts.end();
  const bool made = problem.configurations.contains(Configuration::kCompressor);
  if (front.resolution > (!made ? kExact : energy ? kCurve : kMade))
    findings.push_back({"front", "the resolution hides points"});
  const bool whole = answer.status == Status::kOptimal || answer.status == Status::kInfeasible;
  if (whole != front.unexplored.empty() || whole != answer.proof.complete ||
      whole != (front.searches == front.proved) ||
      (answer.status == Status::kInfeasible) != (whole && points.empty()))
    findings.push_back({"status", std::string(Name(answer.status)) + " is not what was proved"});
  if (!whole || front.amounts.size() != 2 || energy || !findings.empty()) {
    open.push_back(
        {"combinations that are not listed: only a whole front of two amounts of parts "
         "is looked at for what is missing",
         answer.proof.combinations - answer.designs.size()});
    return;
  }
  std::sort(points.begin(), points.end());
  BigCount count = 0;
  double second_max = kUnlimited;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const double least = i < points.size() ? points[i][0] * (1.0 - kTieTolerance) : kUnlimited;
    CheckBetween(Between(problem, amounts, second_max), least, findings, count);
    if (i < points.size())
      second_max = points[i][1] * (1.0 - front.resolution) * (1.0 - kTieTolerance);
  }
  if (count > 0) open.push_back({"combinations that may lie between points", count});
}

}  // namespace plenum::optimizer
