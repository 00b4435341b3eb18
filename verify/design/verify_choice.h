// What one choice of a slot weighs, takes and costs. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_CHOICE_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_CHOICE_H_

#include "verify/design/verify_values.h"

namespace plenum::verify {

struct ItemAmounts {
  double mass_kg = 0.0, volume_m3 = 0.0, cost_eur = 0.0;
  // Share of the objective, with the energy that a coil or regulator takes at any speed.
  double objective = 0.0;
  double mass_slack_kg = 0.0, volume_slack_m3 = 0.0;  // of tolerances
  // What it may add to a design's cost otherwise, where other choices share packs with it.
  double pack_more_eur = 0.0, pack_less_eur = 0.0;
};

ItemAmounts& operator+=(ItemAmounts& sum, const ItemAmounts& more);  // all but the slacks
// Whether parts that come to so much are over a limit on amounts, whatever else there is, by more
// than `room`, relative.
bool TooMuch(const Problem& problem, const ItemAmounts& least, double room);

// All pieces of a choice, gas included; the least of a made-to-measure reservoir.
ItemAmounts ChoiceAmounts(const Problem& problem, const Layout& layout, const ProofSlot& slot,
                          const ProofItem& item);

using SlotAmounts = std::vector<std::vector<ItemAmounts>>;  // per slot and choice
SlotAmounts AmountsOfAll(const Problem& problem, const ProofPlan& plan);

// Gas that bottles give down to an inlet pressure, m³ ANR.
double GasOf(const Problem& problem, Family family, const ProofItem& item, double inlet_pa);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_CHOICE_H_
