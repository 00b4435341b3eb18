// What a configuration offers: the choices of every family as trees of boxes, one slot each.
//
//   regulated:   tube, fitting, valve of each group; regulator, bottle, battery
//                (mains: no bottle, no battery; a tank stands in the place of a bottle, with a
//                compressor where one goes on filling it; a regulator of each group where they
//                have their own)
//   compressor:  tube, fitting, valve of each group; compressor, reservoir, battery
//   direct pump: tube, fitting, valve of each group; compressor, battery
//   vacuum pumps beside a regulated source (PumpsRail): also vacuum pump and its reservoir, between
//                bottle and battery
#ifndef PLENUM_OPTIMIZER_CHOICES_PLAN_H_
#define PLENUM_OPTIMIZER_CHOICES_PLAN_H_

#include <vector>

#include "optimizer/choices/corner.h"
#include "optimizer/problem/proof.h"

namespace plenum::optimizer {

inline constexpr int kSlotsPerGroup = 3;

// A family in a plan, whatever its corners.
struct Slot {
  Family family;
  int group = -1;
  const std::vector<BoxNode>* nodes = nullptr;
  const std::vector<Option>* options = nullptr;
  std::vector<ProofDominated> dominated;  // where MakePlan was asked to name them
};

struct GroupTrees {
  BoxTree<TubeCorner> tubes;
  BoxTree<FittingCorner> fittings;  // one choice of no part where the group needs none
  BoxTree<ValveCorner> valves;
};

// Inlet pressures of bottles that matter, and the gas that 1 m³ holds at them, m³ ANR.
struct BottleRange {
  double low_pa = 0.0, high_pa = 0.0;
};

// The vacuum beside a regulated source; no slots: pumps keep none.
struct RailTrees {
  BoxTree<CompressorCorner> pumps;
  BoxTree<ReservoirCorner> reservoirs;
  int pump_slot = -1, reservoir_slot = -1;
  bool Has(int slot) const { return slot >= 0 && (slot == pump_slot || slot == reservoir_slot); }
};

struct Plan {
  Plan() = default;
  Plan(const Plan&) = delete;  // slots point into the trees
  Plan& operator=(const Plan&) = delete;

  Configuration configuration;
  bool own_regulators = false;
  bool equal_flow = false;  // as in ProofPlan
  double tie = 0.0;
  bool shares_packs = false;  // a design may have a surplus (packs.h)
  std::vector<GroupTrees> groups;
  std::vector<BoxTree<RegulatorCorner>> regulators;  // one for all groups, or of each
  BoxTree<BottleCorner> bottles;
  BoxTree<CompressorCorner> compressors;
  BoxTree<ReservoirCorner> reservoirs;
  BoxTree<BatteryCorner> batteries;
  std::vector<Slot> slots;
  int bottle_slot = -1, compressor_slot = -1, reservoir_slot = -1, battery_slot = -1;
  RailTrees rail;
  std::vector<int> regulator_slots;  // as the trees of regulators

  BottleRange bottle_range;
  double highest_pump_pa = 0.0;

  BigCount combinations;  // the trees hold what unpriced and dominated ones leave of them
  Pruned pruned;
  bool empty() const;  // some slot has no choice
};

// Gas left in 1 m³ of a bottle at an inlet pressure, m³ ANR.
double GasLeft(const Problem& problem, Configuration configuration, double inlet_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLAN_H_
