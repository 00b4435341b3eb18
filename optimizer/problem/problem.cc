#include "optimizer/problem/problem.h"

#include <algorithm>

#include "model/physics/storage.h"

namespace plenum::optimizer {

const char* Name(Configuration configuration) {
  switch (configuration) {
    case Configuration::kCylinder:
      return "cylinder";
    case Configuration::kCo2:
      return "co2";
    case Configuration::kCompressor:
      return "compressor";
    case Configuration::kMains:
      return "mains";
    case Configuration::kTank:
      return "tank";
    case Configuration::kDirectPump:
      return "direct_pump";
    case Configuration::kVacuumPump:
      return "vacuum_pump";
    case Configuration::kDirectVacuumPump:
      return "direct_vacuum_pump";
    case Configuration::kEjector:
      return "ejector";
    case Configuration::kDirectEjector:
      return "direct_ejector";
    case Configuration::kTankAndPump:
      return "tank_and_pump";
  }
  return "";
}

const char* Name(NlpSolver solver) { return solver == NlpSolver::kIpopt ? "ipopt" : "nlopt"; }

const char* Name(Regulation regulation) {
  switch (regulation) {
    case Regulation::kShared:
      return "shared";
    case Regulation::kPerGroup:
      return "per_group";
    case Regulation::kAny:
      return "any";
  }
  return "";
}

const char* Name(PumpFeed feed) {
  switch (feed) {
    case PumpFeed::kShared:
      return "shared";
    case PumpFeed::kPerGroup:
      return "per_group";
    case PumpFeed::kPerActuator:
      return "per_actuator";
  }
  return "";
}

const char* Name(PowerKind kind) {
  switch (kind) {
    case PowerKind::kBattery:
      return "battery";
    case PowerKind::kWall:
      return "wall";
    case PowerKind::kRobot:
      return "robot";
  }
  return "";
}

const char* Name(ListOf list) { return list == ListOf::kKinds ? "kinds" : "combinations"; }

const char* Name(Status status) {
  switch (status) {
    case Status::kOptimal:
      return "optimal";
    case Status::kFeasible:
      return "feasible";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kCancelled:
      return "cancelled";
  }
  return "";
}

double KpaGauge(const Problem& problem, double pressure_pa) {
  const double image_kpa = (pressure_pa - problem.ambient.pressure_pa) / 1e3;
  return Evacuated(problem) ? -image_kpa : image_kpa;
}

double PaFromKpaGauge(const Problem& problem, double kpa_gauge) {
  return problem.ambient.pressure_pa + 1e3 * (Evacuated(problem) ? -kpa_gauge : kpa_gauge);
}

std::string GroupPointer(const Problem& problem, int group) {
  const int entry = problem.groups[group].entry;
  return "/actuators/" + std::to_string(entry < 0 ? group : entry);
}

std::string PressureLimitPointer(const Problem& problem, int group) {
  return GroupPointer(problem, group) +
         (Evacuated(problem) ? "/pressure_kpa_gauge_min" : "/pressure_kpa_gauge_max");
}

std::string SourceLimitPointer(const Problem& problem) {
  return Evacuated(problem) ? "/supply/vacuum/vacuum_kpa_gauge_min"
                            : "/supply/source_pressure_kpa_gauge_max";
}

void FollowMission(double mission_s, model::Parts& parts) {
  for (model::Co2Bottle& bottle : parts.co2)
    if (bottle.flow_endless_m3_per_s > 0.0)
      bottle.flow_sustained_m3_per_s =
          model::Co2Draw(bottle.flow_endless_m3_per_s,
                         std::max(0.0, bottle.basics.mass_kg - bottle.basics.mass_slack_kg),
                         bottle.co2_mass_kg, mission_s);
}

double RiseTarget(const Problem& problem, const ActuatorGroup& group) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return ambient_pa + problem.rise_fraction * (group.chamber.operating_pressure_pa - ambient_pa);
}

double FallTarget(const Problem& problem, const ActuatorGroup& group) {
  const double rest_pa = model::RestPa(group.chamber);
  return rest_pa + problem.fall_fraction * (group.chamber.operating_pressure_pa - rest_pa);
}

}  // namespace plenum::optimizer
