// The single lines of one group in the order of their objective, found as far as they are asked
// for: best first over boxes of lines, without those that miss a requirement on any source there
// is. All boxes of combinations look for their lines in it, so that the cost of a group does not
// depend on how many others there are.
#ifndef PLENUM_OPTIMIZER_BOUNDS_LINE_LIST_H_
#define PLENUM_OPTIMIZER_BOUNDS_LINE_LIST_H_

#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "optimizer/bounds/node_need.h"
#include "optimizer/choices/known_lines.h"

namespace plenum::optimizer {

struct ListedLine {
  double objective = 0.0, coil_power_w = 0.0;
  NodeMeans needs;
  double source_min_pa = 0.0, source_max_pa = 0.0;  // that its parts stand and work at
  std::array<int, kSlotsPerGroup> places{};         // as in LineChoice
};

// What is asked of a line: which choices, and what there is at the node. `least`: what it needs of
// one of the means or more, so that it takes no more from others than it must.
struct LineAsk {
  std::array<int, kSlotsPerGroup> first{}, last{};  // half-open, in the orders of the trees
  NodeMeans most, least;
  double source_low_pa = 0.0, source_high_pa = 0.0;  // it works somewhere in between
  bool operator<(const LineAsk& other) const {
    return std::tie(first, last, most, least, source_low_pa, source_high_pa) <
           std::tie(other.first, other.last, other.most, other.least, other.source_low_pa,
                    other.source_high_pa);
  }
  bool Admits(const ListedLine& line) const {
    for (int s = 0; s < kSlotsPerGroup; ++s)
      if (line.places[s] < first[s] || line.places[s] >= last[s]) return false;
    const bool tight =
        line.needs.rise_pa >= least.rise_pa || line.needs.inflate_pa >= least.inflate_pa;
    return tight && line.needs.Within(most) && line.source_max_pa >= source_low_pa &&
           line.source_min_pa <= source_high_pa;
  }
};

class LineList {
 public:
  using Nodes = KnownLines::Nodes;
  struct Box {
    double objective = 0.0;  // of its lines, at least
    bool single = false;
    ListedLine line;                // of a single one
    std::array<Nodes, 2> halves{};  // else
  };
  // What is known of a box; none where no line of it will do.
  using Look = std::function<bool(const Nodes& nodes, Box& box)>;

  // The line at a place of the order, looking at no more than so many boxes; null where it is not
  // found by then, or where there are no more.
  const ListedLine* At(std::size_t place, int looks, const Look& look);
  // First place with at least this objective.
  std::size_t PlaceOf(double objective) const;
  // Least objective of lines that are not found yet; +∞ where all are.
  double Beyond() const;

 private:
  struct Open {
    double objective;
    Nodes nodes;
    bool operator<(const Open& other) const {  // lowest on top
      return objective != other.objective ? objective > other.objective : nodes > other.nodes;
    }
  };
  std::priority_queue<Open> open_;
  std::vector<ListedLine> found_;
  bool begun_ = false;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_LINE_LIST_H_
