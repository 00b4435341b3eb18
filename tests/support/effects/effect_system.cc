#include "tests/support/effects/effect_system.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace plenum::test {
namespace {

constexpr double kHeatRatio = 1.4;
constexpr double kCv = kGasConstant / (kHeatRatio - 1.0);
constexpr double kCp = kHeatRatio * kCv;
constexpr double kViscosity = 1.81e-5;  // Pa·s
constexpr double kReferencePa = 1e5;    // P0

double Density(double temperature_k) {
  return kReferenceDensity * std::sqrt(kReferenceK / temperature_k);
}

// Takes away what a blocked actuator does not have.
EffectRig Effective(EffectRig rig) {
  if (rig.blocked) {
    rig.expansion_ratio = 1.0;
    rig.inertia.reset();
    rig.creep.reset();
    rig.hysteresis_half_width_pa.reset();
    rig.compliance.reset();
    rig.unlisted.softening.reset();
    rig.unlisted.snap_through.reset();
    rig.unlisted.kinking_line.reset();
  }
  if (rig.hysteresis_half_width_pa == 0.0) rig.hysteresis_half_width_pa.reset();
  return rig;
}

}  // namespace

EffectSystem::EffectSystem(const EffectRig& declared)
    : rig_(Effective(declared)),
      law_(rig_),
      guess_pa_(rig_.initial_pa),
      per_mass_(kGasConstant * rig_.ambient_k) {
  if (rig_.heat_time_constant_s) {
    const double operating_m3 = declared.rest_volume_m3 * declared.expansion_ratio;
    wall_w_per_k_ =
        kCv * rig_.operating_pa * operating_m3 / (per_mass_ * *rig_.heat_time_constant_s);
  }
  if (rig_.line) {
    bore_m2_ = std::numbers::pi * rig_.line->inner_diameter_m * rig_.line->inner_diameter_m / 4.0;
  }
}

EffectState EffectSystem::Start() {
  EffectState y{};
  y[kVolume] = law_.Volume(rig_.initial_pa);
  y[kSensor] = rig_.initial_pa;
  const double temperature_k =
      rig_.heat_time_constant_s ? rig_.initial_k.value_or(rig_.ambient_k) : rig_.ambient_k;
  y[kMass] = rig_.initial_pa * (y[kVolume] + rig_.dead_volume_m3) / (kGasConstant * temperature_k);
  if (rig_.supply_droop) y[kDroop] = rig_.source_pa * rig_.supply_droop->volume_m3 / per_mass_;
  if (const auto& second = rig_.unlisted.second_chamber) {
    y[kSecond] = rig_.initial_pa * second->volume_m3 / per_mass_;
  }
  if (rig_.line) y[kNode] = rig_.initial_pa * TubeVolume() / per_mass_;
  start_energy_j_ = kCv * y[kMass] * temperature_k;
  return y;
}

ChamberGas EffectSystem::Gas(const EffectState& y) const {
  const bool heat = rig_.heat_time_constant_s.has_value();
  const double energy_per_pv = heat ? 1.0 / (kHeatRatio - 1.0) : 1.0;
  const double content =
      heat ? start_energy_j_ + y[kIn] - y[kOut] + y[kHeat] - y[kWork] : y[kMass] * per_mass_;
  ChamberGas gas{};
  if (rig_.inertia) {
    gas.volume_m3 = y[kVolume] + rig_.dead_volume_m3;
    gas.pressure_pa = content / (energy_per_pv * gas.volume_m3);
  } else {
    const double extra_m3 = y[kCreep] + rig_.dead_volume_m3;
    gas.pressure_pa = law_.Pressure(content, extra_m3, energy_per_pv, heat, guess_pa_);
    gas.volume_m3 = law_.Volume(gas.pressure_pa) + extra_m3;
  }
  gas.temperature_k =
      heat ? gas.pressure_pa * gas.volume_m3 / (y[kMass] * kGasConstant) : rig_.ambient_k;
  return gas;
}

double EffectSystem::SourcePressure(double t_s, const EffectState& y) const {
  if (rig_.source != EffectRig::Source::kReservoir) {
    return rig_.source_course ? rig_.source_course(t_s) : rig_.source_pa;
  }
  return rig_.source_pa + (y[kDelivered] - y[kSource]) * per_mass_ / rig_.reservoir_m3;
}

double EffectSystem::SupplyPressure(double t_s, const EffectState& y) const {
  return rig_.supply_droop ? y[kDroop] * per_mass_ / rig_.supply_droop->volume_m3
                           : SourcePressure(t_s, y);
}

// kg/s
double EffectSystem::Delivery(double reservoir_pa) const {
  const auto& table = rig_.delivery;
  if (table.empty() || reservoir_pa > table.back().first) return 0.0;
  if (reservoir_pa <= table.front().first) return kReferenceDensity * table.front().second;
  std::size_t i = 1;
  while (table[i].first < reservoir_pa) ++i;
  const double share = (reservoir_pa - table[i - 1].first) / (table[i].first - table[i - 1].first);
  return kReferenceDensity * std::lerp(table[i - 1].second, table[i].second, share);
}

double EffectSystem::NodePressure(const EffectState& y) const {
  return rig_.line ? y[kNode] * per_mass_ / TubeVolume() : Gas(y).pressure_pa;
}

double EffectSystem::Work(const EffectState& y) const {
  return y[kWork] + (rig_.inertia ? 0.0 : law_.Work(Gas(y).pressure_pa));
}

double EffectSystem::Energy(const EffectState& y) const {
  return kCv * y[kMass] * Gas(y).temperature_k;
}

double EffectSystem::LineFlow(const std::vector<MassElement>& line, double opening,
                              double upstream_pa, double downstream_pa, double temperature_k,
                              const std::optional<ExhaustRestriction>& after) const {
  if (opening <= 0.0 || line.empty()) return 0.0;
  std::vector<MassElement> chain = line;
  for (MassElement& e : chain) e.conductance *= opening;
  if (after) chain.push_back({after->conductance, after->critical_ratio});
  return ChainFlow(chain, upstream_pa - rig_.cracking_pa, downstream_pa, Density(temperature_k),
                   rig_.linear_ratio);
}

double EffectSystem::LeakFlow(const ChamberGas& gas) const {
  const double p = gas.pressure_pa, p_a = rig_.ambient_pa;
  if (!rig_.leak) return 0.0;
  const double squares = p * p - p_a * p_a;
  if (const auto* orifice = std::get_if<OrificeLeak>(&*rig_.leak)) {
    const std::vector<MassElement> hole{{orifice->conductance, orifice->critical_ratio}};
    return p >= p_a ? ChainFlow(hole, p, p_a, Density(gas.temperature_k), rig_.linear_ratio)
                    : -ChainFlow(hole, p_a, p, Density(rig_.ambient_k), rig_.linear_ratio);
  }
  if (const auto* laminar = std::get_if<LaminarLeak>(&*rig_.leak)) {
    return kReferenceDensity * laminar->conductance * squares / (2.0 * kReferencePa);
  }
  const auto& porous = std::get<PorousLeak>(*rig_.leak);
  const double a = porous.viscous_pa2_s_per_kg, c = porous.inertial_pa2_s2_per_kg2;
  return 2.0 * squares / (a + std::sqrt(a * a + 4.0 * c * std::abs(squares)));
}

double EffectSystem::SeamFlow(const ChamberGas& gas) const {
  if (!rig_.unlisted.gaping_seam) return 0.0;
  const GapingSeam& seam = *rig_.unlisted.gaping_seam;
  const double open = OpenShare(seam, gas.pressure_pa);
  return ChainFlow({{open * seam.conductance, seam.critical_ratio}}, gas.pressure_pa,
                   rig_.ambient_pa, Density(gas.temperature_k), rig_.linear_ratio);
}

double EffectSystem::KinkOfLine(double volume_m3) const {
  if (!rig_.unlisted.kinking_line) return 1.0;
  const double expansion_m3 = rig_.rest_volume_m3 * (rig_.expansion_ratio - 1.0);
  return KinkFactor(*rig_.unlisted.kinking_line,
                    (volume_m3 - rig_.dead_volume_m3 - rig_.rest_volume_m3) / expansion_m3);
}

double EffectSystem::FlowToSecond(const EffectState& y, double pressure_pa) const {
  if (!rig_.unlisted.second_chamber) return 0.0;
  const SecondChamber& second = *rig_.unlisted.second_chamber;
  const std::vector<MassElement> hole{{second.conductance, second.critical_ratio}};
  const double behind_pa = y[kSecond] * per_mass_ / second.volume_m3;
  const double density = Density(rig_.ambient_k);
  return ChainFlow(hole, pressure_pa, behind_pa, density, rig_.linear_ratio) -
         ChainFlow(hole, behind_pa, pressure_pa, density, rig_.linear_ratio);
}

double EffectSystem::ColumnRate(double flow, double node_pa, double pressure_pa) const {
  const double d = rig_.line->inner_diameter_m;
  const double density = 0.5 * (node_pa + pressure_pa) / per_mass_;
  return bore_m2_ / (kReferenceDensity * rig_.line->length_m) * (node_pa - pressure_pa) -
         32.0 * kViscosity / (d * d * density) * flow;
}

void EffectSystem::MoveWall(const EffectState& y, double pressure_pa, EffectState& slope) const {
  const double quasi_static_m3 = law_.Volume(pressure_pa);
  if (const auto& creep = rig_.creep) {
    slope[kCreep] = (creep->fraction * (quasi_static_m3 - rig_.rest_volume_m3) - y[kCreep]) /
                    creep->time_constant_s;
    slope[kWork] = pressure_pa * slope[kCreep];
  }
  if (const auto& inertia = rig_.inertia) {
    const double w = inertia->natural_frequency_rad_per_s;
    slope[kVolume] = y[kVelocity];
    slope[kVelocity] = -2.0 * inertia->damping_ratio * w * y[kVelocity] -
                       w * w * (y[kVolume] - quasi_static_m3 - y[kCreep]);
    slope[kWork] = pressure_pa * y[kVelocity];
  }
}

EffectState EffectSystem::Slope(double t_s, const EffectState& y, double fill_opening,
                                double exhaust_opening) const {
  const ChamberGas gas = Gas(y);
  const double p = gas.pressure_pa;
  const double end_pa = rig_.line ? NodePressure(y) : p;
  const double end_k = rig_.line ? rig_.ambient_k : gas.temperature_k;
  const double kink = KinkOfLine(gas.volume_m3);
  EffectState slope{};

  double fill = 0.0;
  if (rig_.source != EffectRig::Source::kNone) {
    const double supply_pa = SupplyPressure(t_s, y);
    fill = LineFlow(rig_.fill, rig_.fill_factor * kink * fill_opening, supply_pa, end_pa,
                    rig_.ambient_k, std::nullopt);
    slope[kSource] = fill;
    if (const auto& droop = rig_.supply_droop) {
      slope[kSource] =
          ChainFlow({{droop->conductance, droop->critical_ratio}}, SourcePressure(t_s, y),
                    supply_pa, Density(rig_.ambient_k), rig_.linear_ratio);
      slope[kDroop] = slope[kSource] - fill;
    }
    slope[kDelivered] = Delivery(SourcePressure(t_s, y));
  }
  const double exhaust = LineFlow(rig_.exhaust, kink * exhaust_opening, end_pa, rig_.ambient_pa,
                                  end_k, rig_.exhaust_restriction);
  slope[kExhaust] = exhaust;

  double in = fill, out = exhaust;
  if (rig_.line) {
    slope[kColumn] = ColumnRate(y[kColumn], end_pa, p);
    const double column = kReferenceDensity * y[kColumn];
    slope[kNode] = fill - exhaust - column;
    in = std::max(column, 0.0);
    out = std::max(-column, 0.0);
  }
  slope[kLeak] = LeakFlow(gas) + SeamFlow(gas);
  in += std::max(-slope[kLeak], 0.0);
  out += std::max(slope[kLeak], 0.0);

  slope[kSecond] = FlowToSecond(y, p);

  slope[kMass] = in - out - slope[kSecond];
  slope[kIn] = kCp * rig_.ambient_k * in;
  slope[kOut] = kCp * gas.temperature_k * out;
  slope[kHeat] = wall_w_per_k_ * (rig_.ambient_k - gas.temperature_k);
  MoveWall(y, p, slope);
  if (rig_.sensor_lag_s > 0.0) slope[kSensor] = (p - y[kSensor]) / rig_.sensor_lag_s;
  return slope;
}

}  // namespace plenum::test
