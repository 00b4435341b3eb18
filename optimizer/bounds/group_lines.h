// The lines of each of several groups by themselves.
//
// Given the pressure in front of a regulator, and what the others leave of it at the node behind
// (node_need.h), the lines of a group are chosen without those of the others: the least of a box of
// combinations are sums over groups. Each group's single lines stand in one list (line_list.h) in
// which all boxes look, so that cost grows with the sum of the groups and not with their product.
#ifndef PLENUM_OPTIMIZER_BOUNDS_GROUP_LINES_H_
#define PLENUM_OPTIMIZER_BOUNDS_GROUP_LINES_H_

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "optimizer/bounds/line_list.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/choices/plan.h"

namespace plenum::optimizer {

// Sums of a choice of each, those that no other is no worse than; as many as are worth a look.
std::vector<LineChoice> SumsOf(const std::vector<LineChoice>& a, const std::vector<LineChoice>& b);
// As many as are worth a look each: those that differ least are put together.
void Thin(std::vector<LineChoice>& choices);

class GroupLines {
 public:
  using Nodes = KnownLines::Nodes;  // a box of lines: one node of each tree of the group

  // `bench` says when to stop; may be null.
  GroupLines(const Problem& problem, const Plan& plan, const Workbench* bench);

  // Of one box of lines per group, whose corners are `lines`, the least that work behind a
  // regulator whose source pressure lies in the window: by rising objective, each with less coil
  // power than the one before. Empty where some group has none.
  std::vector<LineChoice> LeastBehind(const std::vector<Nodes>& boxes,
                                      const std::vector<const Line*>& lines, const Window& window,
                                      NodeSource source);

  // The single line of a group with the least objective that makes do with these means at the node,
  // needs this share of one of them, and works at this source pressure, by the leaves of its parts.
  std::optional<Nodes> LeastAt(int group, const NodeMeans& most, double share, double source_pa);

  // The single line that makes do with the least at the node and works at this source pressure.
  std::optional<Nodes> StrongestAt(int group, double source_pa);

  // The objective has other weights of the amounts, and so have the trees.
  void ChangeWeights();

 private:
  using Key = std::pair<int, Nodes>;  // group and box
  const std::optional<NodeMeans>& NeedOf(int group, const Nodes& nodes);
  const NodeMeans& MostOf(int group);
  bool Look(int group, const Nodes& nodes, LineList::Box& box);
  LineAsk AskOf(int group, const Nodes& nodes) const;
  const std::vector<LineChoice>& Least(int group, const Nodes& nodes, const LineAsk& ask);

  const Problem& problem_;
  const Plan& plan_;
  const Workbench* bench_;
  model::Gas gas_;
  std::vector<int> like_;        // per group: the first that is asked the same of its lines
  std::vector<LineList> lists_;  // per group
  std::vector<NodeMeans> most_;  // the most there is at the node; once asked
  std::map<Key, std::optional<NodeMeans>> needs_;  // of boxes; none: no line of it is in time
  std::map<std::pair<int, LineAsk>, std::vector<LineChoice>> least_;
  std::vector<LineChoice> unfinished_;  // what was found when told to stop, which is not kept
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_GROUP_LINES_H_
