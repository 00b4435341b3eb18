// What a partly chosen candidate needs at least of air, energy and current, which parts bear it,
// and what they add to the objective.
#ifndef PLENUM_OPTIMIZER_NEEDS_H_
#define PLENUM_OPTIMIZER_NEEDS_H_

#include "optimizer/expand.h"

namespace plenum::optimizer {

double EnergyObjective(const Problem& problem, double energy_per_cycle_j);
double LineObjective(const Problem& problem, const Line& line);  // coils included

// Objective of what the parent has chosen, coils included.
double ChosenObjective(const Problem& problem, const Candidate& parent);

bool WithinLimits(const Problem& problem, const Amounts& amounts);

// Needs of what is chosen so far, with the least of what is not, per cycle.
struct Need {
  double air_m3 = 0.0;
  double air_to_target_m3 = 0.0;
  double source_min_pa = 0.0;
  double coil_j = 0.0;
  double coil_power_w = 0.0;
  PumpNeed pump;
  double energy_j = 0.0;  // coils, regulator and pumps
};

// `next`: the line of the first group that has none yet.
Need LeastNeed(const Problem& problem, const Tree& tree, const Candidate& candidate,
               const Line* next = nullptr);

// Energy of a mission beyond the coils, which LineObjective counts, as a share of the objective.
double PumpObjective(const Problem& problem, const Need& need, double energy_j);

bool PumpBears(const Problem& problem, const Candidate& candidate, const Need& need);

// What a battery must bear.
struct BatteryNeed {
  double energy_j;  // whole mission
  double coil_power_w;
  double pump_current_a;
};

// Current of the pumps at the lowest useful source pressure.
double PumpCurrent(const Problem& problem, const Candidate& candidate);
double UsableEnergy(const Problem& problem, const Option& battery);
bool BatteryBears(const Problem& problem, const Option& option, const BatteryNeed& need);

// Whether bottles hold enough gas, and CO2 evaporates fast enough, at a source pressure that is at
// least needed (less gas is left to use at a higher one).
bool BottleBears(const Problem& problem, const Candidate& candidate, const Option& option,
                 const Need& need, double source_pa);

// Objective of the lightest battery that bears the need; +∞ if none does.
double LeastBattery(const Problem& problem, const Tree& tree, const Candidate& candidate,
                    const BatteryNeed& need);

// Least objective of a reservoir of at least `volume_m3`; +∞ if there is none.
double LeastReservoir(const Problem& problem, const Tree& tree, double volume_m3);
double StockVolume(const Problem& problem, const Option& reservoir);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_NEEDS_H_
