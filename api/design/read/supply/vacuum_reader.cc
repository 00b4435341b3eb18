#include "api/design/read/supply/vacuum_reader.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;

// Ejectors are asked for by name, or where nothing is said and the wall has compressed air.
struct Asked {
  bool pumps = true, ejectors = true, wall = false, named = false;
};

Asked ReadKinds(Reader& vacuum) {
  if (!vacuum.Has("configurations")) return {};
  Asked asked{false, false, false, true};
  const std::vector<std::string> names{"pump", "ejector", "mains"};
  const std::vector<std::string> given = vacuum.Texts("configurations", 1, names.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string place = "configurations/" + std::to_string(i);
    if (given[i] == "pump")
      asked.pumps = true;
    else if (given[i] == "mains")
      asked.wall = true;
    else if (given[i] == "ejector")
      asked.ejectors = true;
    else if (!given[i].empty())
      vacuum.FailAt(place, "must be " + OneOf(names) + ", not " + Quoted(given[i]));
  }
  return asked;
}

// The wall's vacuum.
void ReadWall(Reader& vacuum, bool asked, optimizer::Problem& problem) {
  auto mains = vacuum.OptionalObject("mains");
  if (!mains && asked) vacuum.Fail("mains", "is required by the configuration mains");
  if (!mains) return;
  problem.mains = {};
  const double kpa = mains->Number("pressure_kpa_gauge", {-problem.ambient.pressure_pa / 1e3, -1});
  problem.mains.pressure_pa = optimizer::PaFromKpaGauge(problem, kpa);
  RefuseFlow(*mains);
  mains->Finish();
}

// A low pressure that could not be read says all the same what the vacuum is for.
bool LowPressureFailed(const Errors& errors) {
  return std::any_of(errors.begin(), errors.end(), [](const Error& error) {
    return error.pointer.ends_with("/low_pressure_kpa_gauge");
  });
}

}  // namespace

void ReadVacuum(Reader& supply, optimizer::Problem& problem) {
  const bool evacuated = optimizer::Evacuated(problem);
  for (std::size_t g = 1; g < problem.groups.size(); ++g)
    if (problem.groups[g].chamber.evacuated != evacuated)
      supply.errors().push_back(
          {optimizer::GroupPointer(problem, static_cast<int>(g)) + "/operating_pressure_kpa_gauge",
           "must be on the same side of ambient pressure as that of the first group: actuators "
           "under pressure and evacuated ones in one design are not searched yet"});
  if (HasVacuumRail(problem)) return ReadVacuumRail(supply, problem);
  if (evacuated) problem.compressed_air = std::exchange(problem.mains, {});
  auto vacuum = supply.OptionalObject("vacuum");
  if (vacuum && !evacuated && !LowPressureFailed(supply.errors()))
    supply.Fail("vacuum",
                "is for actuators that go below ambient: none has an operating pressure or a "
                "low_pressure_kpa_gauge below 0 kPa gauge");
  Asked asked;
  if (vacuum) {
    asked = ReadKinds(*vacuum);
    ReadWall(*vacuum, asked.wall, problem);
    const auto deepest =
        vacuum->OptionalNumber("vacuum_kpa_gauge_min", {-problem.ambient.pressure_pa / 1e3, -1});
    if (deepest && evacuated)
      problem.source_pressure_max_pa = optimizer::PaFromKpaGauge(problem, *deepest);
    vacuum->Finish();
  }
  if (!evacuated) return;
  problem.configurations.clear();
  if (asked.pumps)
    problem.configurations = {Configuration::kVacuumPump, Configuration::kDirectVacuumPump};
  const bool compressed = problem.compressed_air.pressure_pa > 0.0;
  if (asked.named && asked.ejectors && !compressed)
    supply.Fail("mains",
                "is required by the ejectors of supply.vacuum.configurations: its pressure, and "
                "its flow if that has a limit, say what compressed air they have");
  if (asked.ejectors && compressed)
    problem.configurations.insert({Configuration::kEjector, Configuration::kDirectEjector});
  if (asked.wall) problem.configurations.insert(Configuration::kMains);
}

void CheckVacuum(const optimizer::Problem& problem, Errors& errors) {
  const bool wall = problem.mains.pressure_pa > 0.0 &&
                    problem.configurations == std::set<Configuration>{Configuration::kMains};
  const auto told = [&](double pa) { return Decimal(Rounded(optimizer::KpaGauge(problem, pa))); };
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
    const auto fail = [&](const std::string& why) {
      errors.push_back(
          {optimizer::GroupPointer(problem, static_cast<int>(g)) + "/operating_pressure_kpa_gauge",
           "is " + told(operating_pa) + ", below the " + why});
    };
    if (operating_pa > problem.source_pressure_max_pa)
      fail("deepest vacuum allowed: /supply/vacuum/vacuum_kpa_gauge_min is " +
           told(problem.source_pressure_max_pa));
    else if (wall && operating_pa > problem.mains.pressure_pa)
      fail("only source: /supply/vacuum/mains/pressure_kpa_gauge is " +
           told(problem.mains.pressure_pa));
  }
}

}  // namespace plenum::api
