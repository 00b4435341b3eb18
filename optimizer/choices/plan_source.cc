// Families of the source.
#include "optimizer/choices/planter.h"

namespace plenum::optimizer {
namespace {

// Equal for equal curves.
std::string Bytes(const model::CompressorCurve& curve) {
  std::string bytes;
  const auto add = [&](std::span<const double> values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  };
  add(std::array{curve.voltage_v, curve.pressure_max_pa});
  for (const model::MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a}) {
    add(table->x());
    add(table->y());
  }
  return bytes;
}

}  // namespace

int Planter::PlantRegulators() {
  Entries<RegulatorCorner> entries;
  entries.Reserve(problem_.parts.regulators.size());
  for (int i = 0; i < static_cast<int>(problem_.parts.regulators.size()); ++i) {
    const model::Regulator& part = problem_.parts.regulators[i];
    if (!Priced(part.basics)) continue;
    const Entry<RegulatorCorner> entry = entries.Add();
    entry.item.option = {i, 1, 1.0 * part.basics};
    RegulatorCorner& corner = entry.item.corner;
    SetShare(problem_, entry.item.option.amounts, corner);
    corner.flow = part.flow;
    corner.flow_max_m3_per_s = part.flow_max_m3_per_s;
    corner.inlet_min_pa = part.inlet_pressure_min_pa;
    corner.inlet_max_pa = part.inlet_pressure_max_pa;
    corner.outlet_min_pa = part.outlet_pressure_min_pa;
    corner.outlet_max_pa = part.outlet_pressure_max_pa;
    corner.electrical_power_w = part.electrical_power_w;
    corner.objective += EnergyWeight(problem_) * problem_.actuations * part.electrical_power_w /
                        problem_.frequency_hz;
    entry.contender.id = part.basics.id;
    entry.contender.losses = {-part.flow.sonic_conductance_m3_per_s_pa,
                              -part.flow.critical_ratio,
                              part.flow.subsonic_index,
                              -part.flow_max_m3_per_s,
                              part.inlet_pressure_min_pa,
                              -part.inlet_pressure_max_pa,
                              part.outlet_pressure_min_pa,
                              -part.outlet_pressure_max_pa,
                              part.electrical_power_w};
  }
  return PlantSlot(Family::kRegulator, -1, static_cast<long long>(problem_.parts.regulators.size()),
                   std::move(entries), plan_->regulators);
}

void Planter::SetBottle(double gas_kg, double full_m3, double water_m3, double fill_pa,
                        double flow_m3_per_s, const Entry<BottleCorner>& entry) const {
  entry.item.option.amounts.mass_kg += gas_kg;
  BottleCorner& corner = entry.item.corner;
  SetShare(problem_, entry.item.option.amounts, corner);
  const auto gas_m3 = [&](double inlet_pa) {
    return full_m3 - water_m3 * GasLeft(problem_, plan_->configuration, inlet_pa);
  };
  corner.gas_to_low_m3 = gas_m3(plan_->bottle_range.low_pa);
  corner.gas_to_high_m3 = gas_m3(plan_->bottle_range.high_pa);
  corner.fill_pressure_pa = fill_pa;
  corner.flow_sustained_m3_per_s = flow_m3_per_s;
  entry.contender.losses = {-corner.gas_to_low_m3, -corner.gas_to_high_m3, fill_pa, -flow_m3_per_s};
}

int Planter::PlantCylinders() {
  const double temperature_k = problem_.ambient.temperature_k;
  const auto make = [&](const model::Cylinder& part, int quantity,
                        const Entry<BottleCorner>& entry) {
    const double full_m3 =
        part.water_volume_m3 * GasLeft(problem_, plan_->configuration, part.fill_pressure_pa);
    SetBottle(quantity *
                  model::CylinderCharge(part.water_volume_m3, part.fill_pressure_pa, temperature_k),
              quantity * full_m3, quantity * part.water_volume_m3, part.fill_pressure_pa,
              kUnlimited, entry);
  };
  const int most = problem_.limits.cylinders;
  const auto& parts = problem_.parts.cylinders;
  return PlantSlot(Family::kCylinder, -1, static_cast<long long>(parts.size()) * most,
                   InParallel<BottleCorner>(parts, most, make), plan_->bottles);
}

int Planter::PlantCo2() {
  const auto make = [&](const model::Co2Bottle& part, int quantity,
                        const Entry<BottleCorner>& entry) {
    SetBottle(quantity * part.co2_mass_kg,
              quantity * part.co2_mass_kg / model::kReferenceDensityCo2KgPerM3,
              quantity * part.water_volume_m3, 0.0, quantity * part.flow_sustained_m3_per_s, entry);
  };
  const int most = problem_.limits.co2;
  const auto& parts = problem_.parts.co2;
  return PlantSlot(Family::kCo2, -1, static_cast<long long>(parts.size()) * most,
                   InParallel<BottleCorner>(parts, most, make), plan_->bottles);
}

int Planter::PlantCompressors() {
  const int most = problem_.limits.compressors;
  for (const model::Compressor& part : problem_.parts.compressors)
    voltages_.Bit(part.curve.voltage_v);
  CoarsePump alone;                                // one of the part that is planted
  std::unordered_map<std::string, int> number_of;  // of a curve
  int curve_number = 0;
  const auto make = [&](const model::Compressor& part, int quantity,
                        const Entry<CompressorCorner>& entry) {
    const model::CompressorCurve& curve = part.curve;
    CompressorCorner& corner = entry.item.corner;
    SetShare(problem_, entry.item.option.amounts, corner);
    corner.voltages = voltages_.Bit(curve.voltage_v);
    corner.duty_max = part.duty_max;
    corner.pressure_max_pa = model::HighestPressure(curve);
    if (quantity == 1) {
      alone = MakeCoarsePump(problem_, plan_->highest_pump_pa, curve);
      curve_number =
          number_of.try_emplace(Bytes(curve), static_cast<int>(number_of.size())).first->second;
    }
    corner.pump = Several(alone, quantity);
    entry.contender.mates = curve_number * most + quantity - 1;
    entry.contender.losses = {-part.duty_max};
  };
  const auto& parts = problem_.parts.compressors;
  return PlantSlot(Family::kCompressor, -1, static_cast<long long>(parts.size()) * most,
                   InParallel<CompressorCorner>(parts, most, make), plan_->compressors);
}

void Planter::AddMadeReservoir(int mates, const Entry<ReservoirCorner>& entry) const {
  entry.item.option.index = kCustom;
  entry.item.option.quantity = 1;
  ReservoirCorner& corner = entry.item.corner;
  SetShare(problem_, CustomReservoir(problem_, model::kMadeReservoirSmallestM3), corner);
  corner.custom = true;
  corner.low_m3 = model::kMadeReservoirSmallestM3;
  corner.high_m3 = model::kMadeReservoirLargestM3;
  corner.pressure_max_pa = CustomRatingPa(problem_);
  entry.contender.id = "custom";
  entry.contender.mates = mates;
  entry.contender.losses = {0.0};
}

int Planter::PlantReservoirs() {
  NumbersOf<double> volumes;
  const auto make = [&](const model::Reservoir& part, int quantity,
                        const Entry<ReservoirCorner>& entry) {
    ReservoirCorner& corner = entry.item.corner;
    SetShare(problem_, entry.item.option.amounts, corner);
    corner.low_m3 = corner.high_m3 = quantity * part.volume_m3;
    corner.pressure_max_pa = part.pressure_max_pa;
    entry.contender.mates = volumes.Of(corner.low_m3);
    entry.contender.losses = {-part.pressure_max_pa};
  };
  const int most = problem_.limits.reservoirs;
  const auto& parts = problem_.parts.reservoirs;
  long long total = static_cast<long long>(parts.size()) * most;
  Entries<ReservoirCorner> entries = InParallel<ReservoirCorner>(parts, most, make);
  const auto required = problem_.require.find(Family::kReservoir);
  if (!problem_.exclude.contains("custom") &&
      (required == problem_.require.end() || required->second.contains("custom"))) {
    ++total;
    if (!CostMatters(problem_)) AddMadeReservoir(volumes.size(), entries.Add());
  }
  return PlantSlot(Family::kReservoir, -1, total, std::move(entries), plan_->reservoirs);
}

int Planter::PlantBatteries() {
  std::map<double, Kinds> drives;  // by pack voltage
  NumbersOf<double> voltages;
  const auto make = [&](const model::Battery& part, int quantity,
                        const Entry<BatteryCorner>& entry) {
    const double pack_v = part.nominal_voltage_v;
    const auto [kinds, fresh] = drives.try_emplace(pack_v, ~Kinds{0});
    if (fresh && plan_->configuration == Configuration::kCompressor)
      kinds->second =
          voltages_.Where([&](double pump_v) { return model::VoltageMatches(pack_v, pump_v); });
    BatteryCorner& corner = entry.item.corner;
    SetShare(problem_, entry.item.option.amounts, corner);
    corner.voltages = kinds->second;
    corner.energy_j = quantity * model::UsableEnergy(part.capacity_ah, pack_v);
    corner.current_max_a = quantity * part.current_max_a;
    corner.voltage_v = pack_v;
    if (plan_->configuration == Configuration::kCompressor)
      entry.contender.mates = voltages.Of(pack_v);
    entry.contender.losses = {-corner.energy_j, -corner.current_max_a, -pack_v};
  };
  const int most = problem_.limits.batteries;
  const auto& parts = problem_.parts.batteries;
  return PlantSlot(Family::kBattery, -1, static_cast<long long>(parts.size()) * most,
                   InParallel<BatteryCorner>(parts, most, make), plan_->batteries);
}

}  // namespace plenum::optimizer
