// Regulators of their own: one for each group, after the common source.
//
// Each group then has its own pressure, and groups have nothing to do with each other but what they
// take together of gas, power, mass, volume and cost: a group's strokes are those of its own lines
// on its own regulator, whatever the others do. A bottle or a tank must keep, to the end, the
// highest inlet pressure that one of the regulators asks.
//
// A pump's reservoir feeds its lines itself, so that it has no such designs, and neither have an
// open tank, a vacuum from the wall, and two sides of one actuator (ActuatorGroup::entry), which
// would need two regulators; nor mains whose flow is limited where groups may draw at once, since
// they would share it, nor groups of a revised model.
#ifndef PLENUM_OPTIMIZER_PROBLEM_OWN_REGULATORS_H_
#define PLENUM_OPTIMIZER_PROBLEM_OWN_REGULATORS_H_

#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// A configuration, with or without regulators of their own for its groups.
struct Layout {
  Configuration configuration{};
  bool own_regulators = false;
  bool operator==(const Layout&) const = default;
};

// Whether groups of the problem may have regulators of their own behind such a source.
bool MayOwnRegulators(const Problem& problem, Configuration configuration);

// What a search of the problem looks at: of a configuration that may have regulators of their own
// what Problem::regulation says, of another one the plain layout.
std::vector<Layout> LayoutsOf(const Problem& problem);
std::vector<Layout> LayoutsOf(const Problem& problem, Configuration configuration);

// Whether rows of a parts list have regulators of groups.
bool HasOwnRegulators(const std::vector<Choice>& rows);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_OWN_REGULATORS_H_
