#include "optimizer/search/revised_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "optimizer/choices/tie_key.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/relaxation.h"
#include "optimizer/search/box_search.h"
#include "optimizer/sizing/resize.h"

namespace plenum::optimizer {
namespace {

constexpr int kFirstDepth = 32;  // designs of the relaxed problem, at first and at most
constexpr int kDepthMax = 8192;
constexpr double kNominalShare = 0.2, kGuideShare = 0.5;  // of the time left
constexpr double kProgressIntervalS = 0.2;

using PartsKey = std::vector<std::tuple<int, Family, std::string, double>>;

PartsKey KeyOf(const Design& design) {
  PartsKey key;
  for (const Choice& part : design.parts)
    key.emplace_back(part.group, part.family, part.id, part.quantity);
  return key;
}

struct Found {
  Design design;
  std::optional<double> lower_bound;  // of its objective, once the relaxed problem has come to it
};

bool Before(const Problem& problem, const Found& a, const Found& b) {
  const double objective_a = a.design.objective, objective_b = b.design.objective;
  if (std::abs(objective_a - objective_b) > kTie * std::max(objective_a, objective_b))
    return objective_a < objective_b;
  return TieKeyOf(problem, a.design) < TieKeyOf(problem, b.design);
}

class Revision {
 public:
  Revision(const Problem& problem, const SearchOptions& options)
      : problem_(problem), options_(options), relaxed_(Relaxed(problem)) {}

  Answer Run() {
    if (const std::optional<Problem> guide = TryNominal()) Descend(*guide, kGuideShare);
    bounds_ = true;
    return Conclude(Descend(relaxed_, 1.0));
  }

 private:
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool Stopped() {
    cancelled_ = cancelled_ || (options_.cancelled && options_.cancelled());
    late_ = late_ || Seconds() > options_.time_limit_s;
    return cancelled_ || late_;
  }

  double Left() const { return std::max(0.0, options_.time_limit_s - Seconds()); }

  // The nominal list comes first: its designs may still do. How the best of them fares says where
  // good designs are.
  std::optional<Problem> TryNominal() {
    const double until_s = Seconds() + kNominalShare * Left();
    const Answer list =
        Enumerate(WithoutEffects(problem_), problem_.count, 0.5 * (until_s - Seconds()));
    if (list.designs.empty()) return std::nullopt;
    Assess(list, until_s);
    const auto margins =
        MarginsOf(problem_, relaxed_, list.designs.front(), [this] { return Stopped(); });
    if (!margins) return std::nullopt;
    return Guide(problem_, list.designs.front(), *margins);
  }

  // Deeper and deeper down the list of a base problem, until nothing of it can enter ours.
  Answer Descend(const Problem& base, double share) {
    const double until_s = Seconds() + share * Left();
    for (int depth = std::max(kFirstDepth, 2 * problem_.count);; depth *= 4) {
      const Answer answer = Enumerate(base, depth, 0.5 * (until_s - Seconds()));
      unseen_bound_ = answer.proof.lower_bound;
      Assess(answer, until_s);
      exhausted_ = static_cast<int>(answer.designs.size()) < depth && answer.proof.complete;
      if (Stopped() || Seconds() > until_s || exhausted_ || Settled(unseen_bound_) ||
          depth >= kDepthMax)
        return answer;
    }
  }

  Answer Enumerate(const Problem& base, int depth, double seconds) {
    Problem deep = base;
    deep.count = depth;
    deep.list = ListOf::kCombinations;
    SearchOptions options = options_;
    options.record = false;
    options.any_design = false;
    options.progress = nullptr;
    options.time_limit_s = std::max(0.0, seconds);
    return SearchBoxes(deep, options);
  }

  bool Settled(double bound) const {
    return (options_.any_design && !found_.empty()) ||
           (static_cast<int>(found_.size()) >= problem_.count &&
            bound >= found_[problem_.count - 1].design.objective * (1.0 - kTie));
  }

  // Sizes the designs that were not met before, in order, until none can enter the list.
  void Assess(const Answer& base, double until_s) {
    for (const Design& design : base.designs) {
      if (Settled(design.objective) || Stopped() || Seconds() > until_s) {
        unseen_bound_ = std::min(unseen_bound_, design.objective);
        return;
      }
      Report(design.objective);
      const PartsKey key = KeyOf(design);
      if (!seen_.insert(key).second) {
        SetBound(key, design.objective);
        continue;
      }
      Remade remade =
          Remake(problem_, relaxed_, design, [&] { return Stopped() || Seconds() > until_s; });
      ++sized_;
      if (remade.status == LeafStatus::kUndecided) {
        if (Stopped() || Seconds() > until_s) {
          seen_.erase(key);
        } else {
          ++undecided_;
          undecided_bound_ = std::min(undecided_bound_, design.objective);
        }
        continue;
      }
      if (!remade.design) continue;
      ++simulated_;
      Found found{std::move(*remade.design),
                  bounds_ ? std::optional(design.objective) : std::nullopt};
      found_.insert(
          std::upper_bound(found_.begin(), found_.end(), found,
                           [&](const Found& a, const Found& b) { return Before(problem_, a, b); }),
          std::move(found));
    }
  }

  void SetBound(const PartsKey& key, double lower_bound) {
    if (!bounds_) return;
    for (Found& found : found_)
      if (KeyOf(found.design) == key) found.lower_bound = lower_bound;
  }

  void Report(double bound) {
    if (!options_.progress || Seconds() - reported_s_ < kProgressIntervalS) return;
    reported_s_ = Seconds();
    Progress progress;
    progress.seconds = reported_s_;
    progress.evaluated = sized_;
    if (!found_.empty()) progress.best = found_.front().design.objective;
    progress.lower_bound = bound;
    options_.progress(progress);
  }

  Answer Conclude(const Answer& base) {
    Answer answer;
    answer.proof = base.proof;
    answer.proof.record = nullptr;
    answer.proof.simulated = simulated_;
    answer.proof.undecided = base.proof.undecided + undecided_;
    const std::size_t listed = std::min<std::size_t>(found_.size(), problem_.count);
    double bound = std::min(unseen_bound_, undecided_bound_);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i < listed)
        answer.designs.push_back(std::move(found_[i].design));
      else if (found_[i].lower_bound)  // else it is among the unseen
        bound = std::min(bound, *found_[i].lower_bound);
    }
    if (!RelaxationIsProved(problem_)) bound = 0.0;
    answer.proof.lower_bound = bound;
    const double last = answer.designs.empty() ? 0.0 : answer.designs.back().objective;
    answer.proof.gap = answer.designs.empty() ? (exhausted_ ? 0.0 : 1.0)
                       : last > 0.0           ? std::max(0.0, 1.0 - bound / last)
                                              : 0.0;
    const bool all = answer.designs.empty() ? exhausted_ && undecided_ == 0
                                            : answer.proof.gap <= kTie && !options_.any_design;
    answer.proof.complete = all && !cancelled_ && RelaxationIsProved(problem_);
    answer.status = cancelled_               ? Status::kCancelled
                    : !answer.proof.complete ? Status::kFeasible
                    : answer.designs.empty() ? Status::kInfeasible
                                             : Status::kOptimal;
    answer.seconds = Seconds();
    return answer;
  }

  const Problem& problem_;
  const SearchOptions& options_;
  Problem relaxed_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::set<PartsKey> seen_;
  std::vector<Found> found_;  // in order
  double unseen_bound_ = 0.0, undecided_bound_ = kUnlimited;
  double reported_s_ = 0.0;
  long long sized_ = 0, simulated_ = 0, undecided_ = 0;
  bool bounds_ = false;  // the relaxed problem is being searched
  bool cancelled_ = false, late_ = false, exhausted_ = false;
};

}  // namespace

Answer SearchRevised(const Problem& problem, const SearchOptions& options) {
  return Revision(problem, options).Run();
}

}  // namespace plenum::optimizer
