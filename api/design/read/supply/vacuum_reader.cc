#include "api/design/read/supply/vacuum_reader.h"

#include <string>
#include <vector>

#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;

// Whether the request asks for pumps; an ejector and a vacuum from the wall are refused by name.
bool AsksForPumps(Reader& vacuum) {
  if (!vacuum.Has("configurations")) return true;
  const std::vector<std::string> names{"pump", "ejector", "mains"};
  const std::vector<std::string> given = vacuum.Texts("configurations", 1, names.size());
  bool pumps = false;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string place = "configurations/" + std::to_string(i);
    if (given[i] == "pump")
      pumps = true;
    else if (given[i] == "ejector" || given[i] == "mains")
      vacuum.FailAt(place, "must be pump: " +
                               std::string(given[i] == "mains" ? "a vacuum from the wall is"
                                                               : "ejectors are") +
                               " not searched yet");
    else if (!given[i].empty())
      vacuum.FailAt(place, "must be " + OneOf(names) + ", not " + Quoted(given[i]));
  }
  return pumps;
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
  auto vacuum = supply.OptionalObject("vacuum");
  if (vacuum && !evacuated)
    supply.Fail("vacuum",
                "is for actuators that are evacuated: none has an operating pressure below 0 kPa "
                "gauge");
  bool pumps = evacuated;
  if (vacuum) {
    pumps = AsksForPumps(*vacuum);
    const auto deepest =
        vacuum->OptionalNumber("vacuum_kpa_gauge_min", {-problem.ambient.pressure_pa / 1e3, -1});
    if (deepest && evacuated)
      problem.source_pressure_max_pa = optimizer::PaFromKpaGauge(problem, *deepest);
    vacuum->Finish();
  }
  if (!evacuated) return;
  problem.configurations.clear();
  if (pumps)
    problem.configurations = {Configuration::kVacuumPump, Configuration::kDirectVacuumPump};
}

void CheckVacuum(const optimizer::Problem& problem, Errors& errors) {
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
    if (!(operating_pa > problem.source_pressure_max_pa)) continue;
    const auto told = [&](double pa) { return Decimal(Rounded(optimizer::KpaGauge(problem, pa))); };
    errors.push_back(
        {optimizer::GroupPointer(problem, static_cast<int>(g)) + "/operating_pressure_kpa_gauge",
         "is " + told(operating_pa) +
             ", below the deepest vacuum allowed: "
             "/supply/vacuum/vacuum_kpa_gauge_min is " +
             told(problem.source_pressure_max_pa)});
  }
}

}  // namespace plenum::api
