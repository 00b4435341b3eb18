#include "optimizer/explain/requirements.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/pumped_rail.h"

namespace plenum::optimizer {
namespace {

// Low enough for air and strokes; not so low that valves are held for minutes in each cycle.
double LoosestFrequency(double required_hz) {
  return std::min(required_hz / 8.0, std::max(1e-2, required_hz / 4096.0));
}

void AddGroups(const Problem& problem, std::vector<Requirement>& list) {
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const std::vector<std::size_t> sides = GroupsOfEntry(problem, g);
    if (sides.front() != g) continue;
    const auto set_all = [sides](Problem& p, double ActuatorGroup::*limit, double value) {
      for (const std::size_t side : sides) p.groups[side].*limit = value;
    };
    const std::string base = GroupPointer(problem, static_cast<int>(g));
    const ActuatorGroup& group = problem.groups[g];
    if (std::isfinite(group.rise_time_max_s))
      list.push_back(
          {base + "/rise_time_s_max", group.rise_time_max_s,
           std::max(InflateWindow(problem, static_cast<int>(g)), 2.0 * group.rise_time_max_s),
           [set_all](Problem& p, double value) {
             set_all(p, &ActuatorGroup::rise_time_max_s, value);
           },
           std::nullopt});
    if (std::isfinite(group.fall_time_max_s))
      list.push_back(
          {base + "/fall_time_s_max", group.fall_time_max_s,
           std::max(DeflateWindow(problem, static_cast<int>(g)), 2.0 * group.fall_time_max_s),
           [set_all](Problem& p, double value) {
             set_all(p, &ActuatorGroup::fall_time_max_s, value);
           },
           std::nullopt});
  }
}

void AddAmounts(const Problem& problem, std::vector<Requirement>& list) {
  const auto add = [&](const char* pointer, double limit, double Problem::*member,
                       Objective objective) {
    if (std::isfinite(limit))
      list.push_back({pointer, limit, kUnlimited,
                      [member](Problem& p, double value) { p.*member = value; }, objective});
  };
  add("/supply/mass_kg_max", problem.mass_max_kg, &Problem::mass_max_kg, {.mass_kg = 1.0});
  add("/supply/volume_l_max", problem.volume_max_l, &Problem::volume_max_l, {.volume_l = 1.0});
  add("/supply/cost_eur_max", problem.cost_max_eur, &Problem::cost_max_eur, {.cost_eur = 1.0});
}

}  // namespace

std::vector<std::size_t> GroupsOfEntry(const Problem& problem, std::size_t group) {
  const int entry = problem.groups[group].entry;
  if (entry < 0) return {group};
  std::vector<std::size_t> groups;
  for (std::size_t g = 0; g < problem.groups.size(); ++g)
    if (problem.groups[g].entry == entry) groups.push_back(g);
  return groups;
}

std::vector<Requirement> Requirements(const Problem& problem) {
  std::vector<Requirement> list;
  AddGroups(problem, list);
  AddAmounts(problem, list);
  list.push_back({"/duty/actuations", problem.actuations, 1.0,
                  [](Problem& p, double value) {
                    p.actuations = value;
                    FollowMission(p);
                  },
                  std::nullopt, true});
  list.push_back({"/duty/frequency_hz", problem.frequency_hz,
                  LoosestFrequency(problem.frequency_hz),
                  [](Problem& p, double value) {
                    p.frequency_hz = value;
                    FollowMission(p);
                  },
                  std::nullopt});
  if (std::isfinite(problem.source_pressure_max_pa)) {
    list.push_back(
        {SourceLimitPointer(problem), KpaGauge(problem, problem.source_pressure_max_pa),
         Evacuated(problem) ? -100.0 : 1e4,
         [](Problem& p, double value) { p.source_pressure_max_pa = PaFromKpaGauge(p, value); },
         std::nullopt});
  }
  if (problem.rail_floor_pa > model::kDeepestVacuumPa)
    list.push_back({"/supply/vacuum/vacuum_kpa_gauge_min", KpaGauge(problem, problem.rail_floor_pa),
                    KpaGauge(problem, model::kDeepestVacuumPa),
                    [](Problem& p, double value) {
                      SetRailFloor(std::max(model::kDeepestVacuumPa, PaFromKpaGauge(p, value)), p);
                    },
                    std::nullopt});
  if (std::isfinite(problem.tank_fill_max_pa) &&
      (problem.configurations.contains(Configuration::kTank) ||
       problem.configurations.contains(Configuration::kTankAndPump))) {
    const double ambient_pa = problem.ambient.pressure_pa;
    list.push_back(
        {"/supply/tank_fill_kpa_gauge_max", (problem.tank_fill_max_pa - ambient_pa) / 1e3, 1e5,
         [ambient_pa](Problem& p, double value) { p.tank_fill_max_pa = ambient_pa + value * 1e3; },
         std::nullopt});
  }
  return list;
}

}  // namespace plenum::optimizer
