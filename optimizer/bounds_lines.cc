// What is known of boxes of lines, whatever the source: whether their strokes may be in time, their
// least objective, and the line of their corner, once for all boxes that share them.
#include <algorithm>
#include <queue>

#include "optimizer/box.h"
#include "optimizer/hash.h"
#include "optimizer/line.h"
#include "optimizer/make_line.h"

namespace plenum::optimizer {
namespace {

// Of lines that are only known to miss nothing, or something, many are kept: they take 0.1 kB each,
// a line that was made 2.7 kB.
constexpr std::size_t kLinesKept = 150'000, kLinesMade = 50'000;

}  // namespace

std::size_t Bounds::LineKey::Hash::operator()(const LineKey& key) const {
  optimizer::Hash hash;
  hash.Add(key.group);
  for (int node : key.nodes) hash.Add(node);
  return hash.place();
}

Constraint Bounds::Screen(const LineKey& key, const LineParts& parts, const LineParts* whole) {
  if (const Constraint* known = verdicts_[key.group].Find(key.nodes)) return *known;
  Constraint missed = ScreenLine(problem_, key.group, gas_, parts.corners, parts.single(),
                                 whole ? &whole->corners : nullptr);
  if (missed == Constraint::kNone && parts.single()) {
    const auto [tubing, fitting, valve] = parts.choices();
    if (!PartsMate(problem_, tubing, fitting, valve)) missed = Constraint::kMating;
  }
  return missed;
}

Bounds::KnownLine& Bounds::KnowLine(const LineKey& key, const LineParts* whole) {
  const auto [entry, fresh] = lines_.try_emplace(key);
  KnownLine& known = entry->second;
  if (!fresh && known.weights == weights_) return known;
  const LineParts parts = PartsOf(key);
  Weigh(parts, known);
  if (fresh) known.missed = Screen(key, parts, whole);
  return known;
}

void Bounds::Weigh(const LineParts& parts, KnownLine& known) const {
  known.objective = parts.objective();
  known.weights = weights_;
  known.least = false;
  if (known.line) known.line->objective = known.objective;
}

// Kept with the whole, since most are asked for again and again.
Bounds::KnownLine& Bounds::KnowHalf(KnownLine& whole, const LineParts& parts, int slot, int half,
                                    const LineKey& key) {
  if (whole.divided != slot) {
    whole.divided = slot;
    whole.halves = {};
  }
  KnownLine*& known = whole.halves[half];
  if (known == nullptr) known = &KnowLine(key, &parts);
  if (known->weights != weights_) Weigh(PartsOf(key), *known);
  return *known;
}

double Bounds::LineParts::objective() const {
  return corners.tube.objective + corners.valve.objective + corners.fitting.objective;
}

bool Bounds::LineParts::single() const {
  return std::all_of(nodes.begin(), nodes.end(), [](const BoxNode* n) { return n->single(); });
}

int Bounds::LineParts::widest() const {
  const auto spread = [](const BoxNode* node) {
    return node->single() ? -1.0 : node->objective_high - node->objective_low;
  };
  return static_cast<int>(
      std::max_element(nodes.begin(), nodes.end(),
                       [&](const BoxNode* a, const BoxNode* b) { return spread(a) < spread(b); }) -
      nodes.begin());
}

std::array<int, kSlotsPerGroup> Bounds::LineParts::places() const {
  return {nodes[0]->first, nodes[1]->first, nodes[2]->first};
}

bool Bounds::LineParts::HoldAll(const std::vector<LineChoice>& choices) const {
  return std::all_of(choices.begin(), choices.end(), [&](const LineChoice& choice) {
    for (int s = 0; s < kSlotsPerGroup; ++s)
      if (choice.places[s] < nodes[s]->first || choice.places[s] >= nodes[s]->last) return false;
    return true;
  });
}

std::array<int, kSlotsPerGroup> Bounds::LineParts::choices() const {
  return {trees.tubes.options[nodes[0]->first].index, trees.fittings.options[nodes[1]->first].index,
          trees.valves.options[nodes[2]->first].index};
}

Bounds::LineParts Bounds::PartsOf(const LineKey& key) const {
  const GroupTrees& trees = plan_.groups[key.group];
  const auto [tube, fitting, valve] = key.nodes;
  return {{&trees.tubes.nodes[tube], &trees.fittings.nodes[fitting], &trees.valves.nodes[valve]},
          {trees.tubes.corners[tube], trees.fittings.corners[fitting], trees.valves.corners[valve]},
          trees};
}

namespace {

// As many as are worth a look each: those that differ least are put together.
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

}  // namespace

// The limits of fall and rise and what mates with what already rule out the lightest lines of a
// box, each slot's lightest choice put together. So lines alone are searched best first, each found
// only if its coils take less than those of the lines before. After so many divisions parts of the
// box are taken for lines, those that would be looked at next first.
Constraint Bounds::FindChoices(const LineKey& key, KnownLine& whole,
                               std::vector<LineChoice>& choices) {
  constexpr int kDivisions = 500, kMoreDivisions = 60;  // for the first line, after it
  int divisions_max = kDivisions;
  struct Open {
    double above;
    LineKey key;
    KnownLine* known;
    bool operator<(const Open& other) const {  // lowest on top
      return above != other.above ? above > other.above : key > other.key;
    }
  };
  std::priority_queue<Open> open;
  open.push({whole.objective, key, &whole});
  Constraint missed = Constraint::kNone;
  choices.clear();
  for (int divisions = 0; !open.empty();) {
    const auto [above, lowest, lowest_known] = open.top();
    open.pop();
    const LineParts parts = PartsOf(lowest);
    const double coil_power_w = parts.corners.valve.coil_power_w;
    if (!choices.empty() && coil_power_w >= choices.back().coil_power_w) continue;
    if (parts.single() || divisions == divisions_max) {
      if (choices.empty()) divisions_max = std::min(divisions + kMoreDivisions, kDivisions);
      choices.push_back({above, coil_power_w});
      if (parts.single()) choices.back().places = parts.places();
      continue;
    }
    ++divisions;
    const int widest = parts.widest();
    for (int half : {0, 1}) {
      LineKey part = lowest;
      part.nodes[widest] = half == 0 ? parts.nodes[widest]->left : parts.nodes[widest]->right;
      KnownLine& known = KnowHalf(*lowest_known, parts, widest, half, part);
      if (known.missed == Constraint::kNone)
        open.push({std::max(above, known.objective), part, &known});
      else if (missed == Constraint::kNone || missed == Constraint::kMating)
        missed = known.missed;
    }
  }
  if (choices.empty()) return missed;
  Thin(choices);
  return Constraint::kNone;
}

void Bounds::TakeChoices(KnownLine& known, std::vector<LineChoice> choices) const {
  known.least = true;
  known.objective = known.line->objective = choices.front().objective;
  // What boxes have of it already was no more.
  known.line->coil_power_w = std::max(known.line->coil_power_w, choices.back().coil_power_w);
  known.line->choices = std::move(choices);
  known.line->weights = weights_;
}

void Bounds::CombineChoices(Box& box) {
  if (box.lines.size() == 1) {
    box.choices = {box.lines.front(), &box.lines.front()->choices};
    return;
  }
  std::vector<LineChoice> all{{}};
  for (const std::shared_ptr<const Line>& line : box.lines) {
    std::vector<LineChoice> sums, kept;
    for (const LineChoice& a : all)
      for (const LineChoice& b : line->choices)
        sums.push_back({a.objective + b.objective, a.coil_power_w + b.coil_power_w});
    std::sort(sums.begin(), sums.end(), [](const LineChoice& a, const LineChoice& b) {
      return a.objective != b.objective ? a.objective < b.objective
                                        : a.coil_power_w < b.coil_power_w;
    });
    for (const LineChoice& sum : sums)
      if (kept.empty() || sum.coil_power_w < kept.back().coil_power_w) kept.push_back(sum);
    Thin(kept);
    all = std::move(kept);
  }
  box.choices = std::make_shared<const std::vector<LineChoice>>(std::move(all));
}

Bounds::LineKey Bounds::KeyOf(const Box& box, int group) {
  const int first = kSlotsPerGroup * group;
  return {group, {box.nodes[first], box.nodes[first + 1], box.nodes[first + 2]}};
}

std::shared_ptr<Line> Bounds::Assemble(const LineKey& key) const {
  const LineParts parts = PartsOf(key);
  auto line = std::make_shared<Line>(AssembleLine(problem_, key.group, parts.corners));
  if (!parts.single()) return line;
  const auto [tubing, fitting, valve] = parts.choices();
  line->tubing = tubing;
  line->fitting = fitting;
  line->valve = valve;
  return line;
}

void Bounds::Make(const LineKey& key, KnownLine& known) {
  if (known.line) return;
  known.line = Assemble(key);
  ++lines_made_;
}

// From a larger box: the lines that it comes down to are those of each part that has all of them.
void Bounds::TakeOver(const Line& whole, const LineParts& parts, KnownLine& known) const {
  if (!known.least && whole.weights == weights_ && parts.HoldAll(whole.choices))
    TakeChoices(known, whole.choices);
  if (!known.finished && !parts.single())
    known.finished = FinishLike(whole, parts.corners.valve, *known.line);
}

// All but what they miss, which is asked far more often than of anything else.
void Bounds::ForgetLines() {
  for (const auto& [key, known] : lines_) verdicts_[key.group].Set(key.nodes, known.missed);
  lines_.clear();
  lines_made_ = 0;
}

Constraint Bounds::RemakeLine(Box& box, int group) {
  if (lines_.size() > kLinesKept || lines_made_ > kLinesMade) ForgetLines();
  const LineKey key = KeyOf(box, group);
  KnownLine& known = KnowLine(key);
  if (known.missed == Constraint::kNone) Make(key, known);
  // A part of a finished box, if that has not forgotten its lines.
  const bool divided = box.lines_finished && box.lines[group];
  if (divided && known.line) TakeOver(*box.lines[group], PartsOf(key), known);
  box.lines[group] = known.line;
  box.lines_finished = divided && known.line && known.least && known.finished;
  box.choices = nullptr;
  if (box.lines_finished) CombineChoices(box);
  return known.missed;
}

Constraint Bounds::FinishLines(Box& box) {
  box.lines_finished = true;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const LineKey key = KeyOf(box, g);
    KnownLine& known = KnowLine(key);
    // Choices are of the weights that they were found with.
    if (known.missed == Constraint::kNone && !known.least) {
      std::vector<LineChoice> choices;
      known.missed = FindChoices(key, known, choices);
      if (known.missed != Constraint::kNone) {
        known.least = true;
        known.line = nullptr;
      } else {
        Make(key, known);
        TakeChoices(known, std::move(choices));
      }
    }
    if (known.missed == Constraint::kNone && !known.finished) {
      const LineParts parts = PartsOf(key);
      known.finished = true;
      FinishLine(problem_, g, gas_, parts.corners.valve, parts.single(),
                 plan_.configuration == Configuration::kCompressor, *known.line);
      known.line->strokes = ++strokes_;
    }
    box.lines[g] = known.line;
    if (known.missed != Constraint::kNone) return known.missed;
  }
  CombineChoices(box);
  return Constraint::kNone;
}

}  // namespace plenum::optimizer
