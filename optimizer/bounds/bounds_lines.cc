// What is known of boxes of lines, whatever the source: whether their strokes may be in time, their
// least objective, and the line of their corner, once for all boxes that share them.
#include <algorithm>
#include <queue>

#include "optimizer/bounds/box.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {
namespace {

constexpr std::size_t kLinesMade = 50'000;  // are kept, of 2.7 kB each

}  // namespace

Constraint Bounds::Screen(const LineKey& key, const LineParts& parts,
                          const LineParts* whole) const {
  const Constraint missed =
      ScreenLine(problem_, key.group, GasOf(plan_.configuration), parts.corners, parts.single(),
                 whole ? &whole->corners : nullptr);
  if (missed != Constraint::kNone || !parts.single()) return missed;
  const auto [tubing, fitting, valve] = parts.choices();
  return PartsMate(problem_, tubing, fitting, valve) ? Constraint::kNone : Constraint::kMating;
}

KnownLines::Known Bounds::Know(const LineKey& key, const LineParts* whole) {
  KnownLines& lines = lines_[key.group];
  if (const KnownLines::Known* known = lines.Find(key.nodes)) return *known;
  const auto screened = KnownLines::Known::Missing(Screen(key, PartsOf(key), whole));
  lines.Set(key.nodes, screened);
  return screened;
}

Bounds::MadeLine& Bounds::LineOf(const LineKey& key, KnownLines::Known known) {
  if (known.line() < 0) return Keep(key, Assemble(key));
  MadeLine& made = made_[known.line()];
  if (made.weights != weights_) {
    made.line->objective = PartsOf(key).objective();
    made.least = false;
    made.weights = weights_;
  }
  return made;
}

Bounds::MadeLine& Bounds::Keep(const LineKey& key, std::shared_ptr<Line> line) {
  lines_[key.group].Set(key.nodes, KnownLines::Known::Made(static_cast<int>(made_.size())));
  return made_.emplace_back(MadeLine{.key = key, .line = std::move(line), .weights = weights_});
}

double Bounds::ObjectiveKnown(const LineParts& parts, KnownLines::Known known) const {
  if (known.line() >= 0)
    if (const MadeLine& made = made_[known.line()]; made.least && made.weights == weights_)
      return made.line->objective;
  return parts.objective();
}

LineParts Bounds::PartsOf(const LineKey& key) const {
  return optimizer::PartsOf(plan_.groups[key.group], key.nodes);
}

// The limits of fall and rise and what mates with what already rule out the lightest lines of a
// box, each slot's lightest choice put together. So lines alone are searched best first, each found
// only if its coils take less than those of the lines before. After so many divisions parts of the
// box are taken for lines, those that would be looked at next first.
Constraint Bounds::FindChoices(const LineKey& key, std::vector<LineChoice>& choices) {
  constexpr int kDivisions = 500, kMoreDivisions = 60;  // for the first line, after it
  int divisions_max = kDivisions;
  struct Open {
    double above;
    LineKey key;
    bool operator<(const Open& other) const {  // lowest on top
      return above != other.above ? above > other.above : key > other.key;
    }
  };
  std::priority_queue<Open> open;
  open.push({PartsOf(key).objective(), key});
  Constraint missed = Constraint::kNone;
  choices.clear();
  for (int divisions = 0; !open.empty();) {
    const auto [above, lowest] = open.top();
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
      const KnownLines::Known known = Know(part, &parts);
      if (known.missed() == Constraint::kNone)
        open.push({std::max(above, ObjectiveKnown(PartsOf(part), known)), part});
      else if (missed == Constraint::kNone || missed == Constraint::kMating)
        missed = known.missed();
    }
  }
  if (choices.empty()) return missed;
  Thin(choices);
  return Constraint::kNone;
}

Constraint Bounds::FindLeast(const LineKey& key, MadeLine& made) {
  if (made.least) return Constraint::kNone;
  std::vector<LineChoice> choices;
  const Constraint missed = FindChoices(key, choices);
  if (missed == Constraint::kNone)
    TakeChoices(made, std::move(choices));
  else
    lines_[key.group].Set(key.nodes, KnownLines::Known::Missing(missed));
  return missed;
}

void Bounds::TakeChoices(MadeLine& made, std::vector<LineChoice> choices) const {
  made.least = true;
  Line& line = *made.line;
  line.objective = choices.front().objective;
  // What boxes have of it already was no more.
  line.coil_power_w = std::max(line.coil_power_w, choices.back().coil_power_w);
  line.choices = std::move(choices);
  line.weights = weights_;
}

void CombineChoices(Box& box) {
  if (box.lines.size() == 1) {
    box.choices = {box.lines.front(), &box.lines.front()->choices};
    return;
  }
  std::vector<LineChoice> all{{}};
  for (const std::shared_ptr<const Line>& line : box.lines) all = SumsOf(all, line->choices);
  box.choices = std::make_shared<const std::vector<LineChoice>>(std::move(all));
}

Bounds::LineKey Bounds::KeyOf(const Box& box, int group) {
  const int first = kSlotsPerGroup * group;
  return {group, {box.nodes[first], box.nodes[first + 1], box.nodes[first + 2]}};
}

std::shared_ptr<Line> Bounds::Assemble(const LineKey& key) const {
  const LineParts parts = PartsOf(key);
  auto line = std::make_shared<Line>(
      AssembleLine(problem_, key.group, GasOf(plan_.configuration), parts.corners, parts.single()));
  if (!parts.single()) return line;
  const auto [tubing, fitting, valve] = parts.choices();
  line->tubing = tubing;
  line->fitting = fitting;
  line->valve = valve;
  return line;
}

// From a larger box: the lines that it comes down to are those of each part that has all of them.
void Bounds::TakeOver(const Line& whole, const LineParts& parts, MadeLine& made) const {
  if (!shared_ && !made.least && whole.weights == weights_ && parts.HoldAll(whole.choices))
    TakeChoices(made, whole.choices);
  if (!made.finished && !parts.single())
    made.finished = FinishLike(whole, parts.corners.valve, *made.line);
}

// All but what they miss, which is asked far more often than of anything else.
void Bounds::ForgetLines() {
  for (int i = 0; i < static_cast<int>(made_.size()); ++i)
    lines_[made_[i].key.group].ForgetLine(made_[i].key.nodes, i);
  made_.clear();
}

Constraint Bounds::RemakeLine(Box& box, int group) {
  if (made_.size() > kLinesMade) ForgetLines();
  const LineKey key = KeyOf(box, group);
  const KnownLines::Known known = Know(key);
  if (known.missed() != Constraint::kNone) return known.missed();
  MadeLine& made = LineOf(key, known);
  // A part of a finished box, if that has not forgotten its lines.
  const bool divided = box.lines_finished && box.lines[group];
  if (divided) TakeOver(*box.lines[group], PartsOf(key), made);
  box.lines[group] = made.line;
  box.lines_finished = divided && (made.least || shared_) && made.finished;
  box.choices = nullptr;
  if (box.lines_finished && !shared_) CombineChoices(box);
  return Constraint::kNone;
}

Constraint Bounds::FinishLines(Box& box) {
  box.lines_finished = true;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const LineKey key = KeyOf(box, g);
    const KnownLines::Known known = Know(key);
    if (known.missed() != Constraint::kNone) return known.missed();
    MadeLine& made = LineOf(key, known);
    if (!shared_)
      if (const Constraint missed = FindLeast(key, made); missed != Constraint::kNone)
        return missed;
    if (!made.finished) {
      const LineParts parts = PartsOf(key);
      made.finished = true;
      FinishLine(problem_, g, GasOf(plan_.configuration), parts.corners.valve, parts.single(),
                 IsPumped(plan_.configuration), *made.line);
      made.line->strokes = ++strokes_;
    }
    box.lines[g] = made.line;
  }
  if (!shared_) CombineChoices(box);
  return Constraint::kNone;
}

}  // namespace plenum::optimizer
