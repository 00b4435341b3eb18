#include "model/simulate/simulate_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "model/effects/registry.h"
#include "model/integrate/pressure_at.h"
#include "model/simulate/dense_balance.h"
#include "model/simulate/inlet_pressure.h"

namespace plenum::model {
namespace {

// A trial stage may leave the physical range; the step is then rejected for its error.
constexpr double kLowestPressurePa = 1e-3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// By how much more the states of what may ring too fast to move the pressures may be off. So the
// pressures of short lines come out as exactly as those of long ones, whose steps they hold down
// themselves; with 100 a line of 0.05 m takes four times the steps. An inlet sensor sees such
// states: a tenth of the room keeps a line of 0.1 m within 0.1 % RMS there at a tolerance of 1e-6.
constexpr double kHiddenRoom = 1e3, kInletRoom = 1e2;

// Or the end of the pump's table, where that is lower.
template <class T>
T StopPressure(const ReservoirSource& source, const Lift& lift) {
  const double highest_pa = HighestPressure(source.compressor);
  return source.stop_pressure_pa < highest_pa ? lift.operator()<T>(source.stop_pressure_pa)
                                              : T(highest_pa);
}

}  // namespace

template <class T>
System<T>::System(const Rig& rig, const LineOptions& lines, const Lift& lift, bool account)
    : rig_(rig),
      ambient_pa_(lift.operator()<T>(rig.ambient.pressure_pa)),
      ambient_k_(lift.operator()<T>(rig.ambient.temperature_k)),
      regulated_(std::get_if<RegulatedSource>(&rig.source)),
      reservoir_(std::get_if<ReservoirSource>(&rig.source)),
      driven_(std::get_if<DrivenSource>(&rig.source)),
      line_options_{lines.linear_ratio, MirrorPa(rig.groups.front().chamber), lines.tolerance},
      account_(account) {
  using std::sqrt;
  content_rate_ = kReferencePressurePa * ambient_k_ / kReferenceTemperatureK;
  const T factor = FlowFactor(rig.gas) * sqrt(kReferenceTemperatureK / ambient_k_);
  source_initial_pa_ = ambient_pa_;
  if (regulated_) {
    source_initial_pa_ = regulated_pa_ = lift.operator()<T>(regulated_->pressure_pa);
    supply_.pressure_pa = regulated_pa_;
    supply_.flow_max_m3_per_s = regulated_->flow_max_m3_per_s;
    if (regulated_->regulator)
      supply_.regulator.emplace(Lifted<T>({&*regulated_->regulator, 1}, factor, lift),
                                line_options_);
    node_at_supply_ = !supply_.regulator && std::isinf(supply_.flow_max_m3_per_s);
  }
  if (const auto* pumps = std::get_if<PumpSource>(&rig.source)) {
    supply_.pump = &pumps->compressor;
    supply_.pumps = pumps->compressor_count;
    supply_.duty = duty_ = lift.operator()<T>(pumps->duty);
    supply_.node_pa = ambient_pa_;
    supply_.pressure_pa = T(HighestPressure(pumps->compressor));
    pump_table_ = PumpTable<T>(supply_.pressure_pa);
    node_at_supply_ = false;
  }
  if (driven_) {
    driven_factor_ = lift.operator()<T>(driven_->factor);
    source_initial_pa_ = SourcePressure(T(0.0), {});
  }
  if (reservoir_) {
    source_initial_pa_ = lift.operator()<T>(reservoir_->initial_pressure_pa);
    reservoir_volume_m3_ = lift.operator()<T>(reservoir_->volume_m3);
    reservoir_rising_m3_ = reservoir_->volume_rising_m3 > 0.0
                               ? lift.operator()<T>(reservoir_->volume_rising_m3)
                               : reservoir_volume_m3_;
    duty_ = lift.operator()<T>(reservoir_->duty);
    if (!reservoir_->compressor.free_air_m3_per_s.empty()) {
      pump_table_ = PumpTable<T>(reservoir_->compressor.free_air_m3_per_s,
                                 StopPressure<T>(*reservoir_, lift), lift);
      pump_ = PumpState::kRunning;
    }
  }
  groups_.reserve(rig.groups.size());
  for (const GroupRig& group : rig.groups) {
    groups_.push_back(MakeGroup(group, lift, factor));
    exhaust_pa_.push_back(lift.operator()<T>(ExhaustOf(rig, group)));
    for (const auto& unit : groups_.back().units)
      if (!source_unit_ && unit->acts_on_source()) source_unit_ = unit.get();
  }
  passages_ = {rig.links, factor, line_options_, lift};
  LayOut();
}

template <class T>
typename System<T>::Group System<T>::MakeGroup(const GroupRig& rig, const Lift& lift,
                                               const T& factor) const {
  Group group;
  group.count = rig.count;
  GroupSetup<T>& setup = group.setup;
  setup.ambient_pressure_pa = ambient_pa_;
  setup.ambient_temperature_k = ambient_k_;
  setup.rest_volume_m3 = lift.operator()<T>(rig.chamber.rest_volume_m3);
  setup.expansion_ratio = lift.operator()<T>(rig.chamber.expansion_ratio);
  setup.operating_pressure_pa = lift.operator()<T>(rig.chamber.operating_pressure_pa);
  setup.dead_volume_m3 = lift.operator()<T>(rig.chamber.dead_volume_m3);
  if (!rig.chamber.volume_curve.empty()) setup.volume_curve = &rig.chamber.volume_curve;
  setup.blocked = rig.blocked;
  setup.initial_pressure_pa = lift.operator()<T>(rig.initial_pressure_pa);
  setup.initial_temperature_k =
      rig.initial_temperature_k > 0.0 ? lift.operator()<T>(rig.initial_temperature_k) : ambient_k_;
  setup.source_pressure_pa = source_initial_pa_;
  setup.flow_factor = factor;
  setup.heat_capacity_ratio = HeatCapacityRatio(rig_.gas);
  setup.dense = dense_ ? &*dense_ : nullptr;
  setup.reference_density_kg_per_m3 = ReferenceDensity(rig_.gas);
  setup.viscosity_pa_s = ViscosityPaS(rig_.gas);
  setup.fill = Lifted<T>(rig.fill, factor, lift);
  setup.exhaust = Lifted<T>(rig.exhaust, factor, lift);
  group.units = MakeUnits<T>(rig.effects, lift);
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    const bool fed = !setup.feed.empty();
    group.units[u]->Prepare(setup);
    if (!fed && !setup.feed.empty()) group.feeding_unit = u;
    if (group.units[u]->states() > 0) group.settles = false;
  }
  group.filling.ramp_s = group.venting.ramp_s = setup.valve_ramp_s;
  for (const Effect& effect : rig.effects) {
    group.measured = group.measured || effect.spec->place == EffectPlace::kSensor;
    group.heated = group.heated || effect.spec->place == EffectPlace::kEnergy;
    if (effect.spec->place == EffectPlace::kChamber) group.settles = false;
  }
  if (supply_.regulator && setup.feed.empty() && !setup.fill.empty() &&
      setup.fill.size() < kMaxSeriesElements) {
    std::vector<LineElement<T>> both =
        Lifted<T>({&*regulated_->regulator, 1}, factor / group.count, lift);
    both.insert(both.end(), setup.fill.begin(), setup.fill.end());
    const bool cracks = std::any_of(both.begin(), both.end(), [](const LineElement<T>& e) {
      return e.cracking_pressure_pa > 0.0;
    });
    if (!cracks) group.with_regulator.emplace(both, line_options_);
  }

  group.valve[kFill].count = group.valve[kExhaust].count = rig.inlet_after;
  if (!rig.exhaust.empty()) group.valve[kExhaust].first = rig.exhaust.size() - rig.inlet_after;
  group.told = {rig.told, setup.valve_delay_s};
  if (group.told.stretches() || !rig_.links.empty()) group.settles = false;
  group.lines = {Line<T>(setup.fill, line_options_), Line<T>(setup.exhaust, line_options_),
                 Line<T>(setup.feed, line_options_)};
  return group;
}

// Places of all states, and their sizes for error control.
template <class T>
void System<T>::LayOut() {
  sizes_.clear();
  room_.clear();
  for (Group& group : groups_) {
    group.at = sizes_.size();
    sizes_.push_back(0.0);
    for (const auto& unit : group.units) {
      has_modes_ = has_modes_ || unit->guards() > 0;
      group.unit_at.push_back(sizes_.size());
      room_.resize(sizes_.size(), 1.0);
      sizes_.resize(sizes_.size() + static_cast<std::size_t>(unit->states()), 0.0);
      const double hidden = group.valve[kFill].count > 0 ? kInletRoom : kHiddenRoom;
      room_.resize(sizes_.size(), unit->hidden_states() ? hidden : 1.0);
    }
  }
  source_ = sizes_.size();
  if (reservoir_) sizes_.push_back(0.0);
  dynamic_size_ = sizes_.size();
  for (Group& group : groups_) {
    if (!account_) break;
    group.accounts = sizes_.size();
    const double energy_j =
        group.count * ValueOf(group.setup.operating_pressure_pa * group.setup.OperatingVolume());
    sizes_.resize(sizes_.size() + 4, energy_j / kReferencePressurePa);
    if (group.heated) sizes_.resize(sizes_.size() + 4, energy_j);
  }
  pump_accounts_ = sizes_.size();
  if (account_) sizes_.resize(sizes_.size() + 3, kInfinity);
  outlets_.reserve(groups_.size());
  scratch_.resize(sizes_.size());
  room_.resize(sizes_.size(), 1.0);
}

template <class T>
std::vector<T> System<T>::InitialState() {
  std::vector<T> y(size(), T(0.0));
  if (reservoir_) y[source_] = source_initial_pa_;
  for (Group& group : groups_) {
    const GroupSetup<T>& setup = group.setup;
    y[group.at] = setup.initial_pressure_pa;
    Moment<T> m;
    m.pressure_pa = m.volume_pressure_pa = setup.initial_pressure_pa;
    m.quasi_static_volume_m3 = setup.QuasiStaticVolume(m.pressure_pa);
    m.volume_m3 = setup.dead_volume_m3 +
                  (group.told.stretches() ? group.told.Volume(T(0.0)) : m.quasi_static_volume_m3);
    for (std::size_t u = 0; u < group.units.size(); ++u) {
      const std::size_t at = group.unit_at[u];
      group.units[u]->Start(setup, m, y.data() + at, sizes_.data() + at);
    }
  }
  return y;
}

template <class T>
T System<T>::SourcePressure(const T& t, std::span<const T> y) const {
  T pressure_pa = DeclaredSource(t, y);
  if (source_unit_) source_unit_->Source(t, pressure_pa);
  return pressure_pa;
}

template <class T>
T System<T>::DeclaredSource(const T& t, std::span<const T> y) const {
  if (regulated_) return regulated_pa_;
  if (supply_.pump) return supply_.node_pa;
  if (driven_) {
    const CoursePoint at =
        PointOfCourse(driven_->time_s, driven_->pressure_pa, ValueOf(t), record_near_);
    return ambient_pa_ + driven_factor_ * (Chain(t, at.value, at.slope_per_s) - ambient_pa_);
  }
  return reservoir_ ? y[source_] : T(0.0);
}

template <class T>
std::optional<std::size_t> System<T>::HeadState(std::size_t i) const {
  const Group& group = groups_[i];
  return group.lines[kFeed].empty() ? source_state()
                                    : std::optional(group.unit_at[group.feeding_unit]);
}

template <class T>
T System<T>::HeadPressure(std::size_t i, const T& t, std::span<const T> y) const {
  const Group& group = groups_[i];
  return group.lines[kFeed].empty() ? SourcePressure(t, y) : y[group.unit_at[group.feeding_unit]];
}

template <class T>
bool System<T>::Passing(std::size_t i, double time_s) const {
  const Group& group = groups_[i];
  return !group.settled && !(group.filling.Closed(time_s) && group.venting.Closed(time_s));
}

template <class T>
bool System<T>::Fed(std::size_t i, double time_s) const {
  return !groups_[i].lines[kFeed].empty() || !groups_[i].filling.Closed(time_s);
}

template <class T>
bool System<T>::Moving(std::size_t i, double time_s) const {
  const Group& group = groups_[i];
  const bool open = !(group.filling.Closed(time_s) && group.venting.Closed(time_s));
  return ValueOf(group.filling.EndTime()) > time_s || ValueOf(group.venting.EndTime()) > time_s ||
         (open && group.told.Turning(time_s));
}

template <class T>
T System<T>::Delivery(const T& source_pa) const {
  return pump_table_.Delivery(reservoir_->compressor.free_air_m3_per_s, source_pa) *
         static_cast<double>(reservoir_->compressor_count) * duty_;
}

template <class T>
T System<T>::PumpPower(const T& source_pa) const {
  const CompressorCurve& curve = reservoir_ ? reservoir_->compressor : *supply_.pump;
  if (curve.current_a.empty()) return T(0.0);
  const double pumps = reservoir_ ? reservoir_->compressor_count : supply_.pumps;
  return pump_table_.Along(curve.current_a, source_pa) * (curve.voltage_v * pumps);
}

template <class T>
bool System<T>::source_may_rise(double source_pa) const {
  return driven_ || (pump_ == PumpState::kRunning && Delivery(T(source_pa)) > 0.0);
}

template <class T>
T System<T>::FinalPressure(std::size_t i, const T& source_pa) const {
  const Group& group = groups_[i];
  if (group.venting.end > 0.0) return exhaust_pa_[i] + group.lines[kExhaust].cracking_pressure_pa();
  const T& highest_pa = supply_.pump ? supply_.pressure_pa : source_pa;
  const T behind_pa = highest_pa - group.lines[kFill].cracking_pressure_pa();
  return supply_.regulator ? T(behind_pa - supply_.regulator->cracking_pressure_pa()) : behind_pa;
}

// Volume law and the effects on it. What is told of a volume stands against effects on the law.
template <class T>
void System<T>::FillMoment(Group& group, const T& t, const T& source_pa,
                           std::span<const T> y) const {
  const GroupSetup<T>& setup = group.setup;
  Moment<T>& m = *::new (&group.moment) Moment<T>;  // without (), which would set zeros twice
  m.pressure_pa = y[group.at] > kLowestPressurePa ? y[group.at] : T(kLowestPressurePa);
  m.volume_pressure_pa = m.tail_pa = m.pressure_pa;
  m.head_pa = source_pa;
  m.temperature_k = m.tail_temperature_k = setup.ambient_temperature_k;
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    group.units[u]->BeforeVolume(setup, y.data() + group.unit_at[u], m);
  }
  m.quasi_static_volume_m3 = setup.QuasiStaticVolume(m.volume_pressure_pa);
  m.volume_m3 = m.quasi_static_volume_m3 + setup.dead_volume_m3;
  if (group.told.stretches()) {
    m.volume_m3 = group.told.Volume(t) + setup.dead_volume_m3;
    m.volume_rate_m3_per_s = T(group.told.volume_rate_m3_per_s());
  }
  if (m.volume_follows) m.volume_slope_m3_per_pa = setup.QuasiStaticSlope(m.volume_pressure_pa);
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    group.units[u]->AfterVolume(setup, y.data() + group.unit_at[u], m);
  }
  if (setup.dense && !group.heated)
    m.content_m3 = setup.Content(m.pressure_pa, m.volume_m3, m.temperature_k);
}

// The flow of the only open inlet without solving for the node. False where regulator or line may
// be on its straight line near equal pressures, which a series of both does not know.
template <class T>
bool System<T>::TakeFlowInSeries(const NodeOutlet<T>& outlet, T& flow) const {
  if (supply_.pump) return !account_ && !dense_ && TakeGivenFlow(supply_, outlet, flow);
  const Group& group = groups_[outlet.group];
  const T share_max = T(supply_.flow_max_m3_per_s) / outlet.copies;
  flow = share_max;
  if (!supply_.regulator) {
    const T free = outlet.line->Flow(supply_.pressure_pa, outlet.pressure_pa);
    if (free < flow) flow = free;
    return true;
  }
  const bool whole = outlet.line == &group.lines[kFill] && outlet.copies == group.count;
  if (!group.with_regulator || !whole) return false;
  const double ratio = ValueOf(outlet.pressure_pa) / ValueOf(supply_.pressure_pa);
  if (ratio >= group.with_regulator->kinks()[1]) return false;
  const T both = group.with_regulator->Flow(supply_.pressure_pa, outlet.pressure_pa);
  const double per_pressure = ValueOf(both) / ValueOf(supply_.pressure_pa);
  if (per_pressure < group.lines[kFill].linear_flow_m3_per_s_pa() ||
      per_pressure < supply_.regulator->linear_flow_m3_per_s_pa() / group.count) {
    return false;
  }
  if (both < flow) flow = both;
  return true;
}

// The way into the actuator (kFill) or out of it (kExhaust) as far as it is open.
template <class T>
OpenWay<T> System<T>::WayOf(Group& group, std::size_t line, const T& t) const {
  const bool in = line == kFill;
  const T open = (in ? group.filling : group.venting).At(t);
  OpenWay<T> way = {&group.lines[line], group.settled ? T(0.0) : T(group.moment.line_factor * open),
                    group.regime[line].below};
  group.told.Throttle(t, line, in ? group.setup.fill : group.setup.exhaust, group.valve[line],
                      line_options_, way);
  return way;
}

// Flows of all groups; fills their moments.
template <class T>
void System<T>::UpdateFlows(const T& t, std::span<const T> y) {
  using std::sqrt;
  outlets_.clear();
  const T source_pa = SourcePressure(t, y);
  if (regulated_ && source_unit_) supply_.pressure_pa = source_pa;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& group = groups_[i];
    FillMoment(group, t, source_pa, y);
    Moment<T>& m = group.moment;
    const OpenWay<T> filling = WayOf(group, kFill, t), venting = WayOf(group, kExhaust, t);
    if (venting.share > 0.0) {
      const T& to_pa = exhaust_pa_[i];
      m.line_out_m3_per_s = IsZero(T(venting.share - 1.0))
                                ? venting.line->Flow(m.tail_pa, to_pa, venting.regime)
                                : venting.line->ThrottledFlow(
                                      venting.share, group.setup.exhaust_fixed, m.tail_pa, to_pa);
      if (group.heated) m.line_out_m3_per_s *= sqrt(ambient_k_ / m.tail_temperature_k);
      if (dense_)
        m.line_out_m3_per_s *= Thinness(group.setup.dense, m.tail_pa, m.tail_temperature_k);
    }
    if (!group.lines[kFeed].empty()) {
      outlets_.push_back(
          {&group.lines[kFeed], T(group.count), m.head_pa, i, group.regime[kFeed].below});
      if (filling.share > 0.0) {
        m.line_in_m3_per_s =
            filling.share * filling.line->Flow(m.head_pa, m.tail_pa, filling.regime);
        if (dense_) m.line_in_m3_per_s *= Thinness(group.setup.dense, m.head_pa, ambient_k_);
      }
    } else if (filling.share > 0.0) {
      outlets_.push_back({filling.line, group.count * filling.share, m.tail_pa, i, filling.regime});
    }
  }
  if (outlets_.empty()) {
    supply_.node_pa = ambient_pa_;  // pumps are off
    return;
  }
  T node_pa = source_pa;
  T in_series;
  bool solved = false;
  if (!node_at_supply_) {
    solved = outlets_.size() == 1 && TakeFlowInSeries(outlets_[0], in_series);
    if (!solved) supply_.node_pa = node_pa = NodePressure<T>(supply_, outlets_);
  }
  const T thinness = dense_ ? Thinness(&*dense_, source_pa, ambient_k_) : T(1.0);
  for (const NodeOutlet<T>& outlet : outlets_) {
    Group& group = groups_[outlet.group];
    T flow = solved ? in_series
                    : outlet.line->Flow(node_pa, outlet.pressure_pa,
                                        node_at_supply_ ? outlet.regime : Line<T>::kUnknown);
    if (dense_) flow *= thinness;
    group.moment.draw_m3_per_s = outlet.copies / group.count * flow;
    if (group.lines[kFeed].empty()) {
      group.moment.line_in_m3_per_s = group.moment.draw_m3_per_s;
      group.moment.head_pa = node_pa;
    }
  }
}

template <class T>
T System<T>::Draw(const T& t, std::span<const T> y) {
  UpdateFlows(t, y);
  T draw(0.0);
  for (const Group& group : groups_) draw += group.count * group.moment.draw_m3_per_s;
  return draw;
}

// Pressure and effect states of a group, and its accounts.
template <class T>
void System<T>::Balance(Group& group, std::span<const T> y, std::span<T> dydt) const {
  const GroupSetup<T>& setup = group.setup;
  Moment<T>& m = group.moment;
  m.in_m3_per_s = m.line_in_m3_per_s;
  m.out_m3_per_s = m.line_out_m3_per_s;
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    group.units[u]->AfterFlow(setup, y.data() + group.unit_at[u], m);
  }
  const T heat_in = kContentPerKelvin * ambient_k_ * m.in_m3_per_s + m.passed.heat_w;
  m.in_m3_per_s += m.passed.in_m3_per_s;
  m.out_m3_per_s += m.passed.out_m3_per_s;
  const double kappa = m.heat_capacity_ratio;
  // Of evacuated actuators the lack of gas, below 0.
  const T gas_pa = m.pressure_pa - line_options_.mirror_pa;
  const T capacity = m.volume_m3 + kappa * gas_pa * m.volume_slope_m3_per_pa;
  const T heat_out = kContentPerKelvin * m.temperature_k * m.out_m3_per_s;
  const T push = kappa * (heat_in - heat_out - gas_pa * m.volume_rate_m3_per_s) +
                 (kappa - 1.0) * m.wall_heat_w;
  const bool possible = capacity > 0.0 && m.volume_m3 > 0.0;
  m.pressure_rate_pa_per_s = !possible     ? T(std::numeric_limits<double>::quiet_NaN())
                             : setup.dense ? DenseVolume<T>(setup, m).PressureRate()
                                           : T(push / capacity);
  dydt[group.at] = m.pressure_rate_pa_per_s;
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    group.units[u]->Rates(setup, m, y.data() + group.unit_at[u], dydt.data() + group.unit_at[u]);
  }
  if (!account_) return;
  T* account = dydt.data() + group.accounts;
  account[kDrawn] = group.count * m.draw_m3_per_s;
  account[kIn] = group.count * m.line_in_m3_per_s;
  account[kOut] = group.count * m.line_out_m3_per_s;
  account[kLeaked] = group.count * m.leak_m3_per_s;
  if (!group.heated) return;
  account[kEnthalpyIn] = group.count * kappa / (kappa - 1.0) * heat_in;
  account[kEnthalpyOut] = group.count * kappa / (kappa - 1.0) * heat_out;
  if (setup.dense)
    DenseVolume<T>(setup, m).Enthalpies(group.count, account[kEnthalpyIn], account[kEnthalpyOut]);
  account[kWallHeat] = group.count * m.wall_heat_w;
  account[kWork] = group.count * m.pressure_pa *
                   (m.volume_rate_m3_per_s + m.volume_slope_m3_per_pa * m.pressure_rate_pa_per_s);
}

template <class T>
void System<T>::operator()(const T& t, std::span<const T> y, std::span<T> dydt) {
  const T draw = Draw(t, y);
  passages_.Pass(ambient_k_, groups_);
  for (Group& group : groups_) Balance(group, y, dydt);
  SourceRates(draw, y, dydt);
}

template <class T>
void System<T>::SourceRates(const T& draw, std::span<const T> y, std::span<T> dydt) const {
  T delivered(0.0), on(0.0), power(0.0);
  if (reservoir_ && (pump_ == PumpState::kRunning || pump_ == PumpState::kHolding)) {
    const T delivery = Delivery(y[source_]);
    const bool holding = pump_ == PumpState::kHolding;
    T share(1.0);
    if (holding) share = draw > 0.0 ? T(draw / delivery) : T(0.0);
    if (share > 1.0) share = T(1.0);
    on = share * duty_;
    delivered = holding ? draw : delivery;
    if (account_) power = on * PumpPower(y[source_]);
  }
  if (supply_.pump && !outlets_.empty()) {
    on = duty_;
    delivered = draw;
    if (account_) power = on * PumpPower(supply_.node_pa);
  }
  if (reservoir_) {
    const T net = delivered - draw;
    const T& volume = net > 0.0 ? reservoir_rising_m3_ : reservoir_volume_m3_;
    dydt[source_] = pump_ == PumpState::kHolding ? T(0.0) : T(content_rate_ * net / volume);
  }
  if (!account_) return;
  dydt[pump_accounts_ + kOnTime] = on;
  dydt[pump_accounts_ + kPumpAir] = delivered;
  dydt[pump_accounts_ + kPumpEnergy] = power;
}

template <class T>
T System<T>::Reading(std::size_t i, std::span<const T> y) const {
  const Group& group = groups_[i];
  T gauge_pa = y[group.at] - ambient_pa_;
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    group.units[u]->Measure(y.data() + group.unit_at[u], gauge_pa);
  }
  return ambient_pa_ + gauge_pa;
}

// While the valve is partly open the tube alone, which conducts as ever, tells what its flow does.
template <class T>
T System<T>::InletPressure(std::size_t i, const T& t) const {
  using std::sqrt;
  const Group& group = groups_[i];
  const GroupSetup<T>& setup = group.setup;
  const Moment<T>& m = group.moment;
  const std::span<const LineElement<T>> fill = setup.fill, exhaust = setup.exhaust;
  if (m.line_in_m3_per_s > 0.0) {
    if (!(group.filling.At(t) < 1.0) && !group.told.turns())
      return PressureBehind(setup.fill, group.valve[kFill].count, T(1.0), 0, m.head_pa, m.tail_pa,
                            line_options_);
    const Line<T> tube(fill.subspan(group.valve[kFill].count), line_options_);
    if (tube.empty()) return m.tail_pa;
    const auto into = [&](const T& inlet_pa) { return tube.Flow(inlet_pa, m.tail_pa); };
    const T flow = m.line_in_m3_per_s / Thinness(setup.dense, m.head_pa, ambient_k_);
    return PressureAt<T>(into, flow / m.line_factor, m.tail_pa, m.head_pa);
  }
  if (m.line_out_m3_per_s > 0.0) {
    if (!(group.venting.At(t) < 1.0) && !group.told.turns())
      return PressureBehind(setup.exhaust, group.valve[kExhaust].first, m.line_factor,
                            setup.exhaust_fixed, m.tail_pa, exhaust_pa_[i], line_options_);
    const Line<T> tube(exhaust.first(group.valve[kExhaust].first), line_options_);
    if (tube.empty()) return m.tail_pa;
    T flow = m.line_out_m3_per_s / m.line_factor;
    if (group.heated) flow /= sqrt(ambient_k_ / m.tail_temperature_k);
    flow /= Thinness(setup.dense, m.tail_pa, m.tail_temperature_k);
    const auto out = [&](const T& inlet_pa) { return tube.Flow(m.tail_pa, inlet_pa); };
    return PressureAt<T>(out, flow, exhaust_pa_[i], m.tail_pa);
  }
  return m.tail_pa;
}

template <class T>
T System<T>::Stored(std::size_t i, std::span<const T> y) const {
  const Group& group = groups_[i];
  const Moment<T>& m = group.moment;
  T stored = dense_ ? m.content_m3
                    : T((m.pressure_pa - line_options_.mirror_pa) * m.volume_m3 /
                        kReferencePressurePa * kReferenceTemperatureK / m.temperature_k);
  for (std::size_t u = 0; u < group.units.size(); ++u) {
    stored += group.units[u]->Stored(group.setup, y.data() + group.unit_at[u]);
  }
  return group.count * stored;
}

template <class T>
T System<T>::Energy(std::size_t i) const {
  const Group& group = groups_[i];
  if (dense_) return group.count * DenseVolume<T>(group.setup, group.moment).Energy();
  return group.count * group.moment.pressure_pa * group.moment.volume_m3 /
         (group.setup.heat_capacity_ratio - 1.0);
}

template <class T>
T System<T>::Of(std::size_t i, Account account, std::span<const T> y) const {
  const Group& group = groups_[i];
  if (!account_ || (account > kLeaked && !group.heated)) return T(0.0);
  return y[group.accounts + account];
}

template <class T>
T System<T>::Of(PumpAccount account, std::span<const T> y) const {
  return account_ ? y[pump_accounts_ + account] : T(0.0);
}

template class System<double>;
template class System<Dual>;
template class System<WideDual>;

}  // namespace plenum::model
