// The instance that plenum and its rivals solve alike: the least mass of one group's supply from a
// compressed-air cylinder. One valve, fitting, tube, regulator and cylinder each; the base model at
// one source pressure. All that is not linear in the choices is the rise and the fall time, which
// everyone takes from the same exact march and quadrature.
#ifndef PLENUM_BENCH_SEARCH_BASE_INSTANCE_H_
#define PLENUM_BENCH_SEARCH_BASE_INSTANCE_H_

#include <array>
#include <cstdint>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::bench {

enum BaseFamily { kValves, kFittings, kTubes, kRegulators, kCylinders };
inline constexpr int kBaseFamilies = 5;
using Selection = std::array<int, kBaseFamilies>;

// Parts that may not all be taken at once: a row of a cut, by family.
using Cut = std::array<std::vector<int>, kBaseFamilies>;

// Flow elements and the bore, as numbers between those of parts, too.
struct BaseAttributes {
  model::FlowElement fill, exhaust, fitting, regulator;
  double bore_m = 0.0;
};

struct BaseInstance {
  optimizer::Problem problem;  // for plenum
  double source_pa = 0.0;
  int size = 0;                                            // parts of each family
  std::array<std::vector<double>, kBaseFamilies> mass_kg;  // whole row
  std::array<std::vector<bool>, kBaseFamilies> stands;     // the source pressure
  std::vector<int> tube_class, fitting_class;              // diameters that must be equal
  std::vector<int> fitting_thread, valve_thread;           // threads that must be equal
  std::vector<double> need_m3, gas_m3;                     // of tubes and of cylinders
  std::vector<double> inlet_max_pa, fill_pa;               // of regulators and of cylinders

  BaseAttributes AttributesOf(const Selection& s) const;
  // Over the limit: 1 is just fast enough.
  double Rise(const BaseAttributes& a) const;
  double Fall(const BaseAttributes& a) const;

  bool LinearOk(const Selection& s) const;  // everything but the times
  bool Feasible(const Selection& s) const;
  double Mass(const Selection& s) const;

  // The combination is too slow: so is every one with parts that are no better in any conductance
  // and a tube of the same bore. Lifted: first valve, fitting and regulator are replaced by the
  // best that are still too slow, and all tubes count that are too slow with these. At most
  // `families − 1` of the parts may be taken.
  Cut RiseCut(Selection s, bool lifted) const;
  Cut FallCut(Selection s, bool lifted) const;  // of valve, fitting and tube
};

BaseInstance MakeBaseInstance(std::uint64_t catalogue, std::uint64_t requirements, int size);

// The lightest combination by enumeration, in the order of mass; none: nothing is feasible.
struct Enumerated {
  Selection best{};
  double mass_kg = 0.0;
  bool found = false;
};
Enumerated EnumerateBase(const BaseInstance& instance);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_SEARCH_BASE_INSTANCE_H_
