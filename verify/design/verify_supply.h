// What a design must bear, and what its source has. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_SUPPLY_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_SUPPLY_H_

#include <map>
#include <string>

#include "verify/design/cycle/verify_cycle.h"
#include "verify/design/cycle/verify_rail.h"
#include "verify/design/cycle/verify_refill.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Source pressures that every part stands; none where low > high.
struct Pressures {
  double low_pa = 0.0, high_pa = kUnlimited;
};
Pressures StoodPressures(const Problem& problem, const Assembly& assembly);

// Whether the parts stand the pressures of the settings, each group's where it has its own.
bool Stand(const Problem& problem, const Settings& settings, const Assembly& assembly);

// Gas and energy on board, what fills the reservoir first, and what else the source limits.
struct Supply {
  double gas_m3 = kUnlimited, energy_j = kUnlimited;
  double first_fill_j = 0.0, first_fill_m3 = 0.0;
  double current_a = 0.0, frequency_hz = 0.0;
  Refilled refilled = {};  // of a tank that pumps go on filling
  RailBorne rail{.duty = 0.0, .per_cycle_j = 0.0, .first_fill_j = 0.0, .current_a = 0.0};
};
Supply SupplyOf(const Problem& problem, const Settings& settings, const Assembly& assembly,
                const Cycle& cycle);

// Of all cycles and the first fill, J.
double EnergyOf(const Problem& problem, const Supply& supply, const Cycle& cycle);

// Every requirement in the units of its field, with what a design reaches.
struct Reached {
  double required, achieved;
  bool at_most;
  double tolerance;
  double margin() const { return at_most ? 1.0 - achieved / required : achieved / required - 1.0; }
};
std::map<std::string, Reached> Requirements(const Problem& problem, const Settings& settings,
                                            const Totals& totals, const Assembly& assembly,
                                            const Cycle& cycle, const Supply& supply);
// The same but for the peaks of groups, which take long: StoodPressures() keeps them.
std::map<std::string, Reached> RequirementsBesidePeaks(const Problem& problem,
                                                       const Settings& settings,
                                                       const Totals& totals,
                                                       const Assembly& assembly, const Cycle& cycle,
                                                       const Supply& supply);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_SUPPLY_H_
