#include "api/design/read/supply/power.h"

#include <algorithm>
#include <string>
#include <vector>

#include "api/design/read/design_reader.h"
#include "api/json/shared_fields.h"
#include "model/physics/storage.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

using optimizer::Family;
using optimizer::Power;
using optimizer::PowerKind;

// More than a supply from the wall is asked for.
constexpr double kWallAh = 1e6, kWallA = 1e6;
// Of a pump's voltage: as high as a pump surely takes.
constexpr double kHigher = 1.149;
static_assert(kHigher < 1.0 + model::kVoltageTolerance);
constexpr double kVoltageMax = 1000.0, kEnergyMaxWh = 1e6, kCurrentMaxA = 1e4;

model::Battery Supply(std::string id, double voltage_v, double capacity_ah, double current_max_a) {
  model::Battery supply;
  supply.basics.id = std::move(id);
  supply.basics.cost_eur = 0.0;
  supply.nominal_voltage_v = voltage_v;
  supply.capacity_ah = capacity_ah;
  supply.current_max_a = current_max_a;
  return supply;
}

// So that each pump has exactly one: the highest voltage that the lowest pump without one takes,
// and so on.
std::vector<model::Battery> WallSupplies(const std::vector<model::Compressor>& pumps) {
  std::vector<double> voltages;
  voltages.reserve(pumps.size());
  for (const model::Compressor& pump : pumps) voltages.push_back(pump.curve.voltage_v);
  std::sort(voltages.begin(), voltages.end());
  std::vector<model::Battery> supplies;
  const auto add = [&](double voltage_v) {
    supplies.push_back(
        Supply("wall-" + std::to_string(supplies.size() + 1), voltage_v, kWallAh, kWallA));
  };
  for (const double pump_v : voltages)
    if (supplies.empty() || !model::VoltageMatches(supplies.back().nominal_voltage_v, pump_v))
      add(pump_v * kHigher);
  if (supplies.empty()) add(1.0);
  return supplies;
}

const model::Compressor* PumpOf(const optimizer::Design& design,
                                const optimizer::Problem& problem) {
  for (const optimizer::Choice& choice : design.parts) {
    if (!optimizer::IsPump(choice.family)) continue;
    const int pump = optimizer::FindPart(problem.parts, choice.family, choice.id);
    if (pump >= 0)
      return &optimizer::PumpsIn(problem.parts, choice.family)[static_cast<std::size_t>(pump)];
  }
  return nullptr;
}

}  // namespace

void ReadPower(Reader& supply, optimizer::Problem& problem) {
  auto power = supply.OptionalObject("power");
  if (!power) return;
  Power& read = problem.power;
  read.kind = ReadEnum<PowerKind>(*power, "kind",
                                  {PowerKind::kBattery, PowerKind::kWall, PowerKind::kRobot});
  if (read.kind == PowerKind::kRobot) {
    const auto voltage_v = power->OptionalNumber("voltage_v", Above(0, kVoltageMax));
    if (!voltage_v) power->Fail("voltage_v", "is required of a robot");
    read.voltage_v = voltage_v.value_or(1.0);
    read.energy_wh_max = power->OptionalNumber("energy_wh_max", Above(0, kEnergyMaxWh));
    read.current_a_max = power->OptionalNumber("current_a_max", Above(0, kCurrentMaxA));
  }
  power->Finish();
}

void ReplaceBatteries(const optimizer::Problem& problem, model::Parts& parts) {
  const Power& power = problem.power;
  if (power.kind == PowerKind::kWall)
    parts.batteries = WallSupplies(optimizer::Evacuated(problem) || optimizer::PumpsRail(problem)
                                       ? parts.vacuum_pumps
                                       : parts.compressors);
  if (power.kind == PowerKind::kRobot) {
    const double capacity_ah =
        power.energy_wh_max ? *power.energy_wh_max / (power.voltage_v * model::kDepthOfDischarge)
                            : kWallAh;
    parts.batteries = {
        Supply("robot", power.voltage_v, capacity_ah, power.current_a_max.value_or(kWallA))};
  }
}

bool HasOutsidePower(const optimizer::Problem& problem) {
  return problem.power.kind != PowerKind::kBattery;
}

bool IsOutsidePower(const optimizer::Choice& choice, const optimizer::Problem& problem) {
  return choice.family == Family::kBattery && HasOutsidePower(problem);
}

void AddOutsidePower(const optimizer::Problem& problem, optimizer::Design& design) {
  const std::vector<model::Battery>& supplies = problem.parts.batteries;
  if (!HasOutsidePower(problem) || supplies.empty() ||
      !optimizer::SpecOf(Family::kBattery).InSourceOf(design.configuration) ||
      std::any_of(design.parts.begin(), design.parts.end(),
                  [](const auto& row) { return row.family == Family::kBattery; }))
    return;
  const model::Compressor* pump = PumpOf(design, problem);
  const auto drives = [&](const model::Battery& supply) {
    return !pump || model::VoltageMatches(supply.nominal_voltage_v, pump->curve.voltage_v);
  };
  const auto found = std::find_if(supplies.begin(), supplies.end(), drives);
  const model::Battery& supply = found == supplies.end() ? supplies.front() : *found;
  optimizer::Choice row;
  row.family = Family::kBattery;
  row.id = supply.basics.id;
  row.cost_eur = 0.0;
  // In the order of a parts list: before the reservoir.
  const auto reservoir =
      std::find_if(design.parts.begin(), design.parts.end(), [](const auto& part) {
        return part.family == Family::kReservoir || part.family == Family::kVacuumReservoir;
      });
  design.parts.insert(reservoir, std::move(row));
}

Json RenderPower(const optimizer::Design& design, const optimizer::Problem& problem) {
  if (!HasOutsidePower(problem)) return nullptr;
  Json power = {{"kind", optimizer::Name(problem.power.kind)}};
  const bool motor = !optimizer::IsEjector(design.configuration);
  const model::Compressor* pump = motor ? PumpOf(design, problem) : nullptr;
  if (problem.power.kind == PowerKind::kRobot)
    power["voltage_v"] = Number(problem.power.voltage_v);
  else
    power["voltage_v"] = pump ? Number(pump->curve.voltage_v) : Json(nullptr);
  return power;
}

}  // namespace plenum::api
