// Vacuum pumps beside a pressure supply (PumpsRail()): they keep the rail that pulls actuators
// under pressure below ambient.
//
// The rail is a vacuum reservoir of volume V that n pumps keep between two pressures. In each
// period it takes the air A, m³ ANR, that its actuators hand over on their way from the operating
// to the low pressure, as if all at once and while no pump runs: it rises by w = A·P0·(T/T0)/V from
// the pressure at which the pumps stop to its weakest, which lines are judged with all the while.
// Then the pumps bring it back, each in t = V/P0·(T0/T)·∫dP/(n·Q(P)) (P: mirrored pressures,
// chamber.h), no longer than their duty allows of the period. Their current counts as the largest
// from ambient to where they stop.
//
// Time, energy and current grow with the air and with the depth of the rail; falls only get
// shorter. The weakest pressure is a setting; where it is not given it is the weakest at which all
// falls are in time, so that pumps and battery bear the least.
// Source: balance of mass.
#ifndef PLENUM_OPTIMIZER_EVALUATE_PUMPED_RAIL_H_
#define PLENUM_OPTIMIZER_EVALUATE_PUMPED_RAIL_H_

#include <optional>
#include <span>
#include <vector>

#include "model/physics/compressor.h"
#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {

struct Candidate;

// The deepest pressure that the pumps may come to, which chambers are bounded with.
void SetRailFloor(double floor_pa, Problem& problem);
// The lowest of the low pressures: no weaker rail comes to it.
double HighestRailPa(const Problem& problem);

struct RailSource {
  const model::CompressorCurve* curve = nullptr;
  int pumps = 1;
  double duty_max = 1.0;
  double volume_m3 = kUnlimited;  // of the reservoirs; +∞: of any, without a first fill
};
// What the candidate has; no curve where its pumps are not chosen.
RailSource RailSourceOf(const Problem& problem, const Candidate& candidate);

// What the rail takes in a period, m³ ANR.
double RailAir(const Problem& problem, std::span<const Line* const> lines);

// What pumps bear that keep the rail at a weakest pressure; +∞ of all where they do not come to
// where they would stop.
struct RailLoad {
  double weakest_pa = 0.0, stop_pa = 0.0;
  double duty = kUnlimited;
  double energy_per_cycle_j = kUnlimited, first_fill_j = kUnlimited;
  double current_a = kUnlimited;
};
RailLoad LoadOf(const Problem& problem, const RailSource& source, double air_m3, double rail_pa);

// The deepest of its weakest pressures that the source keeps, and the weakest at which it does so
// and all falls are in time; none: there is none. `room`: relative, of duty and falls, for bounds.
std::optional<double> DeepestRailPa(const Problem& problem, const RailSource& source,
                                    std::span<const Line* const> lines, double room = 0.0);
std::optional<double> WeakestRailPa(const Problem& problem, const RailSource& source,
                                    std::span<const Line* const> lines, model::Gas gas,
                                    double room = 0.0);

// Fall time of the group's line at this pressure of the rail, or as it is where it has none.
double FallAtRail(const Problem& problem, int group, const Line& line, model::Gas gas,
                  double rail_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_PUMPED_RAIL_H_
