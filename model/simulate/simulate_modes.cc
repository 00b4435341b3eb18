// Where the equations change: regimes of flow and modes of effects, and the guards that watch them.
#include <algorithm>
#include <cmath>

#include "model/simulate/simulate_system.h"

namespace plenum::model {
namespace {

// A ratio this close to the border of two regimes counts as inside the one that it came from.
constexpr double kKinkWidth = 1e-9;
// The kink where flow near equal pressures becomes a straight line. A line that passes it so often
// between two switches stays on it, closer than the steps are exact: an actuator rides with a
// reservoir that slow pumps fill. The steps then pass it as they come.
constexpr int kBend = 1, kBendsMost = 1000;
// How far ahead the direction of a motion is asked for.
constexpr double kAheadS = 1e-9;

}  // namespace

// Downstream to upstream pressure of a line that passes, or may; none where its upstream pressure
// is not known without solving for the node.
template <class T>
std::optional<T> System<T>::KinkRatio(const Group& group, std::size_t line, const T& t,
                                      std::span<const T> y) const {
  const bool plain = group.units.empty();
  const T tail = plain ? y[group.at] : group.moment.tail_pa;
  const Line<T>& flow = group.lines[line];
  if (line == kExhaust)
    return flow.RatioOf(tail, exhaust_pa_[static_cast<std::size_t>(&group - groups_.data())]);
  const T source = SourcePressure(t, y);
  const T head = group.lines[kFeed].empty() ? source : group.moment.head_pa;
  if (line == kFeed) {
    if (!node_at_supply_ || !has_source()) return std::nullopt;
    return flow.RatioOf(source, head);
  }
  if (!has_source() || (!node_at_supply_ && group.lines[kFeed].empty())) return std::nullopt;
  return flow.RatioOf(head, tail);
}

template <class T>
bool System<T>::LineOpen(const Group& group, std::size_t line, double time_s) const {
  if (group.lines[line].empty()) return false;
  if (line == kFeed) return true;
  return !group.settled && !(line == kFill ? group.filling : group.venting).Closed(time_s);
}

// The pressures' rates an instant later: at a turn, and where a ramp begins, they are zero.
template <class T>
void System<T>::LookAhead(const T& t, std::span<const T> y) {
  (*this)(t, y, scratch_);
  std::vector<T> ahead(y.begin(), y.end());
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += kAheadS * scratch_[i];
  (*this)(t + kAheadS, ahead, scratch_);
  std::vector<T> rates;
  for (const Group& group : groups_) rates.push_back(group.moment.pressure_rate_pa_per_s);
  (*this)(t, y, scratch_);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    groups_[i].moment.pressure_rate_pa_per_s = rates[i];
  }
}

template <class T>
void System<T>::Settle(const T& t, std::span<const T> y) {
  for (Group& group : groups_) group.told.Settle(ValueOf(t));
  if (has_modes_) {
    LookAhead(t, y);
  } else {
    (*this)(t, y, scratch_);
  }
  guards_.clear();
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& group = groups_[i];
    for (std::size_t u = 0; u < group.units.size(); ++u) {
      group.units[u]->Settle(group.moment, y.data() + group.unit_at[u]);
      for (int g = 0; g < group.units[u]->guards(); ++g) {
        guards_.push_back({GuardKind::kEffect, i, u, 1.0, T(0.0), g});
      }
    }
    for (std::size_t line = 0; line < kLines; ++line) {
      if (!LineOpen(group, line, ValueOf(t))) continue;
      const std::optional<T> ratio = KinkRatio(group, line, t, y);
      if (!ratio) continue;
      const auto kinks = group.lines[line].kinks();
      int& regime = group.regime[line].below;
      const double r = ValueOf(*ratio);
      while (regime > 0 && r < kinks[static_cast<std::size_t>(regime) - 1] - kKinkWidth) --regime;
      while (regime < static_cast<int>(kinks.size()) &&
             r > kinks[static_cast<std::size_t>(regime)] + kKinkWidth) {
        ++regime;
      }
      const bool over = group.regime[line].passed > kBendsMost;
      const int next = regime + (over && regime == kBend),
                last = regime - 1 - (over && regime - 1 == kBend);
      const auto watch = [&](int kink, double sign, int step) {
        guards_.push_back(
            {GuardKind::kKink, i, line, sign, T(kinks[static_cast<std::size_t>(kink)]), step});
      };
      if (next < static_cast<int>(kinks.size())) watch(next, 1.0, next + 1 - regime);
      if (last >= 0) watch(last, -1.0, last - regime);
    }
  }
}

template <class T>
void System<T>::PassKink(const Guard<T>& guard) {
  Regime& regime = groups_[guard.group].regime[guard.index];
  const bool bend = std::max(regime.below, regime.below + guard.step) == kBend + 1;
  regime.below += guard.step;
  regime.passed += bend;
}

template <class T>
void System<T>::GuardValues(const T& t, std::span<const T> y, std::span<T> values) {
  const bool plain = std::all_of(groups_.begin(), groups_.end(),
                                 [](const Group& group) { return group.units.empty(); });
  if (!plain || pump_ == PumpState::kHolding) (*this)(t, y, scratch_);
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    const Guard<T>& guard = guards_[k];
    const Group& group = groups_[guard.group];
    switch (guard.kind) {
      case GuardKind::kKink: {
        const std::optional<T> ratio = KinkRatio(group, guard.index, t, y);
        values[k] = guard.sign * (guard.level - *ratio);
        break;
      }
      case GuardKind::kOperating:
      case GuardKind::kTarget:
        values[k] = guard.sign * (guard.level - y[group.at]) / kReferencePressurePa;
        break;
      case GuardKind::kPumpLimit:
        values[k] = guard.sign * (guard.level - y[source_]) / kReferencePressurePa;
        break;
      case GuardKind::kPumpDemand: {
        values[k] = Delivery(pump_limit_pa());
        for (const Group& drawing : groups_) {
          values[k] -= drawing.count * drawing.moment.draw_m3_per_s;
        }
        break;
      }
      case GuardKind::kEffect: {
        std::array<T, 4> unit_values;
        group.units[guard.index]->Guards(group.moment, y.data() + group.unit_at[guard.index],
                                         unit_values.data());
        values[k] = unit_values[static_cast<std::size_t>(guard.step)];
        break;
      }
    }
  }
}

#define PLENUM_MODES(T)                                                               \
  template std::optional<T> System<T>::KinkRatio(const Group&, std::size_t, const T&, \
                                                 std::span<const T>) const;           \
  template bool System<T>::LineOpen(const Group&, std::size_t, double) const;         \
  template void System<T>::LookAhead(const T&, std::span<const T>);                   \
  template void System<T>::Settle(const T&, std::span<const T>);                      \
  template void System<T>::PassKink(const Guard<T>&);                                 \
  template void System<T>::GuardValues(const T&, std::span<const T>, std::span<T>);
PLENUM_MODES(double)
PLENUM_MODES(Dual)
PLENUM_MODES(WideDual)
#undef PLENUM_MODES

}  // namespace plenum::model
