// What a set of choices of one family can do at best, number by number: the corner of a box. The
// corner of a single choice is that choice.
//
// Widen(a, b) makes `a` the corner of both. Every bound takes a corner where it would take a part,
// and moves to the safe side with each of these numbers; where more is not better both ends are
// kept.
#ifndef PLENUM_OPTIMIZER_CHOICES_CORNER_H_
#define PLENUM_OPTIMIZER_CHOICES_CORNER_H_

#include <array>
#include <cstdint>
#include <memory>

#include "optimizer/choices/box_tree.h"
#include "optimizer/pump/pump_bounds.h"

namespace plenum::optimizer {

// A set of kinds (diameters, threads, voltages) as bits. Kinds beyond 64 share bits, so that an
// empty intersection proves that nothing mates, and a common bit proves nothing.
using Kinds = std::uint64_t;

struct TubeCorner {
  Amounts amounts;         // of the whole group; the same below
  double objective = 0.0;  // their share, and that of the energy that they take for sure
  Kinds diameters = 0;     // of fittings that it mates with
  double inner_low_m = 0.0, inner_high_m = 0.0;  // wider: more flow, more air
  double pressure_max_pa = 0.0;
};

struct FittingCorner {
  Amounts amounts;
  double objective = 0.0;
  Kinds diameters = 0, threads = 0;
  model::FlowElement flow;
  double pressure_max_pa = 0.0;
  model::FlowElement late_flow;  // see ValveCorner
};

struct ValveCorner {
  Amounts amounts;
  double objective = 0.0;
  Kinds threads = 0;
  bool some_hold = false, all_hold = false;
  model::FlowElement fill, exhaust;
  double coil_power_w = 0.0;  // whole group
  double pressure_min_pa = 0.0, pressure_max_pa = 0.0;
  // Peaks are no lower than with these (closing.h): what passes at most, by tolerances, through the
  // choice that passes least, for as long as the one that closes soonest may be late.
  model::FlowElement late_fill;
  double late_s = 0.0;
};

struct RegulatorCorner {
  Amounts amounts;
  double objective = 0.0;
  model::FlowElement flow;
  double flow_max_m3_per_s = 0.0;
  double inlet_min_pa = 0.0, inlet_max_pa = 0.0;
  double outlet_min_pa = 0.0, outlet_max_pa = 0.0;
  double electrical_power_w = 0.0;
  bool some_none = false, all_none = false;  // a tank may do without
};

// Gas, m³ ANR, that comes out until the inlet has fallen to the lowest and to the highest pressure
// that matters (BottleRange). In between it is linear in the gas that stays behind, so the chord
// bounds the gas of a box from above.
struct BottleCorner {
  Amounts amounts;
  double objective = 0.0;
  double gas_to_low_m3 = 0.0, gas_to_high_m3 = 0.0;
  double fill_pressure_pa = 0.0;             // a regulator must stand it
  double water_m3 = 0.0, fill_max_pa = 0.0;  // of a tank, whose fill is a setting
  double flow_sustained_m3_per_s = 0.0;
};

struct CompressorCorner {
  Amounts amounts;
  double objective = 0.0;
  Kinds voltages = 0;  // none: ejectors for which there is not enough air
  double duty_max = 0.0;
  double pressure_max_pa = 0.0;
  CoarsePump pump;
};

struct BatteryCorner {
  Amounts amounts;
  double objective = 0.0;
  Kinds voltages = 0;  // of compressors that it can drive
  double energy_j = 0.0, current_max_a = 0.0, voltage_v = 0.0;
};

struct ReservoirCorner {
  Amounts amounts;  // of the smallest volume if made to measure
  double objective = 0.0;
  bool custom = false;
  double low_m3 = 0.0, high_m3 = 0.0;
  double pressure_max_pa = 0.0;
};

void Widen(TubeCorner& a, const TubeCorner& b);
void Widen(FittingCorner& a, const FittingCorner& b);
void Widen(ValveCorner& a, const ValveCorner& b);
void Widen(RegulatorCorner& a, const RegulatorCorner& b);
void Widen(BottleCorner& a, const BottleCorner& b);
void Widen(CompressorCorner& a, const CompressorCorner& b);
void Widen(BatteryCorner& a, const BatteryCorner& b);
void Widen(ReservoirCorner& a, const ReservoirCorner& b);

// Attributes by which trees divide boxes, the objective first, each as a logarithm times its rough
// effect on a design's objective: trees divide where choices differ most in what matters. Any
// numbers would be right.
std::array<double, 3> SplitKeys(const TubeCorner& c);
std::array<double, 4> SplitKeys(const FittingCorner& c);
std::array<double, 7> SplitKeys(const ValveCorner& c);
std::array<double, 6> SplitKeys(const RegulatorCorner& c);
std::array<double, 4> SplitKeys(const BottleCorner& c);
std::array<double, 5> SplitKeys(const CompressorCorner& c);
std::array<double, 3> SplitKeys(const BatteryCorner& c);
std::array<double, 3> SplitKeys(const ReservoirCorner& c);

// Choices of different classes mate with different parts; only single choices are asked.
inline Kinds MatingClass(const TubeCorner& c) { return c.diameters; }
inline Kinds MatingClass(const FittingCorner& c) {
  return c.threads * 0x9e3779b97f4a7c15u + c.diameters;
}
inline Kinds MatingClass(const ValveCorner& c) { return 2 * c.threads + c.some_hold; }
inline Kinds MatingClass(const RegulatorCorner& c) { return c.some_none; }
inline Kinds MatingClass(const BottleCorner&) { return 0; }
inline Kinds MatingClass(const CompressorCorner& c) { return c.voltages; }
inline Kinds MatingClass(const BatteryCorner& c) { return c.voltages; }
inline Kinds MatingClass(const ReservoirCorner& c) { return c.custom; }

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_CORNER_H_
