#include "model/simulate_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace plenum::model {
namespace {

// Regulator and line as one series when the group's actuators are the only ones that inflate.
std::optional<Series> BehindRegulator(const FlowElement& regulator, const GroupRig& group,
                                      double factor) {
  std::vector<FlowElement> elements = {regulator};
  elements[0].sonic_conductance_m3_per_s_pa /= group.count;
  elements.insert(elements.end(), group.fill.begin(), group.fill.end());
  const bool cracks = std::any_of(elements.begin(), elements.end(), [](const FlowElement& e) {
    return e.cracking_pressure_pa > 0.0;
  });
  if (group.fill.empty() || cracks || elements.size() > kMaxSeriesElements) return std::nullopt;
  return MakeSeries(elements, factor);
}

// A trial stage may leave the physical range; the step is then rejected for its error.
constexpr double kLowestPressurePa = 1e-3;

}  // namespace

System::System(const Rig& rig, double linear_ratio)
    : rig_(rig),
      groups_(rig.groups.size()),
      content_rate_(kReferencePressurePa * rig.ambient.temperature_k / kReferenceTemperatureK),
      regulated_(std::get_if<RegulatedSource>(&rig.source)),
      reservoir_(std::get_if<ReservoirSource>(&rig.source)),
      pump_limit_pa_(-std::numeric_limits<double>::infinity()),
      valve_(groups_, ValveFlow::kNone),
      flow_(groups_) {
  const double factor =
      FlowFactor(rig.gas) * std::sqrt(kReferenceTemperatureK / rig.ambient.temperature_k);
  for (const GroupRig& group : rig.groups) {
    fill_.emplace_back(group.fill, factor, linear_ratio);
    exhaust_.emplace_back(group.exhaust, factor, linear_ratio);
  }
  outlets_.reserve(groups_);
  if (regulated_) {
    supply_.pressure_pa = regulated_->pressure_pa;
    supply_.flow_max_m3_per_s = regulated_->flow_max_m3_per_s;
    if (regulated_->regulator) {
      supply_.regulator.emplace(std::span(&*regulated_->regulator, 1), factor, linear_ratio);
      for (const GroupRig& group : rig.groups) {
        with_regulator_.push_back(BehindRegulator(*regulated_->regulator, group, factor));
      }
    }
    node_at_supply_ = !supply_.regulator && std::isinf(supply_.flow_max_m3_per_s);
  }
  if (reservoir_ && !reservoir_->compressor.free_air_m3_per_s.empty()) {
    pump_limit_pa_ =
        std::min(reservoir_->stop_pressure_pa, HighestPressure(reservoir_->compressor));
    pump_ = PumpState::kRunning;
  }
}

std::vector<double> System::InitialState() const {
  std::vector<double> y(size(), 0.0);
  for (std::size_t i = 0; i < groups_; ++i) y[i] = rig_.groups[i].initial_pressure_pa;
  if (regulated_) y[source()] = regulated_->pressure_pa;
  if (reservoir_) y[source()] = reservoir_->initial_pressure_pa;
  return y;
}

// A pump's table as far as the limit; past the limit, where only trial stages go, it runs on
// without a kink. Error control and dense output would not notice one in the part that is cut off.
double System::AlongTable(const MonotoneCurve& table, double source_pa) const {
  const bool ends_before = table.back() < pump_limit_pa_;
  return table(std::clamp(source_pa, table.front(),
                          ends_before ? table.back() : std::numeric_limits<double>::infinity()));
}

double System::Delivery(double source_pa) const {
  return AlongTable(reservoir_->compressor.free_air_m3_per_s, source_pa) *
         reservoir_->compressor_count * reservoir_->duty;
}

double System::PumpPower(double source_pa) const {
  const CompressorCurve& curve = reservoir_->compressor;
  if (curve.current_a.empty()) return 0.0;
  return AlongTable(curve.current_a, source_pa) * curve.voltage_v * reservoir_->compressor_count;
}

bool System::source_may_rise(double source_pa) const {
  return pump_ == PumpState::kRunning && Delivery(source_pa) > 0.0;
}

double System::FinalPressure(std::size_t group, double source_pa) const {
  if (valve_[group] == ValveFlow::kOut) {
    return rig_.ambient.pressure_pa + exhaust_[group].cracking_pressure_pa();
  }
  const double regulator_pa = supply_.regulator ? supply_.regulator->cracking_pressure_pa() : 0.0;
  return source_pa - regulator_pa - fill_[group].cracking_pressure_pa();
}

// The flow of the only inflating group without solving for the node. False where regulator or line
// may be on its straight line near equal pressures, which a series of both does not know.
bool System::TakeFlowInSeries(std::size_t group, double pressure_pa) {
  const double count = rig_.groups[group].count;
  const double share_max = supply_.flow_max_m3_per_s / count;
  if (!supply_.regulator) {
    flow_[group] = std::min(share_max, fill_[group].Flow(supply_.pressure_pa, pressure_pa));
    return true;
  }
  if (!with_regulator_[group]) return false;
  const double flow = FlowAtRatio(*with_regulator_[group], pressure_pa / supply_.pressure_pa);
  if (flow < fill_[group].linear_flow_m3_per_s_pa() ||
      flow < supply_.regulator->linear_flow_m3_per_s_pa() / count) {
    return false;
  }
  flow_[group] = std::min(share_max, flow * supply_.pressure_pa);
  return true;
}

void System::UpdateFlows(std::span<const double> y) {
  const auto pressure = [&](std::size_t i) { return std::max(y[i], kLowestPressurePa); };
  outlets_.clear();
  for (std::size_t i = 0; i < groups_; ++i) {
    flow_[i] = 0.0;
    if (valve_[i] == ValveFlow::kIn) {
      outlets_.push_back({&fill_[i], static_cast<double>(rig_.groups[i].count), pressure(i), i});
    } else if (valve_[i] == ValveFlow::kOut) {
      flow_[i] = exhaust_[i].Flow(pressure(i), rig_.ambient.pressure_pa);
    }
  }
  if (outlets_.empty()) return;
  double node_pa = y[source()];
  if (!node_at_supply_) {
    const NodeOutlet& first = outlets_[0];
    if (outlets_.size() == 1 && TakeFlowInSeries(first.group, first.pressure_pa)) return;
    node_pa = NodePressure(supply_, outlets_);
  }
  for (const NodeOutlet& outlet : outlets_) {
    flow_[outlet.group] = outlet.line->Flow(node_pa, outlet.pressure_pa);
  }
}

double System::Draw(std::span<const double> y) {
  UpdateFlows(y);
  double draw = 0.0;
  for (std::size_t i = 0; i < groups_; ++i) {
    if (valve_[i] == ValveFlow::kIn) draw += rig_.groups[i].count * flow_[i];
  }
  return draw;
}

void System::operator()(double, std::span<const double> y, std::span<double> dydt) {
  const double draw = Draw(y);
  for (std::size_t i = 0; i < groups_; ++i) {
    const double inflow = valve_[i] == ValveFlow::kOut ? -flow_[i] : flow_[i];
    const double slope = ContentSlope(rig_.groups[i].chamber, std::max(y[i], kLowestPressurePa));
    dydt[i] = content_rate_ * inflow / slope;
    dydt[crossed(i)] = rig_.groups[i].count * flow_[i];
  }
  dydt[source()] = dydt[pump_on()] = dydt[pump_air()] = dydt[pump_energy()] = 0.0;
  if (!reservoir_) return;
  if (pump_ == PumpState::kRunning || pump_ == PumpState::kHolding) {
    const double delivery = Delivery(y[source()]);
    double share = 1.0;
    if (pump_ == PumpState::kHolding) share = draw > 0.0 ? std::min(1.0, draw / delivery) : 0.0;
    dydt[pump_on()] = share * reservoir_->duty;
    dydt[pump_air()] = pump_ == PumpState::kHolding ? draw : delivery;
    dydt[pump_energy()] = dydt[pump_on()] * PumpPower(y[source()]);
  }
  if (pump_ == PumpState::kHolding) return;
  const double net = dydt[pump_air()] - draw;
  const double volume = net > 0.0 && reservoir_->volume_rising_m3 > 0.0
                            ? reservoir_->volume_rising_m3
                            : reservoir_->volume_m3;
  dydt[source()] = content_rate_ * net / volume;
}

}  // namespace plenum::model
