// Pressures that parts stand, supplies, and every requirement.
#include "verify/design/verify_supply.h"

#include <algorithm>

#include "model/physics/storage.h"
#include "optimizer/problem/pump_feed.h"
#include "verify/design/cycle/verify_alone.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_pump_curve.h"
#include "verify/design/verify_closing.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {

Pressures StoodPressures(const Problem& problem, const Assembly& a) {
  double low_pa = problem.ambient.pressure_pa, high_pa = problem.source_pressure_max_pa;
  for (std::size_t g = 0; g < a.lines.size(); ++g) {
    const LineParts& line = a.lines[g];
    low_pa = std::max(
        {low_pa, line.valve->pressure_min_pa, problem.groups[g].chamber.operating_pressure_pa});
    high_pa = std::min({high_pa, line.valve->pressure_max_pa, line.tube->pressure_max_pa});
    if (line.fitting) high_pa = std::min(high_pa, line.fitting->pressure_max_pa);
    if (!model::Holds(line.valve->kind))
      high_pa = std::min(high_pa, problem.groups[g].pressure_max_pa);
  }
  for (const model::Regulator* regulator : a.regulators) {
    low_pa = std::max(low_pa, regulator->outlet_pressure_min_pa);
    high_pa = std::min(high_pa, regulator->outlet_pressure_max_pa);
  }
  if (IsOpen(a)) {
    for (const LineParts& line : a.lines)
      if (!model::Holds(line.valve->kind)) return {kUnlimited, 0.0};
    low_pa = std::max(low_pa, InletPa(problem, a, 0.0));
    high_pa = std::min(high_pa, MostFillPa(problem, a));
  }
  if (a.direct()) {
    if (SomeAtOnce(problem)) return {kUnlimited, 0.0};
    for (const LineParts& line : a.lines)
      if (!model::Holds(line.valve->kind) ||
          line.valve->pressure_min_pa > problem.ambient.pressure_pa)
        return {kUnlimited, 0.0};
  }
  if (a.configuration == Configuration::kMains)
    high_pa = std::min(high_pa, problem.mains.pressure_pa);
  if (a.pump()) high_pa = std::min(high_pa, model::HighestPressure(a.pump()->curve));
  if (a.reservoir) high_pa = std::min(high_pa, a.reservoir->pressure_max_pa);
  if (a.pump() && !a.reservoir && !a.direct())
    high_pa =
        std::min(high_pa, problem.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa);
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g)
    high_pa = MostForPeakPa(problem, a.configuration, g, a.lines[g], high_pa);
  return {low_pa, high_pa};
}

bool Stand(const Problem& problem, const Settings& settings, const Assembly& a) {
  const auto stands = [](const Pressures& stood, double pa) {
    return stood.low_pa * (1.0 - kSumTolerance) <= pa &&
           pa <= stood.high_pa * (1.0 + kSumTolerance);
  };
  if (!a.owns())
    return settings.group_pressure_pa.empty() &&
           stands(StoodPressures(problem, a), settings.source_pressure_pa);
  const std::vector<double>& group_pa = settings.group_pressure_pa;
  if (group_pa.size() != a.lines.size() ||
      !Near(settings.source_pressure_pa, *std::max_element(group_pa.begin(), group_pa.end()),
            kSumTolerance))
    return false;
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g) {
    const Alone alone = AloneOf(problem, a, g);
    if (!stands(StoodPressures(alone.problem, alone.assembly), group_pa[g])) return false;
  }
  return true;
}

namespace {

// Pumps that go on filling a tank draw most at their stop pressure.
void AddRefill(const Problem& problem, const Settings& settings, const Assembly& a,
               const Cycle& cycle, Supply& supply) {
  supply.refilled = RefillCurve(problem, a, settings.source_pressure_pa, cycle.air_m3)
                        .At(settings.tank_fill_pa.value_or(0.0));
  supply.gas_m3 = (supply.refilled.lasts_s * problem.frequency_hz + 1.0) * cycle.air_m3;
  supply.current_a =
      a.compressors * model::LargestCurrent(a.filler()->curve, problem.ambient.pressure_pa,
                                            supply.refilled.stop_pa);
}

// The vacuum beside the source.
void AddRail(const Problem& problem, const Assembly& a, Supply& supply) {
  if (!a.rail.pump) return;
  supply.rail = BorneAt(problem, RailPumpsOf(a), RailLinesOf(problem, a), a.rail.weakest_pa);
  supply.first_fill_j += supply.rail.first_fill_j;
  supply.current_a += supply.rail.current_a;
  supply.frequency_hz = std::min(supply.frequency_hz,
                                 problem.frequency_hz * a.rail.pump->duty_max / supply.rail.duty);
}

void AddPacks(const Assembly& a, const Cycle& cycle, Supply& supply) {
  if (!a.battery) return;
  supply.energy_j =
      a.batteries * model::UsableEnergy(a.battery->capacity_ah, a.battery->nominal_voltage_v);
  supply.current_a += cycle.coil_w / a.battery->nominal_voltage_v;
}

}  // namespace

Supply SupplyOf(const Problem& problem, const Settings& settings, const Assembly& a,
                const Cycle& cycle) {
  Supply supply;
  const double temperature_k = problem.ambient.temperature_k;
  const double source_pa = settings.source_pressure_pa;
  double inlet_pa = source_pa;
  for (const model::Regulator* regulator : a.regulators)
    inlet_pa = std::max(inlet_pa, regulator->inlet_pressure_min_pa);
  supply.frequency_hz = kUnlimited;
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g) {
    const double share = std::max(cycle.inflate_s[g] / FillWindow(problem, g),
                                  cycle.fall_s[g] / VentWindow(problem, g));
    supply.frequency_hz = std::min(supply.frequency_hz, problem.frequency_hz / share);
  }
  if (a.cylinder)
    supply.gas_m3 = a.bottles * model::CylinderUsableVolume(a.cylinder->water_volume_m3,
                                                            a.cylinder->fill_pressure_pa, inlet_pa,
                                                            temperature_k);
  if (a.tank) {
    const double fall_pa = settings.tank_fill_pa.value_or(0.0) - InletPa(problem, a, source_pa);
    supply.gas_m3 = model::StandardVolume(TankVolume(a) * std::max(0.0, fall_pa), temperature_k);
  }
  if (a.filler()) AddRefill(problem, settings, a, cycle, supply);
  if (a.co2) {
    supply.gas_m3 = a.bottles * model::Co2UsableVolume(a.co2->co2_mass_kg, a.co2->water_volume_m3,
                                                       inlet_pa, temperature_k);
    supply.frequency_hz =
        std::min(supply.frequency_hz, a.bottles * a.co2->flow_sustained_m3_per_s / cycle.air_m3);
  }
  if (a.pump()) {
    const double ambient_pa = problem.ambient.pressure_pa;
    const double volume_m3 = settings.reservoir_volume_m3.value_or(0.0) + a.ReservoirSpread();
    if (a.direct()) {
      for (int g = 0; g < static_cast<int>(a.lines.size()); ++g)
        supply.frequency_hz =
            std::min(supply.frequency_hz,
                     FillSecondsMax(problem, a, g) * problem.frequency_hz / cycle.inflate_s[g]);
    } else {
      supply.first_fill_j =
          model::EnergyToFill(a.pump()->curve, volume_m3, ambient_pa, source_pa, temperature_k);
      supply.first_fill_m3 =
          model::StandardVolume(volume_m3 * (source_pa - ambient_pa), temperature_k);
    }
    const int running = a.direct() ? FeedsRunning(problem) : 1;
    supply.current_a =
        running * a.compressors * model::LargestCurrent(a.pump()->curve, ambient_pa, source_pa);
    // Pumps that hold on run for one share of every period, so that its length does not matter.
    const bool any_period =
        a.direct() && PumpsHoldOn(problem) &&
        cycle.pump_on_s * problem.frequency_hz <= a.pump()->duty_max * (1.0 + kSumTolerance);
    if (!any_period)
      supply.frequency_hz = std::min(supply.frequency_hz, a.pump()->duty_max / cycle.pump_on_s);
  }
  AddRail(problem, a, supply);
  AddPacks(a, cycle, supply);
  return supply;
}

double EnergyOf(const Problem& problem, const Supply& supply, const Cycle& cycle) {
  return supply.first_fill_j + supply.refilled.energy_j +
         problem.actuations * (cycle.pump_j + cycle.electric_j() + supply.rail.per_cycle_j);
}

namespace {

double Gauge(const Problem& problem, double pressure_pa) {
  return (pressure_pa - problem.ambient.pressure_pa) / (Evacuated(problem) ? -1e3 : 1e3);
}

// Keeps the worst: of a double-acting cylinder both sides have the same.
void AddAtMost(std::map<std::string, Reached>& all, const std::string& pointer, double limit,
               double value, double tolerance) {
  const auto known = all.find(pointer);
  if (std::isfinite(limit) && (known == all.end() || value > known->second.achieved))
    all[pointer] = {limit, value, true, tolerance};
}

}  // namespace

std::map<std::string, Reached> Requirements(const Problem& problem, const Settings& settings,
                                            const Totals& totals, const Assembly& a,
                                            const Cycle& cycle, const Supply& supply) {
  std::map<std::string, Reached> all =
      RequirementsBesidePeaks(problem, settings, totals, a, cycle, supply);
  const char* field = Evacuated(problem) ? "/pressure_kpa_gauge_min" : "/pressure_kpa_gauge_max";
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g) {
    const double peak_pa = PeakPa(problem, a.configuration, g, a.lines[g], PressureAt(settings, g));
    AddAtMost(all, optimizer::GroupPointer(problem, g) + field,
              Gauge(problem, problem.groups[g].pressure_max_pa), Gauge(problem, peak_pa),
              kPeakTolerance);
  }
  return all;
}

std::map<std::string, Reached> RequirementsBesidePeaks(const Problem& problem,
                                                       const Settings& settings,
                                                       const Totals& totals, const Assembly& a,
                                                       const Cycle& cycle, const Supply& supply) {
  std::map<std::string, Reached> all;
  const auto at_most = [&](const std::string& pointer, double limit, double value, double tol) {
    AddAtMost(all, pointer, limit, value, tol);
  };
  const auto gauge = [&](double pa) { return Gauge(problem, pa); };
  const double source_pa = settings.source_pressure_pa;
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const std::string at = optimizer::GroupPointer(problem, g) + "/";
    at_most(at + "rise_time_s_max", group.rise_time_max_s, cycle.rise_s[g], kTimeTolerance);
    at_most(at + "fall_time_s_max", group.fall_time_max_s, cycle.fall_s[g], kTimeTolerance);
  }
  all["/duty/frequency_hz"] = {problem.frequency_hz, supply.frequency_hz, false, kEnergyTolerance};
  const double per_cycle_j = cycle.pump_j + cycle.electric_j() + supply.rail.per_cycle_j +
                             supply.refilled.energy_j / problem.actuations;
  const optimizer::Power& power = problem.power;
  const bool stored = power.kind == optimizer::PowerKind::kBattery || power.energy_wh_max;
  const double actuations =
      std::min(supply.gas_m3 / cycle.air_m3,
               stored && per_cycle_j > 0.0 ? (supply.energy_j - supply.first_fill_j) / per_cycle_j
                                           : kUnlimited);
  if (std::isfinite(actuations))
    all["/duty/actuations"] = {problem.actuations, actuations, false, kEnergyTolerance};
  at_most(Evacuated(problem) ? "/supply/vacuum/vacuum_kpa_gauge_min"
                             : "/supply/source_pressure_kpa_gauge_max",
          gauge(problem.source_pressure_max_pa), gauge(source_pa), kSumTolerance);
  if (problem.rail_floor_pa > model::kDeepestVacuumPa)
    all["/supply/vacuum/vacuum_kpa_gauge_min"] = {gauge(problem.rail_floor_pa),
                                                  gauge(supply.rail.stop_pa), true, kTimeTolerance};
  if (a.tank)
    at_most("/supply/tank_fill_kpa_gauge_max", gauge(problem.tank_fill_max_pa),
            gauge(settings.tank_fill_pa.value_or(0.0)), kSumTolerance);
  if (IsEjector(a.configuration))
    at_most("/supply/mains/flow_l_per_min_anr_max", 6e4 * problem.compressed_air.flow_max_m3_per_s,
            6e4 * CompressedAir(problem, *a.pump(), a.compressors), kSumTolerance);
  const Totals slack = SlackOf(problem, a, settings);
  at_most("/supply/mass_kg_max", problem.mass_max_kg, totals.mass_kg + slack.mass_kg,
          kSumTolerance);
  at_most("/supply/volume_l_max", problem.volume_max_l, (totals.volume_m3 + slack.volume_m3) * 1e3,
          kSumTolerance);
  at_most("/supply/cost_eur_max", problem.cost_max_eur,
          problem.unpriced_allowed ? totals.cost_known_eur : totals.cost_eur.value_or(kUnlimited),
          kSumTolerance);
  return all;
}

}  // namespace plenum::verify
