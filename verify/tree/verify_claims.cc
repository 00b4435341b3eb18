#include "verify/tree/verify_claims.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace plenum::verify {
namespace {

// The least that the objective of what ties with a listed design may be.
double BestOfRun(const Problem& problem, double objective) {
  return objective - (1.0 + kSettled) * TieOf(problem) * std::abs(objective);
}

bool Tie(const Problem& problem, double one, double other) {
  return std::min(one, other) >= BestOfRun(problem, std::max(one, other));
}

// The run of ties that the last design of a full list is in goes by mass, cost and ids.
Claim OnAll(const Problem& problem, const Answer& answer) {
  if (!answer.proof.complete)
    return {answer.proof.lower_bound * (1.0 - kSumTolerance), -kUnlimited, {}};
  if (static_cast<int>(answer.designs.size()) < problem.count) return {kUnlimited, -kUnlimited, {}};
  // The worst of the run of ties that the last one is in.
  double last = -kUnlimited;
  for (std::size_t i = answer.designs.size(); i-- > 0;) {
    const double objective = answer.designs[i].objective;
    if (std::isfinite(last) && !Tie(problem, objective, last)) break;
    last = std::max(last, objective);
  }
  return {BestOfRun(problem, last), last * (1.0 + kSumTolerance),
          TieKeyOf(problem, answer.designs.back())};
}

// On what belongs behind a listed design, by its kind or source. It is the earliest of what ties
// with the best of these, so that may be better by a tie.
Claim Behind(const Problem& problem, const Design& design, const Answer& answer) {
  const double best = BestOfRun(problem, design.objective);
  if (!answer.proof.complete)
    return {std::min(answer.proof.lower_bound, best) * (1.0 - kSumTolerance), -kUnlimited, {}};
  return {best, design.objective * (1.0 + kSumTolerance), TieKeyOf(problem, design)};
}

}  // namespace

Claims::Claims(const Problem& problem, const Answer& answer) : all_(OnAll(problem, answer)) {
  if (!ListsKinds(problem)) return;
  std::map<SourceName, int> listed;
  for (const Design& design : answer.designs) {
    const KindName kind = KindOf(problem, design);
    kinds_.emplace(kind, Behind(problem, design, answer));
    if (++listed[kind.source] == problem.limits.per_source)
      sources_.emplace(kind.source, Behind(problem, design, answer));
  }
}

const Claim* Claims::OfKind(const KindName& kind) const {
  const auto found = kinds_.find(kind);
  return found == kinds_.end() ? OfSource(kind.source) : &found->second;
}

const Claim* Claims::OfSource(const SourceName& source) const {
  const auto found = sources_.find(source);
  return found == sources_.end() ? nullptr : &found->second;
}

SeriesOfPlan::SeriesOfPlan(const Problem& problem, const ProofPlan& plan)
    : plan_(plan), kinds_(ListsKinds(problem)) {
  if (!kinds_) return;
  for (const ProofSlot& slot : plan.slots) {
    std::vector<std::string>& series = series_.emplace_back();
    for (const ProofItem& item : slot.choices)
      series.push_back(SeriesName(problem, slot.family, item.part));
    std::vector<int>& until = same_until_.emplace_back(series.size());
    for (int i = static_cast<int>(series.size()) - 1; i >= 0; --i) {
      const bool last = i + 1 == static_cast<int>(series.size()) || series[i + 1] != series[i];
      until[i] = last ? i + 1 : until[i + 1];
    }
  }
}

bool SeriesOfPlan::AreSeveral(int slot, const std::pair<int, int>& range) const {
  return kinds_ && same_until_[slot][range.first] < range.second;
}

int SeriesOfPlan::Border(int slot, const std::pair<int, int>& range) const {
  const auto [first, last] = range;
  int best = same_until_[slot][first];
  for (int i = best; i < last; i = same_until_[slot][i])
    if (std::abs(2 * i - first - last) < std::abs(2 * best - first - last)) best = i;
  return best;
}

std::optional<KindName> SeriesOfPlan::Name(const Ranges& ranges, bool source_alone) const {
  KindName kind;
  kind.source.first = plan_.configuration;
  for (std::size_t s = 0; s < ranges.size(); ++s) {
    const ProofSlot& slot = plan_.slots[s];
    if (source_alone && (slot.group >= 0 || slot.family == Family::kRegulator)) continue;
    if (AreSeveral(static_cast<int>(s), ranges[s])) return std::nullopt;
    AddSeries(slot.family, series_[s][ranges[s].first], kind);
  }
  return kind;
}

const Claim& SeriesOfPlan::ClaimOn(const Claims& claims, const Ranges& ranges) const {
  if (!kinds_) return claims.all();
  const Claim* claim = nullptr;
  if (const auto kind = Name(ranges, false))
    claim = claims.OfKind(*kind);
  else if (const auto source = Name(ranges, true))
    claim = claims.OfSource(source->source);
  return claim ? *claim : claims.all();
}

}  // namespace plenum::verify
