#include "optimizer/bounds/group_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "optimizer/bounds/line_parts.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {
namespace {

constexpr double kRounding = 1e-12;  // of sums in another order
constexpr std::size_t kNeedsKept = 500'000, kLeastKept = 100'000;

// What divides the pressures in front of the regulator: lines whose valves do not hold end at the
// highest that their group stands, and less pressure leaves less at the node.
std::vector<double> SourceSteps(const Problem& problem, const Window& window) {
  constexpr double kRatio = 1.2;
  std::vector<double> steps{window.low_pa, window.high_pa};
  for (const ActuatorGroup& group : problem.groups)
    if (group.pressure_max_pa > window.low_pa && group.pressure_max_pa < window.high_pa)
      steps.push_back(group.pressure_max_pa);
  for (double step = window.high_pa / kRatio; step > window.low_pa; step /= kRatio)
    steps.push_back(step);
  std::sort(steps.begin(), steps.end());
  return steps;
}

// Those that no other is no worse than, by rising objective.
std::vector<LineChoice> FrontOf(std::vector<LineChoice> choices) {
  std::sort(choices.begin(), choices.end(), [](const LineChoice& a, const LineChoice& b) {
    return a.objective != b.objective ? a.objective < b.objective : a.coil_power_w < b.coil_power_w;
  });
  std::vector<LineChoice> front;
  for (const LineChoice& choice : choices)
    if (front.empty() || choice.coil_power_w < front.back().coil_power_w) front.push_back(choice);
  return front;
}

// Whether the same is asked of the lines of both, so that one list serves them.
bool AskedAlike(const ActuatorGroup& a, const ActuatorGroup& b) {
  return a.count == b.count && a.chamber == b.chamber && a.tube_length_m == b.tube_length_m &&
         a.fittings_per_line == b.fittings_per_line && a.rise_time_max_s == b.rise_time_max_s &&
         a.fall_time_max_s == b.fall_time_max_s && a.pressure_max_pa == b.pressure_max_pa &&
         a.gait == b.gait && a.least == b.least;
}

}  // namespace

void Thin(std::vector<LineChoice>& choices) {
  constexpr std::size_t kMost = 8;
  while (choices.size() > kMost) {
    std::size_t least = 0;
    double least_loss = kUnlimited;
    for (std::size_t i = 0; i + 1 < choices.size(); ++i) {
      const double loss = (choices[i + 1].objective - choices[i].objective) *
                          (choices[i].coil_power_w - choices[i + 1].coil_power_w);
      if (loss < least_loss) {
        least_loss = loss;
        least = i;
      }
    }
    choices[least].coil_power_w = choices[least + 1].coil_power_w;
    choices[least].places = {-1, -1, -1};
    choices.erase(choices.begin() + static_cast<std::ptrdiff_t>(least) + 1);
  }
}

std::vector<LineChoice> SumsOf(const std::vector<LineChoice>& a, const std::vector<LineChoice>& b) {
  std::vector<LineChoice> sums;
  sums.reserve(a.size() * b.size());
  for (const LineChoice& first : a)
    for (const LineChoice& second : b)
      sums.push_back(
          {first.objective + second.objective, first.coil_power_w + second.coil_power_w});
  std::vector<LineChoice> front = FrontOf(std::move(sums));
  Thin(front);
  return front;
}

GroupLines::GroupLines(const Problem& problem, const Plan& plan, const Workbench* bench)
    : problem_(problem),
      plan_(plan),
      bench_(bench),
      gas_(GasOf(plan.configuration)),
      lists_(plan.groups.size()) {
  like_.reserve(problem.groups.size());
  for (const ActuatorGroup& group : problem.groups) {
    const auto first =
        std::find_if(problem.groups.begin(), problem.groups.end(),
                     [&](const ActuatorGroup& other) { return AskedAlike(group, other); });
    like_.push_back(static_cast<int>(first - problem.groups.begin()));
  }
}

void GroupLines::ChangeWeights() {
  lists_.assign(plan_.groups.size(), {});
  least_.clear();
}

const std::optional<NodeMeans>& GroupLines::NeedOf(int group, const Nodes& nodes) {
  if (needs_.size() > kNeedsKept) needs_.clear();
  const auto [known, fresh] = needs_.try_emplace({group, nodes});
  if (!fresh) return known->second;
  const LineParts parts = PartsOf(plan_.groups[group], nodes);
  const bool single = parts.single();
  if (single) {
    const auto [tube, fitting, valve] = parts.choices();
    if (!PartsMate(problem_, tube, fitting, valve)) return known->second;
  }
  if (ScreenLine(problem_, group, gas_, parts.corners, single) == Constraint::kNone)
    known->second = LeastNodeMeans(problem_, group, gas_,
                                   AssembleLine(problem_, group, gas_, parts.corners, single));
  return known->second;
}

const NodeMeans& GroupLines::MostOf(int group) {
  if (!most_.empty()) return most_[group];
  if (plan_.regulators.size() != 1) {
    most_.assign(plan_.groups.size(), {kUnlimited, kUnlimited});
    return most_[group];
  }
  std::vector<Line> lines;
  std::vector<const Line*> corners;
  lines.reserve(plan_.groups.size());
  corners.reserve(plan_.groups.size());
  for (int g = 0; g < static_cast<int>(plan_.groups.size()); ++g)
    corners.push_back(&lines.emplace_back(
        AssembleLine(problem_, g, gas_, PartsOf(plan_.groups[g], {0, 0, 0}).corners, false)));
  const RegulatorCorner& regulator = plan_.regulators[0].corners[0];
  const bool mains = plan_.configuration == Configuration::kMains;
  const double source_pa = std::min({problem_.source_pressure_max_pa, regulator.outlet_max_pa,
                                     mains ? problem_.mains.pressure_pa : kUnlimited});
  const double flow_max =
      std::min(regulator.flow_max_m3_per_s, mains ? problem_.mains.flow_max_m3_per_s : kUnlimited);
  most_ = HighestNodeMeans(problem_, gas_, {regulator.flow, source_pa, flow_max}, corners);
  return most_[group];
}

bool GroupLines::Look(int group, const Nodes& nodes, LineList::Box& box) {
  const std::optional<NodeMeans>& needs = NeedOf(group, nodes);
  if (!needs || !needs->Within(MostOf(group))) return false;
  const LineParts parts = PartsOf(plan_.groups[group], nodes);
  box.objective = parts.objective();
  box.single = parts.single();
  if (box.single) {
    const Line line = AssembleLine(problem_, group, gas_, parts.corners, true);
    box.line = {box.objective,      line.coil_power_w, *needs, parts.corners.valve.pressure_min_pa,
                line.source_max_pa, parts.places()};
    return true;
  }
  const int widest = parts.widest();
  box.halves = {nodes, nodes};
  box.halves[0][widest] = parts.nodes[widest]->left;
  box.halves[1][widest] = parts.nodes[widest]->right;
  return true;
}

LineAsk GroupLines::AskOf(int group, const Nodes& nodes) const {
  const LineParts parts = PartsOf(plan_.groups[group], nodes);
  LineAsk ask;
  for (int s = 0; s < kSlotsPerGroup; ++s) {
    ask.first[s] = parts.nodes[s]->first;
    ask.last[s] = parts.nodes[s]->last;
  }
  return ask;
}

// Lines of a group that do what is asked: each with less coil power than the ones before, where
// batteries feed coils; the last may stand for all that were not looked at. Empty: there are none.
const std::vector<LineChoice>& GroupLines::Least(int group, const Nodes& nodes,
                                                 const LineAsk& ask) {
  constexpr int kLooks = 4000;
  constexpr std::size_t kPlaces = 20'000, kPlacesMore = 300;  // for the first line, after it
  if (least_.size() > kLeastKept) least_.clear();
  const auto [known, fresh] = least_.try_emplace({group, ask});
  std::vector<LineChoice>& choices = known->second;
  if (!fresh) return choices;
  const LineParts parts = PartsOf(plan_.groups[group], nodes);
  const double least = parts.objective();
  const double least_coil_w = parts.corners.valve.coil_power_w;
  LineList& list = lists_[group];
  const auto look = [&](const Nodes& box_nodes, LineList::Box& box) {
    return Look(group, box_nodes, box);
  };
  std::size_t place = list.PlaceOf(least * (1.0 - kRounding));
  bool stopped = false;
  for (std::size_t end = place + kPlaces; place < end; ++place) {
    stopped = place % 16 == 0 && bench_ != nullptr && bench_->stopped();
    if (stopped) break;
    const ListedLine* line = list.At(place, kLooks, look);
    if (!line) break;
    if (!ask.Admits(*line)) continue;
    if (!choices.empty() && line->coil_power_w >= choices.back().coil_power_w) continue;
    if (choices.empty()) end = std::min(end, place + kPlacesMore);
    choices.push_back({line->objective, line->coil_power_w, line->places});
    if (plan_.battery_slot < 0 || line->coil_power_w <= least_coil_w) return choices;
  }
  const ListedLine* next = list.At(place, 0, look);
  const double beyond = std::max(next ? next->objective : list.Beyond(), least);
  if (std::isfinite(beyond)) choices.push_back({beyond, least_coil_w});
  if (!stopped) return choices;
  unfinished_ = std::move(choices);
  least_.erase(known);
  return unfinished_;
}

std::vector<LineChoice> GroupLines::LeastBehind(const std::vector<Nodes>& boxes,
                                                const std::vector<const Line*>& lines,
                                                const Window& window, NodeSource source) {
  const std::vector<double> steps = SourceSteps(problem_, window);
  std::vector<LineChoice> all;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    source.source_pa = steps[i + 1];
    const std::vector<NodeMeans> most = HighestNodeMeans(problem_, gas_, source, lines);
    std::vector<LineChoice> sums{{}};
    for (int g = 0; g < static_cast<int>(lines.size()) && !sums.empty(); ++g) {
      LineAsk ask = AskOf(g, boxes[g]);
      ask.most = most[g];
      ask.source_low_pa = steps[i];
      ask.source_high_pa = steps[i + 1];
      sums = SumsOf(sums, Least(like_[g], boxes[g], ask));
    }
    all.insert(all.end(), sums.begin(), sums.end());
  }
  return FrontOf(std::move(all));
}

std::optional<GroupLines::Nodes> GroupLines::LeastAt(int group, const NodeMeans& most, double share,
                                                     double source_pa) {
  constexpr Nodes kAll{0, 0, 0};
  LineAsk ask = AskOf(group, kAll);
  ask.most = most;
  ask.least = {share * most.rise_pa, share * most.inflate_pa};
  ask.source_low_pa = ask.source_high_pa = source_pa;
  const std::vector<LineChoice>& choices = Least(like_[group], kAll, ask);
  if (choices.empty() || choices.front().places[0] < 0) return std::nullopt;
  const std::array<int, kSlotsPerGroup>& places = choices.front().places;
  const GroupTrees& trees = plan_.groups[group];
  return Nodes{LeafOf(trees.tubes.nodes, places[0]), LeafOf(trees.fittings.nodes, places[1]),
               LeafOf(trees.valves.nodes, places[2])};
}

// Best first by what boxes of lines need.
std::optional<GroupLines::Nodes> GroupLines::StrongestAt(int group, double source_pa) {
  constexpr int kLooks = 4000;
  using Open = std::pair<double, Nodes>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto push = [&](const Nodes& nodes) {
    const std::optional<NodeMeans>& needs = NeedOf(group, nodes);
    if (needs && needs->Within(MostOf(group)))
      open.emplace(needs->rise_pa + needs->inflate_pa, nodes);
  };
  push({0, 0, 0});
  for (int looks = 0; !open.empty() && looks < kLooks; ++looks) {
    if (bench_ != nullptr && bench_->stopped()) break;
    const Nodes nodes = open.top().second;
    open.pop();
    const LineParts parts = PartsOf(plan_.groups[group], nodes);
    if (parts.corners.valve.pressure_min_pa > source_pa) continue;
    if (!parts.single()) {
      Nodes half = nodes;
      const int widest = parts.widest();
      for (const int child : {parts.nodes[widest]->left, parts.nodes[widest]->right}) {
        half[widest] = child;
        push(half);
      }
    } else if (AssembleLine(problem_, group, gas_, parts.corners, true).source_max_pa >=
               source_pa) {
      return nodes;
    }
  }
  return std::nullopt;
}

}  // namespace plenum::optimizer
