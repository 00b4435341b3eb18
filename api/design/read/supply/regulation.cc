#include "api/design/read/supply/regulation.h"

#include <algorithm>
#include <cmath>

#include "api/design/read/design_reader.h"
#include "api/json/remarks.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/problem/own_regulators.h"

namespace plenum::api {
namespace {

using optimizer::Family;
using optimizer::Regulation;

constexpr double kPressureRounding = 1e-6;  // relative, of a stated pressure

void CheckPressures(const optimizer::Design& design, const optimizer::Problem& problem,
                    const std::function<void(const char*, std::string)>& fail) {
  const std::vector<double>& group_pa = design.settings.group_pressure_pa;
  if (group_pa.size() != problem.groups.size())
    return fail("/settings/group_pressure_kpa_gauge",
                "must have a pressure for each of the " + std::to_string(problem.groups.size()) +
                    " groups, behind its own regulator, not " + std::to_string(group_pa.size()));
  const double highest_pa = *std::max_element(group_pa.begin(), group_pa.end());
  if (std::abs(design.settings.source_pressure_pa - highest_pa) > kPressureRounding * highest_pa)
    fail("/settings/source_pressure_kpa_gauge",
         "must be the highest of group_pressure_kpa_gauge, " +
             Decimal(Rounded(optimizer::KpaGauge(problem, highest_pa))));
}

}  // namespace

void ReadRegulation(Reader& supply, optimizer::Problem& problem) {
  if (supply.Has("regulation"))
    problem.regulation = ReadEnum<Regulation>(
        supply, "regulation", {Regulation::kShared, Regulation::kPerGroup, Regulation::kAny});
}

void WarnOfRegulation(const optimizer::Problem& problem) {
  RemarkRecorder* remarks = RemarkRecorder::Current();
  if (problem.regulation != Regulation::kPerGroup || !remarks) return;
  std::string without;
  for (const optimizer::Configuration configuration : problem.configurations)
    if (!optimizer::MayOwnRegulators(problem, configuration))
      without += (without.empty() ? "" : ", ") + std::string(optimizer::Name(configuration));
  if (!without.empty())
    remarks->Warn("/supply/regulation",
                  "groups have no regulators of their own in designs of " + without +
                      ": that is for bottles, tanks and mains that feed several groups, none of "
                      "them a double-acting cylinder; of mains with a limited flow only where "
                      "groups take turns");
}

std::string UnlessOwn(Family family) {
  return family == Family::kRegulator ? ", unless supply.regulation lets each have its own" : "";
}

bool HaveOwnRegulators(const optimizer::Design& design, const optimizer::Problem& problem) {
  return problem.regulation != Regulation::kShared &&
         optimizer::MayOwnRegulators(problem, design.configuration) &&
         (optimizer::HasOwnRegulators(design.parts) || problem.regulation == Regulation::kPerGroup);
}

void CheckRegulation(const optimizer::Design& design, const optimizer::Problem& problem,
                     const std::function<void(const char* place, std::string detail)>& fail) {
  if (!HaveOwnRegulators(design, problem)) {
    if (!design.settings.group_pressure_pa.empty())
      fail("/settings/group_pressure_kpa_gauge",
           "must be left out: groups of this design have no regulators of their own");
    return;
  }
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (std::none_of(design.parts.begin(), design.parts.end(), [&](const auto& row) {
          return row.family == Family::kRegulator && row.group == g;
        }))
      fail("/parts", "a regulator for group " + problem.groups[g].name +
                         " is missing: each group has its own");
  CheckPressures(design, problem, fail);
}

}  // namespace plenum::api
