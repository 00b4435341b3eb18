// Strokes, air, energy and margins of a listed design against a simulation of its periodic state.
#include <set>
#include <string>

#include "verify/design/cycle/verify_cycle.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_known_cycles.h"
#include "verify/design/cycle/verify_pump_curve.h"
#include "verify/design/verify_closing.h"
#include "verify/design/verify_supply.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

std::string Numbers(const std::string& what, double claimed, double found) {
  return what + " is given as " + std::to_string(claimed) + ", found " + std::to_string(found);
}

void CheckMargins(const std::map<std::string, Reached>& requirements, const Design& design,
                  Findings& findings) {
  std::map<std::string, const Margin*> given;
  for (const Margin& margin : design.margins) given[margin.requirement] = &margin;
  if (given.size() != design.margins.size() || given.size() != requirements.size())
    findings.push_back({"margins", "there must be one margin for each requirement"});
  for (const auto& [pointer, reached] : requirements) {
    if (reached.margin() < -reached.tolerance)
      findings.push_back({"supply", pointer + " is not met: " + std::to_string(reached.achieved) +
                                        " for " + std::to_string(reached.required)});
    const auto found = given.find(pointer);
    if (found == given.end()) {
      findings.push_back({"margins", pointer + " has no margin"});
      continue;
    }
    const Margin& claimed = *found->second;
    const double claimed_margin = reached.at_most ? 1.0 - claimed.achieved / claimed.required
                                                  : claimed.achieved / claimed.required - 1.0;
    if (!Near(claimed.required, reached.required, kSumTolerance) ||
        !Near(claimed.achieved, reached.achieved, reached.tolerance))
      findings.push_back({"margins", Numbers(pointer, claimed.achieved, reached.achieved)});
    else if (std::abs(claimed.relative_margin - claimed_margin) >
             kSumTolerance * std::max(1.0, std::abs(claimed_margin)))
      findings.push_back({"margins", pointer + ": the margin is not that of its two numbers"});
  }
}

// Close to equal pressures the simulator follows a straight line instead of the flow law, which
// delays the end of a stroke whose source is hardly above the operating pressure. There the
// quadratures count.
constexpr double kHardlyAbove = 1.0 + 1e-6;

// A tank without a regulator comes as close to the operating pressure while the last stroke ends,
// and the less it has left the more time the simulator's error in pressure is.
constexpr double kHardlyLeft = 1.0 + 1e-2;

double LowestSource(const Problem& problem, const Design& design, const Assembly& assembly, int g) {
  const double source_pa = PressureAt(design.settings, g);
  if (!IsOpen(assembly)) return source_pa / kHardlyAbove;
  return (source_pa - FallPa(problem, assembly, problem.actuations)) / kHardlyLeft;
}

bool IsHardlyAbove(const Problem& problem, const Design& design, const Assembly& assembly) {
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (LowestSource(problem, design, assembly, g) <
        problem.groups[g].chamber.operating_pressure_pa)
      return true;
  return false;
}

std::optional<Cycle> CycleOf(const Problem& problem, const Design& design, const Assembly& assembly,
                             const Settings& settings, const Stop& stop) {
  std::optional<Cycle> cycle = SimulateCycle(problem, settings, assembly, stop);
  if (!cycle || !IsHardlyAbove(problem, design, assembly)) return cycle;
  const std::optional<Cycle> quick =
      KnownCycles(problem, assembly, stop)
          .At(settings, settings.reservoir_volume_m3.value_or(0.0) + assembly.ReservoirSpread());
  if (!quick) return std::nullopt;
  cycle->rise_s = quick->rise_s;
  cycle->inflate_s = quick->inflate_s;
  cycle->inflating_j = quick->inflating_j;
  return cycle;
}

struct Worth {
  double rise = 0.0, inflate = 0.0;
};

// Of the times of strokes, relative, what a millionth of the source pressure is worth where several
// draw at once, or where the source is hardly above the operating pressure and no quadrature tells:
// of a stroke that hardly reaches its pressure that is much. Two simulations of the same strokes
// may differ by that.
class WorthOfPressure {
 public:
  WorthOfPressure(const Problem& problem, const Design& design, const Assembly& assembly,
                  const Cycle& cycle, const Stop& stop)
      : problem_(problem), design_(design), assembly_(assembly), cycle_(cycle), stop_(stop) {}

  double OfRise() { return Known().rise; }
  double OfInflation() { return Known().inflate; }
  bool is_known() const { return known_.has_value(); }  // it was asked for

 private:
  const Worth& Known() {
    constexpr double kRaised = 1.0 + 1e-6;
    if (known_) return *known_;
    known_.emplace();
    if (!SomeAtOnce(problem_) && !IsHardlyAbove(problem_, design_, assembly_)) return *known_;
    Settings settings = design_.settings;
    settings.source_pressure_pa *= kRaised;
    for (double& group_pa : settings.group_pressure_pa) group_pa *= kRaised;
    const std::optional<Cycle> raised = SimulateCycle(problem_, settings, assembly_, stop_);
    for (std::size_t g = 0; raised && g < problem_.groups.size(); ++g) {
      known_->rise = std::max(known_->rise, 1.0 - raised->rise_s[g] / cycle_.rise_s[g]);
      known_->inflate = std::max(known_->inflate, 1.0 - raised->inflate_s[g] / cycle_.inflate_s[g]);
    }
    return *known_;
  }

  const Problem& problem_;
  const Design& design_;
  const Assembly& assembly_;
  const Cycle& cycle_;
  const Stop& stop_;
  std::optional<Worth> known_;
};

void Expect(const std::string& what, double given, double found, double tolerance,
            Findings& findings) {
  if (!Near(given, found, tolerance)) findings.push_back({"strokes", Numbers(what, given, found)});
}

void CheckStrokes(const Problem& problem, const Design& design, const Assembly& assembly,
                  const Cycle& cycle, WorthOfPressure& worth, Findings& findings) {
  const auto timed = [&](const std::string& what, double given, double found,
                         double (WorthOfPressure::*worth_of)()) {
    if (!Near(given, found, kTimeTolerance))
      Expect(what, given, found, kTimeTolerance + (worth.*worth_of)(), findings);
  };
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const double strokes = problem.groups[g].gait.strokes_per_period;
    const std::string name = problem.groups[g].name + ": ";
    const GroupPerformance& group = design.performance.groups[g];
    timed(name + "rise_time_s", group.rise_time_s, cycle.rise_s[g], &WorthOfPressure::OfRise);
    Expect(name + "fall_time_s", group.fall_time_s, cycle.fall_s[g], kTimeTolerance, findings);
    timed(name + "inflate_time_s", group.inflate_time_s, cycle.inflate_s[g],
          &WorthOfPressure::OfInflation);
    timed(name + "frequency_hz_max", group.frequency_max_hz,
          1.0 / (cycle.rise_s[g] + cycle.fall_s[g]), &WorthOfPressure::OfRise);
    if (!Near(group.highest_pressure_pa,
              PeakPa(problem, assembly.configuration, g, assembly.lines[g],
                     PressureAt(design.settings, g)),
              kPeakTolerance))
      findings.push_back({"strokes", name + "peak_kpa_gauge is not that of these parts"});
    timed(name + "valve_duty", design.settings.valve_duty[g],
          strokes * cycle.inflate_s[g] * problem.frequency_hz, &WorthOfPressure::OfInflation);
    if (cycle.inflate_s[g] > FillSecondsMax(problem, assembly, g) * (1.0 + kTimeTolerance) ||
        cycle.fall_s[g] > VentWindow(problem, g) * (1.0 + kTimeTolerance))
      findings.push_back({"strokes", name + "a stroke takes longer than its window or its turn"});
  }
}

void CheckVolume(const Settings& settings, const Assembly& assembly, Findings& findings) {
  if (assembly.reservoir &&
      !Near(settings.reservoir_volume_m3.value_or(0.0),
            assembly.ReservoirVolume() + 0.5 * assembly.ReservoirSpread(), kSumTolerance))
    findings.push_back({"supply", "the reservoir's volume is not that of the part"});
  if (assembly.direct() && settings.reservoir_volume_m3)
    findings.push_back({"supply", "pumps without a reservoir have no volume of one"});
}

// The vacuum beside the source: where it is, and where its pumps stop.
void CheckRail(const Problem& problem, const RailSettings& claimed, const Assembly& assembly,
               const RailBorne& borne, Findings& findings) {
  if (!Near(claimed.volume_m3, assembly.rail.VolumeM3(), kSumTolerance))
    findings.push_back({"supply", "the vacuum's volume is not that of its reservoirs"});
  const auto gauge = [&](double pa) { return pa - problem.ambient.pressure_pa; };
  if (!Near(gauge(claimed.stop_pa), gauge(borne.stop_pa), kTimeTolerance) ||
      !Near(claimed.duty, borne.duty, kEnergyTolerance))
    findings.push_back({"supply", "the vacuum's pumps stop elsewhere, or run longer"});
  if (borne.stop_pa < problem.rail_floor_pa * (1.0 - kTimeTolerance))
    findings.push_back({"supply", "the vacuum is deeper than it may be"});
  for (const ActuatorGroup& group : problem.groups)
    if (group.chamber.low_pressure_pa > 0.0 &&
        claimed.pressure_pa > group.chamber.low_pressure_pa * (1.0 + kSumTolerance))
      findings.push_back({"supply", "the vacuum does not come to the low pressure"});
}

// A tank's volume and its fill: of a source without a regulator the source pressure.
void CheckFill(const Problem& problem, const Settings& settings, const Assembly& assembly,
               Findings& findings) {
  if (!Near(settings.reservoir_volume_m3.value_or(0.0), TankVolume(assembly), kSumTolerance))
    findings.push_back({"supply", "the tank's volume is not that of the parts"});
  const double fill_pa = settings.tank_fill_pa.value_or(0.0);
  if (fill_pa < LeastLeftPa(problem) ||
      fill_pa > MostFillPa(problem, assembly) * (1.0 + kSumTolerance))
    findings.push_back({"supply", "the tank's fill is outside what it may be"});
  if (IsOpen(assembly) && !Near(fill_pa, settings.source_pressure_pa, kSumTolerance))
    findings.push_back({"supply", "without a regulator the tank's fill is the source pressure"});
}

// Of all actuators: both chambers of a double-acting one are groups of its entry.
int ActuationsAPeriod(const Problem& problem) {
  std::set<std::string> pointers;
  int actuations = 0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (pointers.insert(GroupPointer(problem, g)).second)
      actuations += problem.groups[g].count * problem.groups[g].gait.strokes_per_period;
  return actuations;
}

}  // namespace

bool CheckPerformance(const Problem& problem, const Design& design, const Assembly& parts,
                      const Stop& stop, Findings& findings) {
  if (design.settings.rail.has_value() != (parts.rail.pump != nullptr)) {
    findings.push_back({"supply", "the vacuum's settings are there without pumps, or missing"});
    return true;  // nothing else can be said
  }
  Assembly assembly = parts;
  if (assembly.rail.pump) assembly.rail.weakest_pa = design.settings.rail->pressure_pa;
  const double source_pa = design.settings.source_pressure_pa;
  if (design.settings.group_pressure_pa.size() != (assembly.owns() ? assembly.lines.size() : 0)) {
    findings.push_back({"supply", "there must be a pressure for each regulator of a group"});
    return true;  // nothing else can be said
  }
  if (!Stand(problem, design.settings, assembly))
    findings.push_back({"supply", "the source pressure is outside what the parts stand"});
  CheckVolume(design.settings, assembly, findings);
  if (assembly.tank) CheckFill(problem, design.settings, assembly, findings);
  Settings settings = design.settings;
  if (assembly.reservoir) settings.reservoir_volume_m3 = assembly.ReservoirVolume();
  const std::optional<Cycle> cycle = CycleOf(problem, design, assembly, settings, stop);
  if (!cycle) return false;

  WorthOfPressure worth(problem, design, assembly, *cycle, stop);
  CheckStrokes(problem, design, assembly, *cycle, worth, findings);
  const Performance& claimed = design.performance;
  const auto expect = [&](const std::string& what, double given, double found, double tolerance) {
    Expect(what, given, found, tolerance, findings);
  };
  if (assembly.direct()) expect("source_pressure", source_pa, cycle->node_pa, kTimeTolerance);
  const Supply supply = SupplyOf(problem, settings, assembly, *cycle);
  if (assembly.rail.pump)
    CheckRail(problem, *design.settings.rail, assembly, supply.rail, findings);
  expect("air_per_actuation", claimed.air_per_actuation_m3,
         cycle->air_m3 / ActuationsAPeriod(problem), kTimeTolerance);
  expect("air_total", claimed.air_total_m3,
         problem.actuations * cycle->air_m3 + supply.first_fill_m3, kTimeTolerance);
  expect("run_time_s", claimed.run_time_s, problem.actuations / problem.frequency_hz,
         kSumTolerance);
  expect("energy", design.totals.energy_j, EnergyOf(problem, supply, *cycle), kEnergyTolerance);
  if (assembly.pump())
    expect("compressor_duty", design.settings.compressor_duty.value_or(0.0),
           cycle->pump_on_s * problem.frequency_hz, kEnergyTolerance);
  if (assembly.filler())
    expect("compressor_duty", design.settings.compressor_duty.value_or(0.0),
           supply.refilled.on_s * problem.frequency_hz / problem.actuations, kEnergyTolerance);
  if (assembly.filler() || design.settings.pump_stop_pa)
    expect("pump_stop", design.settings.pump_stop_pa.value_or(0.0), supply.refilled.stop_pa,
           kTimeTolerance);
  if (assembly.battery && supply.current_a > assembly.batteries * assembly.battery->current_max_a *
                                                 (1.0 + kEnergyTolerance))
    findings.push_back({"supply", "the batteries do not give the current"});
  std::map<std::string, Reached> requirements =
      Requirements(problem, settings, design.totals, assembly, *cycle, supply);
  if (worth.is_known())
    for (auto& [pointer, reached] : requirements)
      if (pointer.ends_with("/rise_time_s_max")) reached.tolerance += worth.OfRise();
  CheckMargins(requirements, design, findings);
  return true;
}

}  // namespace plenum::verify
