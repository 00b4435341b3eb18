#include "verify/verify_draws.h"

#include "verify/design/verify_list.h"
#include "verify/design/verify_size.h"

namespace plenum::verify {
namespace {

constexpr double kToSpare = 1e-6;       // of each requirement
constexpr double kClearly = 2e-6;       // better by more than a tie
constexpr double kSame = 1e-8;          // far closer than a tie
constexpr double kEnergyUnsure = 1e-4;  // objectives with energy, sought in two ways

// A design in one draw: its objective lies between the two, which are +∞ where it surely is not met
// or where it is not met with something to spare.
struct Drawn {
  double least = kUnlimited, most = kUnlimited;
};
constexpr Drawn kNotMade{0.0, kUnlimited};  // nothing is known of it

// Between what surely and what perhaps holds.
struct Count {
  int surely = 0, perhaps = 0;
  bool Has(int claimed) const { return surely <= claimed && claimed <= perhaps; }
  std::string Text() const {
    return surely == perhaps ? std::to_string(surely)
                             : std::to_string(surely) + " to " + std::to_string(perhaps);
  }
};

Drawn Draw(Problem& problem, const Design& design, model::Parts parts, const Stop& stop) {
  problem.parts = std::move(parts);
  Findings missing;
  std::optional<Assembly> assembly = Assemble(problem, design, missing);
  if (!assembly) return {};
  // What was made to measure is there by now, with a volume of its own.
  if (assembly->pump() && !assembly->reservoir && !assembly->direct()) {
    if (problem.parts.reservoirs.empty()) return {};
    assembly->reservoir = &problem.parts.reservoirs.front();
  }
  const double unsure = problem.objective.energy_wh > 0.0 ? kEnergyUnsure : kSumTolerance;
  Sizer sizer(problem, stop);
  const Sizing surely = sizer.Size(*assembly, -kToSpare, kUnlimited);
  if (surely.status == Sized::kFeasible)
    return {surely.objective * (1.0 - unsure), surely.objective * (1.0 + unsure)};
  const Sizing perhaps = sizer.Size(*assembly, kToSpare, kUnlimited);
  if (perhaps.status == Sized::kInfeasible) return {};
  return {perhaps.lower_bound * (1.0 - unsure), kUnlimited};
}

Count Met(const std::vector<Drawn>& draws) {
  Count met;
  for (const Drawn& drawn : draws) {
    met.surely += std::isfinite(drawn.most);
    met.perhaps += std::isfinite(drawn.least);
  }
  return met;
}

// Whether the design of rank `i` surely goes before that of rank `j` in a draw that `i` meets.
bool GoesBefore(const std::vector<std::vector<Drawn>>& designs, std::size_t i, std::size_t j,
                std::size_t draw) {
  const double most = designs[i][draw].most, other = designs[j][draw].least;
  return most < other * (1.0 - kClearly) || (i < j && most <= other * (1.0 + kSame)) ||
         (std::isfinite(most) && std::isinf(other));
}

Count First(const std::vector<std::vector<Drawn>>& designs, std::size_t i) {
  Count first;
  for (std::size_t draw = 0; draw < designs[i].size(); ++draw) {
    bool surely = std::isfinite(designs[i][draw].most);
    bool perhaps = std::isfinite(designs[i][draw].least);
    for (std::size_t j = 0; j < designs.size(); ++j) {
      if (j == i) continue;
      surely = surely && GoesBefore(designs, i, j, draw);
      perhaps = perhaps && !GoesBefore(designs, j, i, draw);
    }
    first.surely += surely;
    first.perhaps += perhaps;
  }
  return first;
}

class DrawsAgain {
 public:
  DrawsAgain(const Problem& problem, const RobustAnswer& answer, const RobustOptions& options,
             const DrawParts& draw_parts, const Stop& stop)
      : nominal_(problem),
        problem_(problem),
        answer_(answer),
        options_(options),
        draw_parts_(draw_parts),
        stop_(stop) {}

  Verification Run() {
    if (answer_.draws < 0 || answer_.draws > options_.draws)
      Add("draws", "there are " + std::to_string(answer_.draws) + " of them, asked for were " +
                       std::to_string(options_.draws));
    const std::vector<Design>& listed = answer_.answer.designs;
    for (std::size_t i = 0; i < listed.size(); ++i) {
      drawn_.push_back(All(listed[i]));
      Compare("met in ", i, Met(drawn_.back()), answer_.robustness[i].met);
    }
    for (std::size_t i = 0; i < listed.size() && cut_short_ == 0; ++i)
      Compare("first in ", i, First(drawn_, i), answer_.robustness[i].first);
    CheckNames names{{"draws", "shares are those of the draws, made again"}};
    if (options_.probability_min) {
      CheckChoice(*answer_.searched);
      names.emplace_back("probability", "of the designs searched those that reach it are listed");
    }
    if (cut_short_ > 0)
      open_.push_back({"designs whose draws were not all made again", cut_short_});
    return {Gather(names, findings_), open_, {}};
  }

 private:
  std::vector<Drawn> All(const Design& design) {
    std::vector<Drawn> draws;
    for (int draw = 0; draw < answer_.draws && !Stopped(stop_); ++draw)
      draws.push_back(Draw(problem_, design, draw_parts_(design, draw), stop_));
    if (Stopped(stop_)) ++cut_short_;
    while (static_cast<int>(draws.size()) < answer_.draws) draws.push_back(kNotMade);
    return draws;
  }

  // Whether at least the share of the draws that is asked for is met.
  bool Reaches(int met) const {
    return answer_.draws > 0 && met >= *options_.probability_min * answer_.draws;
  }
  // The draws that a design meets, up to the one after which it can no longer reach it.
  Count MetWhileItMatters(const Design& design) {
    Count met;
    for (int draw = 0; draw < answer_.draws; ++draw) {
      if (!Reaches(met.perhaps + answer_.draws - draw)) break;
      if (Stopped(stop_)) {
        ++cut_short_;
        met.perhaps += answer_.draws - draw;
        break;
      }
      const Drawn drawn = Draw(problem_, design, draw_parts_(design, draw), stop_);
      met.surely += std::isfinite(drawn.most);
      met.perhaps += std::isfinite(drawn.least);
    }
    return met;
  }

  void Compare(const char* what, std::size_t rank, const Count& found, int claimed) {
    if (!found.Has(claimed))
      Add("draws", "rank " + std::to_string(rank + 1) + " is " + what + found.Text() +
                       " draws, not " + std::to_string(claimed));
  }

  // Each searched design is listed if it reaches the probability, but for those beyond a full list.
  void CheckChoice(const Searched& searched) {
    const std::vector<Design>& listed = answer_.answer.designs;
    const bool full = static_cast<int>(listed.size()) == problem_.count;
    double bound = searched.answer.proof.lower_bound;
    Count below;
    for (std::size_t i = 0; i < searched.answer.designs.size(); ++i) {
      if (searched.place[i] >= 0) continue;
      const Design& design = searched.answer.designs[i];
      const Count met = MetWhileItMatters(design);
      below.surely += !Reaches(met.perhaps);
      below.perhaps += !Reaches(met.surely);
      if (!Reaches(met.surely)) continue;
      bound = std::min(bound, design.objective);
      if (!full || design.objective < listed.back().objective * (1.0 - kTieTolerance))
        Add("probability",
            "design " + std::to_string(i + 1) + " of those searched reaches it and is not listed");
    }
    if (!below.Has(answer_.below))
      Add("probability", below.Text() + " are left out, not " + std::to_string(answer_.below));
    for (std::size_t rank = 0; rank < listed.size(); ++rank)
      if (!Reaches(Met(drawn_[rank]).perhaps))
        Add("probability", "rank " + std::to_string(rank + 1) + " does not reach it");
    CheckList();
    CheckClaim(searched, bound);
  }

  // The list may hold designs that are not among those searched.
  void CheckList() {
    const std::vector<Design>& listed = answer_.answer.designs;
    Findings own;
    CheckDesigns(nominal_, listed, stop_, own, open_);
    CheckOrder(nominal_, listed, own);
    for (Finding& finding : own)
      Add("probability", finding.check + ": " + std::move(finding.detail));
  }

  // The list claims no more than follows from the search.
  void CheckClaim(const Searched& searched, double bound) {
    const Answer& answer = answer_.answer;
    const Proof& proof = answer.proof;
    if (proof.lower_bound > bound * (1.0 + kSumTolerance))
      Add("probability", "the lower bound is above that of what is not listed");
    const double last = answer.designs.empty() ? 0.0 : answer.designs.back().objective;
    const double gap = std::isfinite(proof.lower_bound) && last > 0.0
                           ? std::max(0.0, 1.0 - proof.lower_bound / last)
                           : 0.0;
    if (!answer.designs.empty() && std::abs(proof.gap - gap) > kSumTolerance)
      Add("probability", "the gap is not that of the lower bound and the last design");
    const bool exhausted = static_cast<int>(searched.answer.designs.size()) < searched.count;
    const bool full = static_cast<int>(answer.designs.size()) == problem_.count;
    const bool optimal = searched.answer.status == Status::kOptimal && !answer.designs.empty() &&
                         gap <= kTieTolerance && (full || exhausted) &&
                         answer_.draws == options_.draws;
    const bool same = answer.status == searched.answer.status;
    const bool modest =
        same || answer.status == Status::kFeasible || answer.status == Status::kCancelled;
    if (answer.status == Status::kOptimal ? !optimal : !modest)
      Add("probability", std::string(Name(answer.status)) + " is more than follows");
    if (proof.complete !=
        (answer.status == Status::kOptimal || answer.status == Status::kInfeasible))
      Add("probability", "complete is not what the status says");
  }

  void Add(const char* check, std::string detail) {
    findings_.push_back({check, std::move(detail)});
  }

  const Problem& nominal_;
  Problem problem_;  // with the parts of a draw
  const RobustAnswer& answer_;
  const RobustOptions& options_;
  const DrawParts& draw_parts_;
  const Stop& stop_;
  std::vector<std::vector<Drawn>> drawn_;  // of each listed design
  Findings findings_;
  std::size_t cut_short_ = 0;  // designs whose draws were stopped
  std::vector<NotRechecked> open_;
};

}  // namespace

Verification VerifyDraws(const Problem& problem, const RobustAnswer& answer,
                         const RobustOptions& options, const DrawParts& draw_parts,
                         const Stop& stop) {
  return DrawsAgain(problem, answer, options, draw_parts, stop).Run();
}

}  // namespace plenum::verify
