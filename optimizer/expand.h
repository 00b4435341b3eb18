// The tree of combinations: for each configuration the families in the order in which the search
// fixes them, and the children of a node with their bounds.
//
//   regulated:   regulator → line of each group → cylinder or CO2 → battery   (mains: no bottle, no
//   battery) compressor:  compressor → line of each group → battery → reservoir
//
// The order puts first what decides the source pressure; every later family then has a need (air,
// energy, current) that is known from below, so that the lightest part that meets it bounds the
// rest.
#ifndef PLENUM_OPTIMIZER_EXPAND_H_
#define PLENUM_OPTIMIZER_EXPAND_H_

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "optimizer/candidate.h"
#include "optimizer/pump_bounds.h"
#include "optimizer/source_options.h"

namespace plenum::optimizer {

enum class Stage { kRegulator, kCompressor, kLine, kBottle, kBattery, kReservoir };

struct StageInfo {
  Stage stage;
  int group = -1;  // kLine
  BigCount total;  // choices that the contract counts
  BigCount below;  // product of the totals of all later stages
  Amounts least;   // componentwise least of all later stages
};

// What a configuration offers, and figures that bounds share.
struct Tree {
  Configuration configuration;
  std::vector<StageInfo> stages;
  std::vector<std::shared_ptr<const LineSet>> lines;  // per group
  OptionSet regulators, bottles, compressors, batteries, reservoirs;
  // Per group, over its lines:
  std::vector<double> line_objective_least;  // coils included
  std::vector<double> air_least_m3;          // of one stroke of the whole group
  std::vector<double> coil_least_j;          // per cycle
  // Per compressor of the problem:
  std::vector<PumpFacts> pumps;
  std::vector<std::vector<Option>> pump_batteries;  // that match its voltage, by rising objective
  std::vector<double> pump_energy_max_j;            // most that such batteries hold
  bool custom_allowed = false;
  // Stock reservoirs by rising volume, each with the least objective of those no smaller.
  std::vector<std::pair<double, double>> reservoir_by_volume;
  double smallest_reservoir_m3 = 0.0, largest_reservoir_m3 = 0.0;
  // With several groups: the problem of each group alone, and its pump facts per compressor.
  std::vector<Problem> alone;
  std::vector<std::vector<PumpFacts>> alone_pumps;
  // What a line needs of reservoirs when its group is alone on some compressors; filled as asked
  // for.
  using LineOnPumps = std::tuple<int, int, const Line*>;  // compressor, quantity, line
  mutable std::map<LineOnPumps, std::vector<ReservoirNeed>> alone_needs;
  BigCount combinations;
};

// `air_lines` or CO2 lines per group as the configuration needs.
Tree MakeTree(const Problem& problem, Configuration configuration,
              std::vector<std::shared_ptr<const LineSet>> lines);

struct Child {
  double bound;  // no design below it has a lower objective
  Option option;
  const Line* line = nullptr;  // kLine
};

struct Children {
  std::vector<Child> list;                                   // by rising bound
  long long incompatible = 0, infeasible = 0, unpriced = 0;  // choices left out of the list
  double source_floor_pa = 0.0;  // for the candidates below, as in Candidate
  double source_cap_pa = kUnlimited;
};

Children Expand(const Problem& problem, const Tree& tree, const Candidate& parent, int stage);

// Bound from below on the objective of everything below a candidate of several groups on a
// compressor whose reservoir is not chosen yet, from what its lines need of battery and reservoir;
// −∞ elsewhere. Costs more than the bounds of Expand, and far less than another Expand.
double SharedSourceBound(const Problem& problem, const Tree& tree, const Candidate& candidate);

// `parent` with the choice made.
Candidate Chosen(const Tree& tree, const Candidate& parent, int stage, const Children& children,
                 const Child& child);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPAND_H_
