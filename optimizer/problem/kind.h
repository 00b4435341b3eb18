// The kind of a design: what people take for the same idea, whatever the numbers of pieces, tubes,
// fittings, batteries and reservoirs. That is its configuration, the series of its sources (pump,
// bottle, tank, or tank and pump; none for the mains), and the sets of the series of its regulators
// (none for some tanks) and of its valves, whichever group has which. A part without a series is
// its own.
//
// A list of kinds holds the best design of each of the best kinds, of kinds with the same
// configuration and source at most Limits::per_source.
#ifndef PLENUM_OPTIMIZER_PROBLEM_KIND_H_
#define PLENUM_OPTIMIZER_PROBLEM_KIND_H_

#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {

// The number of a choice of no part.
inline constexpr int kNoPart = std::numeric_limits<int>::max();

struct Kind {
  Configuration configuration{};
  std::vector<int> sources = {};                  // series, by number; in the order of a design
  std::vector<int> regulators = {}, valves = {};  // the same, ascending, each once

  // A part of this series, in this role; kNoPart changes nothing.
  void Add(KindRole role, int number);
  using Sources = std::pair<Configuration, std::vector<int>>;
  Sources Source() const { return {configuration, sources}; }
  bool operator<(const Kind& other) const {
    return std::tie(configuration, sources, regulators, valves) <
           std::tie(other.configuration, other.sources, other.regulators, other.valves);
  }
  bool operator==(const Kind& other) const = default;
};

// A series by number: the index of the first part of the family that has it. Of each part.
std::vector<int> SeriesOf(const model::Parts& parts, Family family);

// Kinds of designs made of these parts.
class DesignKinds {
 public:
  explicit DesignKinds(const model::Parts& parts);

  // Of each part of a family that has to do with kinds.
  const std::vector<int>& SeriesOf(Family family) const { return series_.at(family); }
  // Of a design with these rows in its parts list.
  Kind Of(Configuration configuration, const std::vector<Choice>& choices) const;

 private:
  std::map<Family, std::vector<int>> series_;
  std::map<Family, std::unordered_map<std::string_view, int>> of_id_;  // the ids are the parts'
};

// A family's choices that cannot be the best of their kind, or be among the kinds that are listed,
// may be left out: those for which one of the same series, or this many of different other series,
// are at least as good. A choice of another source makes another kind and another source; one of
// another regulator another kind of the same source; so does another valve, unless another group
// has its series already, and so does another regulator where each group has its own.
int OtherSeriesNeeded(const Problem& problem, Family family, bool own_regulators = false);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_KIND_H_
