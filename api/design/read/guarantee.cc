#include "api/design/read/guarantee.h"

#include <algorithm>
#include <string>

#include "api/design/read/actuators/gait_reader.h"
#include "api/design/read/selection.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/power.h"
#include "api/design/read/supply/vacuum_rail.h"

namespace plenum::api {
namespace {

constexpr double kDeviations = 2.0;       // of a half-width
constexpr double kUncertaintyMax = 0.45;  // so that a half-width is below 1

// Largest volumes at each pressure (`deviations` above 0) or smallest.
model::Chamber Resized(model::Chamber chamber, const GroupUncertainty& uncertainty,
                       double deviations) {
  const double rest = 1.0 + deviations * uncertainty.rest_volume;
  const double ratio = chamber.expansion_ratio;
  const double scaled = ratio * (1.0 + deviations * uncertainty.expansion_ratio);
  const double changed = ratio >= 1.0 ? std::max(1.0, scaled) : scaled;
  if (!chamber.volume_curve.empty()) {
    const double growth = ratio > 1.0 ? (changed - 1.0) / (ratio - 1.0) : 1.0;
    std::vector<double> volumes_m3;
    for (const double volume_m3 : chamber.volume_curve.y()) {
      const double grown_m3 = volume_m3 - chamber.rest_volume_m3;
      const double farthest_m3 = deviations > 0.0 ? std::max(grown_m3, grown_m3 * growth)
                                                  : std::min(grown_m3, grown_m3 * growth);
      volumes_m3.push_back(rest * (chamber.rest_volume_m3 + farthest_m3));
    }
    const auto pressures = chamber.volume_curve.x();
    chamber.volume_curve = {{pressures.begin(), pressures.end()}, std::move(volumes_m3)};
  }
  chamber.rest_volume_m3 *= rest;
  chamber.expansion_ratio = changed;
  return chamber;
}

}  // namespace

GroupUncertainty ReadGroupUncertainty(Reader& group) {
  GroupUncertainty uncertainty;
  auto reader = group.OptionalObject("relative_uncertainty");
  if (!reader) return uncertainty;
  const Range range{0, kUncertaintyMax};
  uncertainty.rest_volume = reader->Number("rest_volume", range, 0.0);
  uncertainty.expansion_ratio = reader->Number("expansion_ratio", range, 0.0);
  reader->Finish();
  return uncertainty;
}

std::optional<GuaranteeRequest> ReadGuarantee(Reader& request,
                                              std::vector<GroupUncertainty> groups) {
  const Json* given = request.Raw("guarantee");
  if (given != nullptr && given->is_boolean()) {
    if (!request.Bool("guarantee", false)) return std::nullopt;
    return GuaranteeRequest{{}, std::move(groups)};
  }
  auto reader = request.OptionalObject("guarantee");
  if (!reader) return std::nullopt;
  GuaranteeRequest guarantee{ReadTolerance(*reader), std::move(groups)};
  if (reader->Bool("retune", false))
    reader->Fail("retune", "must be false: settings are chosen once for all worlds");
  reader->Finish();
  return guarantee;
}

namespace {

// Ways to evacuate; other such configurations are refused by name.
bool NotGuaranteedYet(optimizer::Configuration configuration) {
  return configuration == optimizer::Configuration::kDirectVacuumPump ||
         optimizer::IsEjector(configuration);
}

}  // namespace

std::string WhyNotGuaranteed(const optimizer::Problem& problem, const GuaranteeRequest& guarantee) {
  // What contracts more holds less air at first and more of it towards the deepest vacuum.
  if (optimizer::Evacuated(problem) &&
      std::any_of(guarantee.groups.begin(), guarantee.groups.end(),
                  [](const GroupUncertainty& group) { return group.expansion_ratio > 0.0; }))
    return "is for evacuated actuators whose contraction is exact: leave expansion_ratio out of "
           "/actuators/…/relative_uncertainty";
  if (HasVacuumRail(problem)) return "is not for actuators with a low_pressure_kpa_gauge yet";
  if (problem.objective.energy_wh > 0.0)
    return "ranks by mass, volume and cost; energy is told at its upper value and not minimised";
  if (problem.configurations.contains(optimizer::Configuration::kTank) ||
      problem.configurations.contains(optimizer::Configuration::kTankAndPump))
    return "is not for tanks yet: leave tank and tank_and_pump out of /supply/configurations";
  if (problem.configurations.contains(optimizer::Configuration::kDirectPump))
    return "is not for pumps without a reservoir yet: leave direct_pump out of "
           "/supply/configurations";
  if (!problem.configurations.empty() &&
      std::all_of(problem.configurations.begin(), problem.configurations.end(), NotGuaranteedYet))
    return "is for vacuum pumps with a reservoir and for the wall's vacuum: pumps without a "
           "reservoir and ejectors are not guaranteed yet, and the request asks for nothing else";
  if (std::string why = WhyGaitNotGuaranteed(problem); !why.empty()) return why;
  if (problem.groups.size() > 1 && problem.simultaneous)
    return "is for one group and for groups that take turns (/duty/simultaneous false): where "
           "groups inflate at once, a part that passes more may slow another group";
  return "";
}

bool NeedsHoldingValves(const optimizer::Problem& problem) { return problem.groups.size() > 1; }

optimizer::Problem GuaranteedProblem(const optimizer::Problem& problem,
                                     const GuaranteeRequest& guarantee,
                                     const std::vector<catalog::Part>& rows,
                                     const Settled& settled) {
  optimizer::Problem guaranteed = problem;
  guaranteed.guarantee = optimizer::Guarantee{guarantee.tolerance.estimated};
  std::erase_if(guaranteed.configurations, NotGuaranteedYet);
  for (std::size_t g = 0; g < guarantee.groups.size(); ++g) {
    const model::Chamber& printed = problem.groups[g].chamber;
    guaranteed.groups[g].chamber = Resized(printed, guarantee.groups[g], kDeviations);
    guaranteed.groups[g].least = Resized(printed, guarantee.groups[g], -kDeviations);
  }
  guaranteed.parts =
      ToWorstParts(problem, AllowedParts(rows, problem), guarantee.tolerance, settled);
  if (NeedsHoldingValves(problem))
    std::erase_if(guaranteed.parts.valves,
                  [](const model::Valve& valve) { return !model::Holds(valve.kind); });
  ReplaceOutside(guaranteed, guaranteed.parts);
  return guaranteed;
}

}  // namespace plenum::api
