// One listed design, put together again from the raw parts. Internal to verify*.cc.
//
// verify_assemble.cc: its parts and amounts. verify_performance.cc: against a simulation.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_DESIGN_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_DESIGN_H_

#include <optional>
#include <vector>

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

struct LineParts {
  const model::Tubing* tube = nullptr;
  const model::Fitting* fitting = nullptr;  // null: the group needs none
  const model::Valve* valve = nullptr;
  bool operator==(const LineParts&) const = default;
};

// Of the vacuum that pumps keep beside the source, and its weakest pressure, which falls are judged
// at.
struct RailParts {
  const model::Compressor* pump = nullptr;
  const model::Reservoir* reservoir = nullptr;
  int pumps = 0, reservoirs = 0;
  double weakest_pa = 0.0;
  double VolumeM3() const { return reservoirs * reservoir->volume_m3; }
};

struct Assembly {
  Configuration configuration = Configuration::kMains;
  std::vector<LineParts> lines;                          // per group
  std::vector<const model::Regulator*> regulators = {};  // none, one for all, or one a group
  const model::Cylinder* cylinder = nullptr;
  const model::Co2Bottle* co2 = nullptr;
  const model::Compressor* compressor = nullptr;
  const model::Battery* battery = nullptr;
  const model::Reservoir* reservoir = nullptr;  // null with a compressor: made to measure
  const model::Reservoir* tank = nullptr;       // with or without a regulator
  int bottles = 0, compressors = 0, batteries = 0, reservoirs = 0, tanks = 0;
  RailParts rail = {};
  // What strokes draw from, and what goes on filling a tank.
  const model::Compressor* pump() const { return tank ? nullptr : compressor; }
  const model::Compressor* filler() const { return tank ? compressor : nullptr; }
  bool direct() const { return IsDirect(configuration); }
  bool owns() const { return regulators.size() > 1; }  // each group has its own
  bool at_best = false;  // with a guarantee: valves that cannot hold as the parts are
  // Volume of stock reservoirs, and how much more they have while they rise.
  double ReservoirVolume() const { return reservoir ? reservoirs * reservoir->volume_m3 : 0.0; }
  double ReservoirSpread() const {
    return reservoir ? reservoirs * reservoir->volume_spread_m3 : 0.0;
  }
};

// Strokes, air and energy of one cycle of the periodic state.
struct Cycle {
  std::vector<double> rise_s, inflate_s, fall_s;  // per group; +∞: never reached
  std::vector<double> filled_pa;                  // per group, when its valve closes or it vents
  double air_m3 = 0.0;                            // ANR, by the contents at rest and filled
  double pump_on_s = 0.0, pump_j = 0.0, pump_air_m3 = 0.0;
  double node_pa = 0.0;  // of pumps without a reservoir: the highest between them and the valves
  double coil_w = 0.0;   // all on at once, with the regulator
  double steady_j = 0.0, inflating_j = 0.0;  // coils and regulator; of it what strokes shorten
  double electric_j() const { return steady_j + inflating_j; }
};

// The pressure of the source as a group has it, behind its own regulator where it has one.
inline double PressureAt(const Settings& settings, int group) {
  return settings.group_pressure_pa.empty() ? settings.source_pressure_pa
                                            : settings.group_pressure_pa[group];
}

// An actuator of the group with the bore of its tube.
model::Chamber ChamberOf(const ActuatorGroup& group, const LineParts& line);

// Puts a choice of a family into its place. ProofItem::part as there: −1 and −2 leave it empty.
void Place(const Problem& problem, Family family, int group, const ProofItem& item,
           Assembly& assembly);

// The parts of a design; none after a finding (unknown part, wrong number, missing family).
std::optional<Assembly> Assemble(const Problem& problem, const Design& design, Findings& findings);

// Parts that do not fit together, rows and totals that are not those of the parts.
void CheckAmounts(const Problem& problem, const Design& design, const Assembly& assembly,
                  Findings& findings);

// Packs that are not what the parts are sold in; in verify_packs.cc.
void CheckPacks(const Problem& problem, const Design& design, Findings& findings);

// Strokes, air, energy, duties and margins against a simulation of the periodic state. False where
// the simulator did not get there, or was stopped: nothing is known then.
bool CheckPerformance(const Problem& problem, const Design& design, const Assembly& assembly,
                      const Stop& stop, Findings& findings);

// Sums over all pieces, without energy; a made-to-measure reservoir is that of the settings.
Totals TotalsOf(const Problem& problem, const Assembly& assembly, const Settings& settings);
// What mass and volume may be more, as limits on them have it.
Totals SlackOf(const Problem& problem, const Assembly& assembly, const Settings& settings);
double ObjectiveOf(const Problem& problem, const Totals& totals);

// Which parts fit together.
bool Fit(const model::Tubing& tube, const model::Fitting& fitting);
bool Fit(const model::Fitting& fitting, const model::Valve& valve);
bool Fit(const Problem& problem, const Assembly& source);  // regulator and bottle, pump and pack

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_DESIGN_H_
