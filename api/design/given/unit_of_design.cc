#include "api/design/given/unit_of_design.h"

#include <utility>

#include "api/design/given/given_request.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/version.h"
#include "fmu/unit_file.h"
#include "optimizer/problem/own_regulators.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

fmu::Unit UnitOf(std::string name, optimizer::DrivenDesign driven) {
  fmu::Unit unit;
  unit.name = std::move(name);
  unit.rig = std::move(driven.rig);
  for (std::size_t i = 0; i < unit.rig.groups.size(); ++i)
    unit.valves.push_back({driven.coil_power_w[i], driven.holds[i]});
  unit.regulator_power_w = driven.regulator_power_w;
  unit.energy_available_j = driven.energy_available_j;
  unit.air_available_m3 = driven.air_available_m3;
  return unit;
}

}  // namespace

Parsed<std::string> MakeUnitFile(const Json& request, const std::vector<catalog::Part>& parts,
                                 const std::vector<catalog::ModelRevision>& models,
                                 double seconds_max) {
  auto read = ReadGivenRequest(request, parts, models);
  if (auto* errors = std::get_if<Errors>(&read)) return *errors;
  const auto& given = std::get<GivenRequest>(read);
  if (given.asked.model)
    return Errors{{"/requirements/model",
                   "must be \"nominal\": a unit does not hold the effects of a saved model"}};
  if (optimizer::HasOwnRegulators(given.design.parts))
    return Errors{{"/design/parts",
                   "must have one regulator for all groups: a unit has one source, and regulators "
                   "of their own for each group are not among what it can hold"}};
  if (given.asked.problem.pump_feed != optimizer::PumpFeed::kShared)
    return Errors{{"/requirements/supply/pumps",
                   "must be shared: a unit has one source, and pumps of their own for each group "
                   "or actuator are not among what it can hold"}};
  if (optimizer::PumpsHoldOn(given.asked.problem))
    return Errors{{"/requirements/supply/hold_on",
                   "must be false: the pumps of a unit run while its valves fill, and not on while "
                   "they hold"}};
  if (HasVacuumRail(given.asked.problem))
    return Errors{{"/requirements/actuators",
                   "must be without low_pressure_kpa_gauge: the valves of a unit vent into the "
                   "surroundings"}};
  auto driven = optimizer::Drive(optimizer::WithPartsOf(given.asked.problem, given.design),
                                 given.design, After(seconds_max));
  if (!driven)
    return Errors{{"/design", "does not work at its settings with these requirements and parts"}};
  const std::string& name = given.asked.name;
  std::string file = fmu::UnitFile(UnitOf(name.empty() ? "supply" : name, *std::move(driven)),
                                   "plenum " + std::string(Version()));
  if (file.empty()) return Errors{{"", "this build of plenum makes no units"}};
  return file;
}

Parsed<Json> EvaluationOfRank(const Json& answer, int rank) {
  if (answer.is_object() && answer.value("schema", Json()) == "designs/1" &&
      answer.contains("requirements") && answer.value("designs", Json()).is_array()) {
    for (const Json& design : answer.at("designs"))
      if (design.is_object() && design.value("rank", Json()) == rank)
        return Json{{"schema", "evaluation/1"},
                    {"requirements", answer.at("requirements")},
                    {"design", design}};
    return Errors{{"/designs", "has no design of rank " + std::to_string(rank)}};
  }
  return Errors{{"", "must be an answer of design --json: a document designs/1"}};
}

}  // namespace plenum::api
