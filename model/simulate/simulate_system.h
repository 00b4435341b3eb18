// The equations that the simulator integrates, between two switches.
//
// simulate_modes.cc: where the equations change, and the guards that watch it.
#ifndef PLENUM_MODEL_SIMULATE_SIMULATE_SYSTEM_H_
#define PLENUM_MODEL_SIMULATE_SIMULATE_SYSTEM_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/effects/unit.h"
#include "model/flow/pump_table.h"
#include "model/flow/simulate_line.h"
#include "model/simulate/linked/passages.h"
#include "model/simulate/opening.h"
#include "model/simulate/regulator_node.h"
#include "model/simulate/simulate_rig.h"
#include "model/simulate/told/told_group.h"

namespace plenum::model {

// Local error allowed to a state whose value is about `value`: rtol·(its size) with the larger of
// value and typical size, or rtol·p + atol for a pressure (typical size 0).
inline double ErrorBound(double value, double typical, double rtol, double atol_pa) {
  return typical > 0.0 ? rtol * std::max(value, typical) : rtol * value + atol_pa;
}

// kHolding: the reservoir is at the limit pressure and the pumps run the share of time that covers
// what the lines draw.
enum class PumpState { kAbsent, kRunning, kHolding, kStopped };

// What cuts a step: the present mode of the system holds while the guard is positive.
enum class GuardKind { kKink, kOperating, kTarget, kPumpLimit, kPumpDemand, kEffect };
template <class T>
struct Guard {
  GuardKind kind;
  std::size_t group = 0;
  std::size_t index = 0;  // kKink: which line, kEffect: which unit
  double sign = 1.0;      // of what is watched against the level
  T level = T(0.0);
  int step = 0;  // kKink: to the regime beyond, kEffect: which of the unit's guards
};

// State vector: per group the pressure of one actuator and the states of its effects; the pressure
// of the reservoir; then, if `account`, per group what crossed each border and the pumps' on-time,
// delivered m³ ANR and electrical energy.
template <class T>
class System {
 public:
  // The rig must be valid and outlive the system.
  System(const Rig& rig, const LineOptions& lines, const Lift& lift, bool account);

  std::size_t size() const { return sizes_.size(); }
  std::size_t dynamic_size() const { return dynamic_size_; }  // without the accounts
  std::size_t groups() const { return groups_.size(); }
  // By how much more a state may be off than the pressures that sensors see, for a method that
  // damps what rings in it too fast to move them.
  double room(std::size_t state) const { return room_[state]; }
  std::span<const double> sizes() const { return sizes_; }  // typical sizes; 0: a pressure

  std::vector<T> InitialState();
  void operator()(const T& t, std::span<const T> y, std::span<T> dydt);

  // Places in the state vector.
  std::size_t pressure(std::size_t group) const { return groups_[group].at; }
  // Of pumps without a reservoir that of the moment (regulator_node.h); where they deliver the same
  // at any pressure, which nothing then depends on, that of the last Look.
  T SourcePressure(const T& t, std::span<const T> y) const;
  // At the head of the group's line, and which state that is, if it is one.
  T HeadPressure(std::size_t group, const T& t, std::span<const T> y) const;
  std::optional<std::size_t> HeadState(std::size_t group) const;
  std::optional<std::size_t> source_state() const {
    return reservoir_ ? std::optional(source_) : std::nullopt;
  }

  Opening<T>& filling(std::size_t group) { return groups_[group].filling; }
  const Opening<T>& filling(std::size_t group) const { return groups_[group].filling; }
  Opening<T>& venting(std::size_t group) { return groups_[group].venting; }
  const Opening<T>& venting(std::size_t group) const { return groups_[group].venting; }
  const T& valve_delay_s(std::size_t group) const { return groups_[group].setup.valve_delay_s; }
  const GroupSetup<T>& setup(std::size_t group) const { return groups_[group].setup; }

  // A valve that is open but at equal pressures passes nothing until the next switch.
  void set_settled(std::size_t group, bool settled) {
    groups_[group].settled = settled;
    for (Regime& regime : groups_[group].regime) regime.passed = 0;
  }
  bool Passing(std::size_t group, double time_s) const;  // open and not settled
  bool Moving(std::size_t group, double time_s) const;   // its valve opens or closes
  bool Fed(std::size_t group, double time_s) const;      // open to the source
  // Whether a valve once at equal pressures has nothing to pass before the next switch.
  bool settles(std::size_t group) const { return groups_[group].settles; }

  PumpState pump() const { return pump_; }
  void set_pump(PumpState pump) { pump_ = pump; }
  const T& pump_limit_pa() const { return pump_table_.limit_pa(); }
  bool has_source() const { return regulated_ || reservoir_ || driven_ || supply_.pump; }
  bool has_reservoir() const { return reservoir_ != nullptr; }

  // m³/s ANR that the lines take from the source, and what all pumps deliver while running.
  T Draw(const T& t, std::span<const T> y);
  T Delivery(const T& source_pa) const;
  bool driven() const { return driven_ || source_unit_; }  // moves by itself
  bool source_may_rise(double source_pa) const;  // by running pumps, or because it is driven

  // Pressure that the group approaches through its open valve while the source stays as it is.
  T FinalPressure(std::size_t group, const T& source_pa) const;

  // Chooses all modes that follow from the state: regimes of flow, effects. Then the guards of
  // these modes, those of the lines and effects first, `extra` after them.
  void Settle(const T& t, std::span<const T> y);
  std::vector<Guard<T>>& guards() { return guards_; }
  const std::vector<Guard<T>>& guards() const { return guards_; }
  // Values of all guards at a state.
  void GuardValues(const T& t, std::span<const T> y, std::span<T> values);
  void PassKink(const Guard<T>& guard);  // the flow goes on in the regime beyond

  // One actuator of the group, as the last call of Look, Draw or () left it.
  const Moment<T>& moment(std::size_t group) const { return groups_[group].moment; }
  void Look(const T& t, std::span<const T> y) {  // at the state
    (*this)(t, y, scratch_);
    if (!supply_.pump || outlets_.empty()) return;
    supply_.node_pa = NodePressure<T>(supply_, outlets_);  // a flow that is given needs none
    for (const NodeOutlet<T>& outlet : outlets_)
      if (Group& group = groups_[outlet.group]; group.lines[kFeed].empty())
        group.moment.head_pa = supply_.node_pa;
  }
  T Reading(std::size_t group, std::span<const T> y) const;  // absolute; of the moment
  bool measured(std::size_t group) const { return groups_[group].measured; }
  bool heated(std::size_t group) const { return groups_[group].heated; }
  T InletPressure(std::size_t group, const T& t) const;     // of the moment
  T Stored(std::size_t group, std::span<const T> y) const;  // m³ ANR behind the valves, all copies
  T Energy(std::size_t group) const;                        // J, all copies; of the moment

  // Accounts of a group, of all its actuators; pumps.
  enum Account { kDrawn, kIn, kOut, kLeaked, kEnthalpyIn, kEnthalpyOut, kWallHeat, kWork };
  T Of(std::size_t group, Account account, std::span<const T> y) const;
  enum PumpAccount { kOnTime, kPumpAir, kPumpEnergy };
  T Of(PumpAccount account, std::span<const T> y) const;

 private:
  static constexpr std::size_t kLines = 3;  // fill, exhaust, feed
  struct Regime {
    int below = 0;   // number of kinks below the present ratio
    int passed = 0;  // times over the bend since the last switch
  };
  struct Group {
    Group() = default;
    Group(Group&&) noexcept = default;

    double count = 1.0;
    GroupSetup<T> setup;
    std::array<Line<T>, kLines> lines;
    std::optional<Line<T>> with_regulator;  // its share of the regulator and the way in
    std::array<Regime, kLines> regime{};
    std::vector<std::unique_ptr<EffectUnit<T>>> units;
    std::vector<std::size_t> unit_at;  // states of each unit, from y[0]
    std::size_t feeding_unit = 0;      // the unit behind the feed
    Opening<T> filling, venting;
    bool settled = false;
    bool settles = true;
    bool measured = false, heated = false;
    std::array<TurnedElements, 2> valve;  // of fill and exhaust: before an inlet sensor
    ToldGroup<T> told;
    std::size_t at = 0;        // of the pressure
    std::size_t accounts = 0;  // of the first account
    Moment<T> moment;
  };
  enum LineIndex : std::size_t { kFill, kExhaust, kFeed };

  Group MakeGroup(const GroupRig& rig, const Lift& lift, const T& factor) const;
  void LayOut();
  void FillMoment(Group& group, const T& t, const T& source_pa, std::span<const T> y) const;
  OpenWay<T> WayOf(Group& group, std::size_t line, const T& t) const;
  void UpdateFlows(const T& t, std::span<const T> y);
  void Balance(Group& group, std::span<const T> y, std::span<T> dydt) const;
  T DeclaredSource(const T& t, std::span<const T> y) const;  // without what effects do to it
  void SourceRates(const T& draw, std::span<const T> y, std::span<T> dydt) const;
  bool TakeFlowInSeries(const NodeOutlet<T>& outlet, T& flow) const;
  bool LineOpen(const Group& group, std::size_t line, double time_s) const;
  void LookAhead(const T& t, std::span<const T> y);
  std::optional<T> KinkRatio(const Group& group, std::size_t line, const T& t,
                             std::span<const T> y) const;
  T PumpPower(const T& source_pa) const;

  const Rig& rig_;
  // Where the gas is too dense to be ideal.
  const std::optional<DenseGas> dense_ =
      rig_.dense ? std::optional<DenseGas>(rig_.gas) : std::nullopt;
  T ambient_pa_, ambient_k_;
  std::vector<T> exhaust_pa_;  // what each group empties into
  T content_rate_;             // Pa·m³ per m³ ANR: P0·T_a/T0
  const RegulatedSource* regulated_ = nullptr;
  const ReservoirSource* reservoir_ = nullptr;
  const DrivenSource* driven_ = nullptr;
  mutable std::size_t record_near_ = 0;         // point of its record
  const EffectUnit<T>* source_unit_ = nullptr;  // that acts on the source
  LineOptions line_options_;
  NodeSupply<T> supply_;
  T reservoir_volume_m3_, reservoir_rising_m3_, duty_, driven_factor_, source_initial_pa_,
      regulated_pa_;
  bool node_at_supply_ = true;
  PumpTable<T> pump_table_;
  PumpState pump_ = PumpState::kAbsent;
  std::vector<Group> groups_;
  Passages<T> passages_;
  std::size_t source_ = 0, pump_accounts_ = 0, dynamic_size_ = 0;
  bool account_;
  bool has_modes_ = false;    // some effect has
  std::vector<double> room_;  // by state
  std::vector<double> sizes_;
  std::vector<NodeOutlet<T>> outlets_;
  std::vector<Guard<T>> guards_;
  std::vector<T> scratch_;
};

extern template class System<double>;
extern template class System<Dual>;
extern template class System<WideDual>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIMULATE_SYSTEM_H_
