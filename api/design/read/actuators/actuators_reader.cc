#include "api/design/read/actuators/actuators_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "api/design/read/actuators/gait_reader.h"
#include "api/json/request_limits.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/simulate/group_chamber.h"
#include "model/flow/series.h"

namespace plenum::api {
namespace {

// Valve, tube and the shared regulator take three places of a series.
constexpr int kFittingsMax = static_cast<int>(model::kMaxSeriesElements) - 3;
constexpr double kPressureMarginDefault = 1.05;
constexpr double kVacuumMaxKpa = 200.0;  // below ambient, at any ambient pressure
const Range kTimeLimitS = Above(0, 1e6);

// kPa gauge.
double ReadHighestPressure(Reader& group, double operating_kpa) {
  if (group.Has("pressure_kpa_gauge_min"))
    group.Fail("pressure_kpa_gauge_min",
               "is for actuators that are evacuated; of one under pressure pressure_kpa_gauge_max "
               "is the limit");
  const auto limit_kpa = group.OptionalNumber("pressure_kpa_gauge_max", {1, kGaugeMaxKpa});
  if (limit_kpa && *limit_kpa < operating_kpa - 1e-9)
    group.Fail("pressure_kpa_gauge_max", "must be ≥ the operating pressure of " +
                                             Decimal(Rounded(operating_kpa)) + " kPa gauge, not " +
                                             Decimal(*limit_kpa));
  return limit_kpa.value_or(kPressureMarginDefault * operating_kpa);
}

// The same of an evacuated actuator.
double ReadLowestPressure(Reader& group, double operating_kpa) {
  if (group.Has("pressure_kpa_gauge_max"))
    group.Fail(
        "pressure_kpa_gauge_max",
        "is for actuators under pressure; of one that is evacuated pressure_kpa_gauge_min is "
        "the limit");
  const auto limit_kpa = group.OptionalNumber("pressure_kpa_gauge_min", {-kVacuumMaxKpa, -1});
  if (limit_kpa && *limit_kpa > operating_kpa + 1e-9)
    group.Fail("pressure_kpa_gauge_min", "must be ≤ the operating pressure of " +
                                             Decimal(Rounded(operating_kpa)) + " kPa gauge, not " +
                                             Decimal(*limit_kpa));
  return limit_kpa.value_or(kPressureMarginDefault * operating_kpa);
}

// The group, and the chamber on the side of the rod where it has one.
optimizer::ActuatorGroup ReadGroup(Reader& reader, const model::Ambient& ambient,
                                   std::optional<model::Chamber>& rod_side) {
  optimizer::ActuatorGroup group;
  group.count = reader.Integer("count", 1, kCountMax, 1);
  group.chamber = ReadChamber(reader, ambient, Vacuum::kAllowed, &rod_side, kOperatingGaugeMaxKpa);
  ReadLowPressure(reader, ambient, rod_side.has_value(), group.chamber);
  group.tube_length_m = reader.Number("tube_length_m", TubeLengthRange());
  group.fittings_per_line = reader.Integer("fittings_per_line", 0, kFittingsMax, 2);
  group.rise_time_max_s =
      reader.OptionalNumber("rise_time_s_max", kTimeLimitS).value_or(optimizer::kUnlimited);
  group.fall_time_max_s =
      reader.OptionalNumber("fall_time_s_max", kTimeLimitS).value_or(optimizer::kUnlimited);

  group.gait = ReadGait(reader, group.count);
  const double operating_kpa = KpaGaugeFromPa(group.chamber.operating_pressure_pa, ambient);
  group.pressure_max_pa = group.chamber.evacuated
                              ? PaFromKpaGauge(-ReadLowestPressure(reader, -operating_kpa), ambient)
                              : PaFromKpaGauge(ReadHighestPressure(reader, operating_kpa), ambient);
  return group;
}

std::string SideName(Reader& actuator, std::string name, std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end())
    actuator.Fail(
        "name", "makes the name of a side, " + Quoted(name) + ", which is taken by another group");
  names.push_back(name);
  return name;
}

bool IsRodSide(const optimizer::Problem& problem, std::size_t group) {
  return group > 0 && problem.groups[group].entry == problem.groups[group - 1].entry;
}

}  // namespace

std::vector<GroupUncertainty> ReadActuators(Reader& request, optimizer::Problem& problem) {
  std::vector<GroupUncertainty> uncertainties;
  std::vector<std::string> names;
  int entry = 0;
  for (const Element& element : request.List("actuators", 1, kGroupsMax)) {
    Reader reader(element, request.errors());
    const std::string name = ReadName(reader, entry, names);
    std::optional<model::Chamber> rod_side;
    optimizer::ActuatorGroup group = ReadGroup(reader, problem.ambient, rod_side);
    const GroupUncertainty uncertainty = ReadGroupUncertainty(reader);
    group.name = name;
    group.entry = entry++;
    problem.groups.push_back(group);
    uncertainties.push_back(uncertainty);
    if (rod_side) {
      problem.groups.back().name = SideName(reader, name + ", cap side", names);
      group.name = SideName(reader, name + ", rod side", names);
      group.chamber = *rod_side;
      problem.groups.push_back(std::move(group));
      uncertainties.push_back(uncertainty);
    }
    reader.Finish();
  }
  return uncertainties;
}

void AlternateSides(optimizer::Problem& problem) {
  std::vector<optimizer::ActuatorGroup>& groups = problem.groups;
  const auto is_rod_side = [&](std::size_t g) { return IsRodSide(problem, g); };
  bool any = false;
  for (std::size_t g = 0; g < groups.size(); ++g) any = any || is_rod_side(g);
  if (!any) return;
  const double entries = groups.back().entry + 1.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    optimizer::Gait& gait = groups[g].gait;
    const double strokes = gait.strokes_per_period;
    if (gait.phases.empty())
      gait.phases = {problem.simultaneous ? 0.0 : groups[g].entry / (entries * strokes)};
    if (!is_rod_side(g)) continue;
    for (double& phase : gait.phases)
      phase = std::fmod(phase + gait.inflate_fraction / strokes, 1.0);
    gait.inflate_fraction = 1.0 - gait.inflate_fraction;
  }
}

}  // namespace plenum::api
