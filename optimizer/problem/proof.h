// The record of a search: all that an independent checker needs to see that no combination was
// overlooked. Plain values; SI, absolute pressures.
//
// A search looks at one plan per configuration. A plan has slots, each filled with one choice: for
// every group of actuators a tube, a fitting and a valve, then the families of the source. A choice
// is a part of the slot's family and how many of it stand in parallel (always 1 in the slots of a
// group and for regulators; there the numbers of pieces follow from the group).
//
// A configuration whose groups may have regulators of their own (own_regulators.h) has a plan of
// them, too, with a slot of regulators for each group.
//
// 1. Choices. Slot::choices lists those that the search looked at, in an order that makes every box
//    a range. Slot::dominated lists those left out because of `k` others each, where k is the
//    number of designs wanted (ProofRecord::count); in a list of kinds because of one other of the
//    same series (or of any, in families that make no kinds), or of OtherSeriesNeeded() others of
//    different series (kind.h). Choices without a price where cost matters are in neither list. A
//    checker sees that the three make up the family.
//    A dominates B if at every setting B can be replaced by A without missing a requirement:
//      * amounts (mass; outer volume; cost) of A are no larger where a limit is on them, and A's
//        share of the objective is smaller by more than Plan::tie, or no larger while A's
//        (id, quantity) comes first in the order of bytes; of packs that other choices may share
//        (packs.h of evaluate/) A counts with the most that they cost, B with the least;
//      * tube: same outer and inner diameter, pressure_max no smaller;
//        fitting: same diameter and thread, C, b, pressure_max no smaller;
//        valve: same port, both hold or neither does, C and b of fill and exhaust no smaller, coil
//        power of the group no larger, pressure_max no smaller, pressure_min no larger, and no
//        larger what it lets by while it closes late (LetBy of part_tables.h);
//        regulator: C, b, flow_max, inlet and outlet maximum no smaller, inlet and outlet minimum
//        and power no larger; a tank's choice of no regulator stands for no other, nor one for it;
//        cylinder, CO2 bottle: usable gas no smaller at every inlet pressure in use, fill pressure
//        no higher, sustained flow no smaller;
//        compressor: same curve and number, duty_max no smaller;
//        battery: drives the same compressors, usable energy, current, voltage no smaller;
//        reservoir: same volume, pressure_max no smaller;
//        tank: volume and pressure_max no smaller; its amounts count with the air of the highest
//        inlet pressure in use, or the highest that a tank is filled to, since a larger one keeps
//        more at the end.
//      Where Plan::equal_flow is set, C and b of a line's parts must be equal: several groups on
//      one source may take air from each other, a pump may take more energy per air at low pressure
//      than at high, and pumps that hold on hold what is full sooner the longer. But for mains they
//      must also be equal of valves that cannot hold, and where the catalogue has such a valve of
//      fittings and regulators: the more flows while it stands open the more air it takes. Where
//      valves close late (closing.h of evaluate/; never with pumps alone) C and b of fittings must
//      be equal, too: the higher is the peak.
//
// 2. Boxes. Plan::boxes is the tree of boxes in preorder. A box is a range of choices per slot; the
//    first box is all of them. kSplit divides the range of one slot at `middle`: the left part,
//    with everything below it, follows, then the right part. Every other kind ends a branch:
//      kInfeasible    the corner of the box, the best value of every number over its choices
//                     (more is not better: both ends), misses `constraint`;
//      kBound         no design in the box has an objective below `bound`;
//      kOrder         as kBound, and every design in it whose objective ties with the last one
//                     listed comes after it (tie_key.h); also where the choices that dominate those
//                     of the box make as many better combinations of each in it as are wanted;
//      kKind          as kBound; all in it are of a kind of which a design is listed that is no
//                     worse than `bound` (where they tie, earlier), or of a source of which as
//                     many kinds are listed before it as there may be;
//      kDesign        a single combination that is listed; `design` is its index in the answer;
//      kNotListed     a single combination that is feasible, with its objective as `bound`;
//      kRefuted       a single combination for which no setting meets the requirements;
//      kUndecided     a single combination that could be neither sized nor refuted.
//    Ranges are half-open; choices keep the order of Slot::choices.
//
// The corner at its best takes: the exact march through the largest C and b of each element into
// the smallest dead volume, from the highest source pressure that any of the choices stands, and at
// which the peak of the slowest to fill keeps the limit where it closes as late as the soonest of
// the box (closing.h); the least air, coil power and amounts (a tank with the air that is left at
// the highest operating pressure, and what the mission takes on top); and for bottles, tanks,
// batteries and reservoirs the least objective of those in the box that bear this need. A bound may
// also rest on divisions of the box that are not recorded: of the lines in it only those count that
// mate and are fast enough on an unlimited source; and behind a regulator that several groups draw
// from at once, those that make do with the mean pressure that the least air of the others leaves
// at the node behind it, at the highest of the source pressures that they work at. In a
// compressor's box each group counts as if it were alone on the reservoir, with the largest
// delivery of the box at each pressure; of two groups that take turns each leaves enough for the
// other. A tank without a regulator keeps its highest pressure; no box is fed with more than every
// group's lines stand, the highest of all lines of each that are fast enough. Of pumps alone
// optimizer/pump/direct_bound.h says the rest. With regulators of their own each group counts by
// itself, and the bottle must bear the highest of their pressures.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PROOF_H_
#define PLENUM_OPTIMIZER_PROBLEM_PROOF_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "optimizer/problem/big_count.h"

namespace plenum::optimizer {

enum class Configuration;
enum class Family;

struct ProofItem {
  std::int32_t part = 0;  // index into the family's list of Problem::parts; −2 made to measure,
                          // −1 none (fittings of a group that needs none, a tank's regulator)
  std::int32_t quantity = 1;
  bool operator==(const ProofItem&) const = default;
};

struct ProofDominated {
  ProofItem item;
  std::vector<ProofItem> dominators;  // enough of them, all among the slot's choices
};

struct ProofSlot {
  Family family;
  std::int32_t group = -1;  // −1: the source
  std::vector<ProofItem> choices;
  std::vector<ProofDominated> dominated;
};

enum class BoxKind : std::uint8_t {
  kSplit,
  kInfeasible,
  kBound,
  kOrder,
  kDesign,
  kNotListed,
  kRefuted,
  kUndecided,
  kKind
};

// What a corner misses.
enum class Constraint : std::uint8_t {
  kNone,
  kMating,    // diameters, threads, voltages, pressure of a bottle at its regulator
  kPressure,  // no source pressure suits all parts
  kRise,      // rise time, or inflation within half of the period
  kFall,
  kGas,      // no bottle holds or gives off enough
  kBattery,  // no battery has the energy and current
  kPump,     // the pumps would run too long, or no reservoir helps them
  kAmounts   // mass, volume or cost limit
};

struct ProofBox {
  BoxKind kind = BoxKind::kUndecided;
  Constraint constraint = Constraint::kNone;  // kInfeasible
  std::int16_t slot = -1;                     // kSplit
  std::int32_t middle = 0;                    // kSplit: first choice of the right part
  std::int32_t design = -1;                   // kDesign
  double bound = 0.0;                         // kBound, kOrder, kKind, kNotListed
};

struct ProofPlan {
  Configuration configuration;
  bool own_regulators = false;
  bool equal_flow = false;
  double tie = 0.0;
  std::vector<ProofSlot> slots;
  std::vector<ProofBox> boxes;
};

struct ProofRecord {
  int count = 0;
  std::vector<ProofPlan> plans;
};

struct Pruned {
  BigCount incompatible, infeasible, bound, dominated, unpriced;
};

struct Proof {
  BigCount combinations;
  bool complete = false;
  double lower_bound = 0.0;  // of the objective of every design not listed
  double gap = 0.0;
  long long boxes = 0;      // looked at
  BigCount evaluated;       // leaves sized
  long long simulated = 0;  // designs that went through the simulator
  long long undecided = 0;  // leaves that could be neither sized nor refuted
  Pruned pruned;
  std::shared_ptr<const ProofRecord> record;  // where SearchOptions asks for it
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PROOF_H_
