// Cycles of parts that are asked for again and again. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_KNOWN_CYCLES_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_KNOWN_CYCLES_H_

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "verify/design/cycle/verify_alone.h"
#include "verify/design/cycle/verify_cycle.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_pump_curve.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// QuickCycles that remembers. Strokes are the same beside any battery and any number of bottles,
// and of any tank behind a regulator. Groups with regulators of their own each have theirs.
class KnownCycles {
 public:
  KnownCycles(const Problem& problem, const Assembly& assembly, const Stop& stop,
              DirectFills* fills = nullptr);
  KnownCycles(const KnownCycles&) = delete;
  KnownCycles& operator=(const KnownCycles&) = delete;

  bool Serves(const Assembly& other) const {
    return other.configuration == assembly_.configuration && other.lines == assembly_.lines &&
           other.regulators == assembly_.regulators && other.co2 == assembly_.co2 &&
           other.compressor == assembly_.compressor && other.compressors == assembly_.compressors &&
           other.at_best == assembly_.at_best &&
           other.rail.weakest_pa == assembly_.rail.weakest_pa &&
           (!other.regulators.empty() ||
            (other.tank == assembly_.tank && other.tanks == assembly_.tanks));
  }

  // By energy per air, or by power where groups take turns (verify_size.h); of all the pressures
  // up to the source's.
  double PumpHeld(double high_pa) {
    const auto [entry, fresh] = held_.try_emplace(high_pa);
    if (!fresh) return entry->second;
    const model::CompressorCurve& curve = assembly_.pump()->curve;
    return entry->second = (Bursts(problem_) > 0 ? EnergyPerAirHeld : PowerHeld)(
               curve, problem_.ambient.pressure_pa, high_pa);
  }

  const std::optional<Cycle>& At(const Settings& settings, double rising_m3) {
    if (assembly_.owns()) return AtGroups(settings.group_pressure_pa);
    const auto [entry, fresh] = known_.try_emplace(
        {settings.source_pressure_pa, settings.reservoir_volume_m3.value_or(0.0), rising_m3});
    if (fresh) entry->second = quick_.At(settings, rising_m3);
    return entry->second;
  }

  std::optional<Cycle> EachAlone(const Settings& settings, double rising_m3) const {
    return quick_.EachAlone(settings, rising_m3);
  }

  // Of a group behind its own regulator.
  struct OfGroup;
  OfGroup& Group(int group) { return *groups_[group]; }

 private:
  const std::optional<Cycle>& AtGroups(const std::vector<double>& group_pressure_pa);

  const Problem& problem_;
  const Assembly assembly_;
  const QuickCycles quick_;
  std::map<std::array<double, 3>, std::optional<Cycle>> known_;
  std::map<double, double> held_;
  std::vector<std::shared_ptr<OfGroup>> groups_;
  std::map<std::vector<double>, std::optional<Cycle>> joined_;
};

struct KnownCycles::OfGroup {
  OfGroup(Alone group, const Stop& stop)
      : alone(std::move(group)), cycles(alone.problem, alone.assembly, stop) {}
  const Alone alone;
  KnownCycles cycles;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_KNOWN_CYCLES_H_
