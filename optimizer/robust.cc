#include "optimizer/robust.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "optimizer/resize.h"

namespace plenum::optimizer {
namespace {

constexpr double kTie = 1e-6;
constexpr int kDepthMax = 500;
constexpr int kDepthFactor = 4;

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Objective of one design per draw; +∞ where the draw is not met.
using Objectives = std::vector<double>;

class Draws {
 public:
  Draws(const Problem& problem, const SearchOptions& search_options, const RobustOptions& options,
        const DrawParts& draw_parts)
      : problem_(problem),
        search_options_(search_options),
        options_(options),
        draw_parts_(draw_parts) {
    problem_.parts = {};
  }

  // Draw by draw, so that all designs have the same draws when time ends it.
  void Run(const std::vector<Design>& designs) {
    const Clock::time_point start = Clock::now();
    objectives_.assign(designs.size(), {});
    std::vector<int> missed(designs.size(), 0);
    for (draws_ = 0; draws_ < options_.draws && !Stopped(start); ++draws_)
      for (std::size_t i = 0; i < designs.size(); ++i) {
        if (Hopeless(missed[i])) continue;
        objectives_[i].push_back(ObjectiveIn(designs[i], draws_, [&] { return Stopped(start); }));
        missed[i] += std::isinf(objectives_[i].back());
      }
    if (Stopped(start) && draws_ > 0) {  // the last one may be incomplete
      --draws_;
      for (Objectives& of : objectives_)
        of.resize(std::min(of.size(), static_cast<std::size_t>(draws_)));
    }
    used_s_ += SecondsSince(start);
  }

  int draws() const { return draws_; }
  int Met(std::size_t design) const {
    return static_cast<int>(std::count_if(objectives_[design].begin(), objectives_[design].end(),
                                          [](double value) { return std::isfinite(value); }));
  }
  bool Reaches(std::size_t design, double probability) const {
    return draws_ > 0 && Met(design) >= probability * draws_;
  }
  const Objectives& of(std::size_t design) const { return objectives_[design]; }

 private:
  bool Stopped(Clock::time_point start) const {
    return used_s_ + SecondsSince(start) > options_.time_limit_s ||
           (search_options_.cancelled && search_options_.cancelled());
  }

  // Cannot reach the probability that is asked for in the draws that are left.
  bool Hopeless(int missed) const {
    return options_.probability_min &&
           options_.draws - missed < *options_.probability_min * options_.draws;
  }

  double ObjectiveIn(const Design& design, int draw, const std::function<bool()>& stop) {
    problem_.parts = draw_parts_(design, draw);
    const Leaf leaf = Resize(problem_, design, stop);
    return leaf.status == LeafStatus::kFeasible ? leaf.objective : kUnlimited;
  }

  Problem problem_;
  const SearchOptions& search_options_;
  const RobustOptions& options_;
  const DrawParts& draw_parts_;
  std::vector<Objectives> objectives_;
  int draws_ = 0;
  double used_s_ = 0.0;
};

// Which of the designs, given in order of rank, is best in the draw; none if none meets it.
std::optional<std::size_t> BestIn(const std::vector<Objectives>& designs, std::size_t draw) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    if (draw >= designs[i].size() || std::isinf(designs[i][draw])) continue;
    if (!best || designs[i][draw] < designs[*best][draw] * (1.0 - kTie)) best = i;
  }
  return best;
}

// Keeps the designs that reach the probability, and counts.
void Tally(const Draws& draws, const RobustOptions& options, RobustAnswer& result) {
  std::vector<Design>& designs = result.answer.designs;
  std::vector<Design> kept;
  std::vector<Objectives> objectives;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    if (options.probability_min && !draws.Reaches(i, *options.probability_min)) continue;
    kept.push_back(std::move(designs[i]));
    objectives.push_back(draws.of(i));
    result.robustness.push_back({draws.Met(i), 0});
  }
  result.below = static_cast<int>(designs.size() - kept.size());
  designs = std::move(kept);
  result.draws = draws.draws();
  for (int draw = 0; draw < result.draws; ++draw)
    if (const auto best = BestIn(objectives, static_cast<std::size_t>(draw)))
      ++result.robustness[*best].first;
}

}  // namespace

RobustAnswer AssessRobustness(const Problem& problem, Answer answer,
                              const SearchOptions& search_options, const RobustOptions& options,
                              const DrawParts& draw_parts) {
  RobustAnswer result;
  result.answer = std::move(answer);
  Draws draws(problem, search_options, options, draw_parts);
  draws.Run(result.answer.designs);
  Tally(draws, options, result);
  return result;
}

RobustAnswer SearchRobust(const Problem& problem, const SearchOptions& search_options,
                          const RobustOptions& options, const DrawParts& draw_parts) {
  if (!options.probability_min)
    return AssessRobustness(problem, Search(problem, search_options), search_options, options,
                            draw_parts);
  const Clock::time_point start = Clock::now();
  Problem deeper = problem;
  SearchOptions left = search_options;
  RobustOptions draw_options = options;
  RobustAnswer result;
  while (true) {
    left.time_limit_s = search_options.time_limit_s - SecondsSince(start);
    Answer answer = Search(deeper, left);
    const bool exhausted = static_cast<int>(answer.designs.size()) < deeper.count;
    const bool proved = answer.status == Status::kOptimal;
    const Clock::time_point drawing = Clock::now();
    result = AssessRobustness(problem, std::move(answer), search_options, draw_options, draw_parts);
    draw_options.time_limit_s -= SecondsSince(drawing);
    const bool enough = static_cast<int>(result.answer.designs.size()) >= problem.count;
    if (enough || exhausted || !proved || deeper.count >= kDepthMax ||
        draw_options.time_limit_s <= 0.0 || SecondsSince(start) > search_options.time_limit_s)
      break;
    deeper.count = std::min(kDepthMax, kDepthFactor * deeper.count);
  }
  Answer& answer = result.answer;
  if (static_cast<int>(answer.designs.size()) > problem.count) {
    // The next one stays, too: the bound on what is not listed is its objective.
    answer.proof.lower_bound =
        std::min(answer.proof.lower_bound, answer.designs[problem.count].objective);
    answer.designs.resize(problem.count);
    result.robustness.resize(problem.count);
  }
  if (answer.status == Status::kOptimal && answer.designs.empty())
    answer.status = Status::kFeasible;
  answer.seconds = SecondsSince(start);
  return result;
}

}  // namespace plenum::optimizer
