#include "optimizer/explain/robust.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <utility>

#include "optimizer/explain/explained_search.h"
#include "optimizer/explain/robust_draws.h"
#include "optimizer/search/conclusion.h"
#include "optimizer/sizing/resize.h"

namespace plenum::optimizer {
namespace {

constexpr int kDepthMax = 500;
constexpr int kDepthFactor = 4;
// Shares by which requirements are tightened.
constexpr double kFirstRoom = 0.02, kRoomGrowth = 1.5, kLastRoom = 0.6, kRoomTolerance = 0.1;
constexpr int kTried = 4;  // designs with some room

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Which of the designs, given in order of rank, is best in the draw; none if none meets it.
std::optional<std::size_t> BestIn(const std::vector<const Objectives*>& designs, std::size_t draw) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const Objectives& own = *designs[i];
    if (draw >= own.size() || std::isinf(own[draw])) continue;
    if (!best || own[draw] < (*designs[*best])[draw] * (1.0 - kTie)) best = i;
  }
  return best;
}

void CountDraws(const Draws& draws, RobustAnswer& result) {
  std::vector<const Objectives*> objectives;
  result.robustness.clear();
  for (const Design& design : result.answer.designs) {
    objectives.push_back(&draws.of(design));
    result.robustness.push_back({draws.Met(design, result.draws), 0});
  }
  for (int draw = 0; draw < result.draws; ++draw)
    if (const auto best = BestIn(objectives, static_cast<std::size_t>(draw)))
      ++result.robustness[*best].first;
}

// Shares by which limits are tightened, by what they ask of the parts.
struct Room {
  double strokes = 0.0, rate = 0.0, amounts = 0.0, store = 0.0;
};

Problem Tightened(Problem problem, const Room& room) {
  for (ActuatorGroup& group : problem.groups) {
    group.rise_time_max_s *= 1.0 - room.strokes;
    group.fall_time_max_s *= 1.0 - room.strokes;
  }
  problem.frequency_hz *= 1.0 + room.rate;
  problem.mains.flow_max_m3_per_s *= 1.0 - room.rate;
  problem.compressed_air.flow_max_m3_per_s *= 1.0 - room.rate;
  for (double* most : {&problem.mass_max_kg, &problem.volume_max_l, &problem.cost_max_eur})
    *most *= 1.0 - room.amounts;
  problem.actuations *= 1.0 + room.store;
  return problem;
}

// Designs that reach the probability, found where limits are tightened: what has room to spare
// meets them in more draws. A proof does not rest on them, they are candidates.
class DesignsWithRoom {
 public:
  DesignsWithRoom(const Problem& problem, const SearchOptions& options, Clock::time_point start,
                  const RobustOptions& robust, Draws& draws)
      : problem_(problem), options_(options), start_(start), robust_(robust), draws_(draws) {
    options_.record = false;
  }

  // All limits by ever more till some reach it, then each kind by as little as still does.
  std::vector<Design> Find() {
    Room room;
    double share = kFirstRoom;
    for (; share < kLastRoom; share *= kRoomGrowth) {
      room = {share, share, share, share};
      if (Some(room)) break;
    }
    if (!(share < kLastRoom)) return {};
    for (double Room::*kind : {&Room::strokes, &Room::rate, &Room::amounts, &Room::store}) {
      double enough = room.*kind;
      room.*kind = 0.0;
      if (Some(room)) continue;
      for (double little = 0.0; enough - little > kRoomTolerance * share;) {
        room.*kind = 0.5 * (little + enough);
        (Some(room) ? enough : little) = room.*kind;
      }
      room.*kind = enough;
    }
    std::vector<Design> reach = With(room, problem_.count);
    draws_.Run(reach);
    std::erase_if(reach, [&](const Design& design) {
      return draws_.Drawn(design) < robust_.draws || !draws_.Reaches(design, robust_.draws);
    });
    return reach;
  }

 private:
  // Whether one of the first few designs that have this room reaches the probability.
  bool Some(const Room& room) {
    const std::vector<Design> designs = With(room, kTried);
    return std::any_of(designs.begin(), designs.end(), [&](const Design& design) {
      return draws_.Run({design}) == robust_.draws && draws_.Reaches(design, robust_.draws);
    });
  }

  // The best designs that have this room, as they are bought and then set up for the problem.
  std::vector<Design> With(const Room& room, int count) {
    options_.time_limit_s -= SecondsSince(std::exchange(start_, Clock::now()));
    if (options_.time_limit_s <= 0.0 || draws_.stopped()) return {};
    Problem tight = Tightened(problem_, room);
    tight.count = count;
    tight.list = ListOf::kCombinations;
    std::vector<Design> bought;
    for (const Design& design : Search(tight, options_).designs) {
      if (draws_.stopped()) break;
      if (auto own = WithSettingsAnew(problem_, design, [this] {
            return draws_.stopped() || SecondsSince(start_) > options_.time_limit_s;
          }))
        bought.push_back(std::move(*own));
    }
    return bought;
  }

  const Problem& problem_;
  SearchOptions options_;
  Clock::time_point start_;
  const RobustOptions& robust_;
  Draws& draws_;
};

struct Entry {
  const Design* design;
  std::size_t searched;  // its place there; past the end: it has room
};

// By objective; ties, counted from the first of each run of them, by mass, cost and ids.
void Order(const Problem& problem, std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.design->objective < b.design->objective;
  });
  for (auto run = entries.begin(); run != entries.end();) {
    const double most = run->design->objective * (1.0 + kTie);
    const auto end = std::find_if(
        run, entries.end(), [&](const Entry& entry) { return entry.design->objective > most; });
    std::sort(run, end, [&](const Entry& a, const Entry& b) {
      return TieKeyOf(problem, *a.design) < TieKeyOf(problem, *b.design);
    });
    run = end;
  }
}

// Lists the best designs that reach the probability: of the searched ones, and of those with room.
RobustAnswer Choose(const Problem& problem, Searched searched, const std::vector<Design>& with_room,
                    const Draws& draws, int draws_done, bool all) {
  const std::vector<Design>& designs = searched.answer.designs;
  RobustAnswer result;
  result.draws = draws_done;
  std::vector<Entry> entries;
  std::set<Combination> listed;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    if (draws.Reaches(designs[i], draws_done)) {
      entries.push_back({&designs[i], i});
      listed.insert(CombinationOf(designs[i]));
    } else {
      ++result.below;
    }
  }
  for (const Design& design : with_room)
    if (listed.insert(CombinationOf(design)).second) entries.push_back({&design, designs.size()});
  Order(problem, entries);

  Answer& answer = result.answer;
  answer = searched.answer;
  answer.designs.clear();
  searched.place.assign(designs.size(), -1);
  Proof& proof = answer.proof;
  for (const auto& [design, index] : entries) {
    if (static_cast<int>(answer.designs.size()) == problem.count) {
      proof.lower_bound = std::min(proof.lower_bound, design->objective);
      continue;
    }
    if (index < designs.size()) searched.place[index] = static_cast<int>(answer.designs.size());
    answer.designs.push_back(*design);
  }
  if (answer.status == Status::kOptimal) {
    const bool none = answer.designs.empty();
    proof.gap = none ? 1.0 : GapOf(proof.lower_bound, answer.designs.back().objective);
    const bool full = static_cast<int>(answer.designs.size()) == problem.count;
    const bool exhausted = static_cast<int>(designs.size()) < searched.count;
    proof.complete = all && !none && proof.gap <= kTie && (full || exhausted);
    if (!proof.complete) answer.status = Status::kFeasible;
  } else if (!answer.designs.empty()) {
    proof.gap = GapOf(proof.lower_bound, answer.designs.back().objective);
  }
  CountDraws(draws, result);
  result.searched = std::move(searched);
  return result;
}

}  // namespace

RobustAnswer AssessRobustness(const Problem& problem, Answer answer,
                              const SearchOptions& search_options, const RobustOptions& options,
                              const DrawParts& draw_parts) {
  RobustAnswer result;
  result.answer = std::move(answer);
  Draws draws(problem, search_options, options, draw_parts);
  result.draws = draws.Run(result.answer.designs);
  CountDraws(draws, result);
  return result;
}

RobustAnswer SearchRobust(const Problem& problem, const SearchOptions& search_options,
                          const RobustOptions& options, const DrawParts& draw_parts) {
  if (!options.probability_min)
    return AssessRobustness(problem, Search(problem, search_options), search_options, options,
                            draw_parts);
  const Clock::time_point start = Clock::now();
  Draws draws(problem, search_options, options, draw_parts);
  SearchOptions left = search_options;
  Problem deeper = problem;
  std::vector<Design> with_room;
  RobustAnswer result;
  for (bool first = true;; first = false) {
    left.time_limit_s = search_options.time_limit_s - SecondsSince(start);
    Searched searched{deeper.count, Search(deeper, left), {}};
    const bool proved = searched.answer.status == Status::kOptimal;
    const int drawn = draws.Run(searched.answer.designs);
    // A list that is proved and drawn to the end is not given up for one that is not.
    if (!first && (!proved || drawn < options.draws)) break;
    const bool all = drawn == options.draws;
    result = Choose(problem, searched, with_room, draws, drawn, all);
    const bool open = proved && all && result.answer.status == Status::kFeasible &&
                      static_cast<int>(searched.answer.designs.size()) == deeper.count;
    if (open && first) {
      with_room = DesignsWithRoom(problem, search_options, start, options, draws).Find();
      result = Choose(problem, std::move(searched), with_room, draws, drawn, all);
    }
    if (!open || deeper.count >= kDepthMax || draws.stopped() ||
        SecondsSince(start) > search_options.time_limit_s)
      break;
    deeper.count = std::min(kDepthMax, kDepthFactor * deeper.count);
  }
  if (result.answer.status == Status::kFeasible && search_options.cancelled &&
      search_options.cancelled())
    result.answer.status = Status::kCancelled;
  result.answer.seconds = SecondsSince(start);
  return result;
}

}  // namespace plenum::optimizer
