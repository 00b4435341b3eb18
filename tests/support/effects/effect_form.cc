#include "tests/support/effects/effect_form.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/support/effects/effect_system.h"

namespace plenum::test {
namespace {

constexpr double kRestRate = 1e-3;  // Pa/s: slower than this the play does not turn back

// An opening that moves at a constant rate to where the valve's command sends it.
struct Opening {
  double value = 0.0, target = 0.0;

  double EndAfter(double ramp_s) const { return std::abs(target - value) * ramp_s; }
  double At(double after_s, double ramp_s) const {
    if (after_s >= EndAfter(ramp_s)) return target;
    return value + (target > value ? after_s : -after_s) / ramp_s;
  }
};

class Simulator {
 public:
  Simulator(const EffectRig& rig, double step_s) : system_(rig), step_s_(step_s) {}

  EffectResult Run(const std::vector<double>& times_s);

 private:
  const EffectRig& Rig() const { return system_.Rig(); }
  EffectState Slope(double t_s, const EffectState& y) const {
    const double after_s = t_s - since_s_;
    return system_.Slope(t_s, y, fill_.At(after_s, Rig().valve_ramp_s),
                         exhaust_.At(after_s, Rig().valve_ramp_s));
  }
  EffectState RungeKutta(double t_s, const EffectState& y, double h) const;
  double PressureRate(double t_s, const EffectState& y) const;
  void TurnPlay(double t_s, const EffectState& y);
  bool PlayTurns(double t_s, const EffectState& y) const;
  void Advance(EffectState& y, double t_s, double to_s);
  void Command(double t_s);
  double NextSwitch(double t_s, double limit_s) const;
  void Sample(double t_s, const EffectState& y, EffectResult& result) const;

  EffectSystem system_;
  double step_s_;
  double since_s_ = 0.0;  // when the openings had their values
  Opening fill_, exhaust_;
  std::size_t next_ = 0;  // command
};

EffectState Simulator::RungeKutta(double t_s, const EffectState& y, double h) const {
  const auto at = [&](const EffectState& k, double share) {
    EffectState z = y;
    for (std::size_t i = 0; i < kSize; ++i) z[i] += share * h * k[i];
    return z;
  };
  const EffectState k1 = Slope(t_s, y);
  const EffectState k2 = Slope(t_s + 0.5 * h, at(k1, 0.5));
  const EffectState k3 = Slope(t_s + 0.5 * h, at(k2, 0.5));
  const EffectState k4 = Slope(t_s + h, at(k3, 1.0));
  EffectState next = y;
  for (std::size_t i = 0; i < kSize; ++i) {
    next[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return next;
}

// Along the state's slope, by a difference.
double Simulator::PressureRate(double t_s, const EffectState& y) const {
  constexpr double kDelta = 1e-4;
  const EffectState slope = Slope(t_s, y);
  EffectState before = y, after = y;
  for (std::size_t i = 0; i < kSize; ++i) {
    before[i] -= kDelta * slope[i];
    after[i] += kDelta * slope[i];
  }
  return (system_.Gas(after).pressure_pa - system_.Gas(before).pressure_pa) / (2.0 * kDelta);
}

// The play at the start of a step.
void Simulator::TurnPlay(double t_s, const EffectState& y) {
  if (!Rig().hysteresis_half_width_pa) return;
  EffectChamber& law = system_.Law();
  const double p = system_.Gas(y).pressure_pa;
  const double rate = PressureRate(t_s, y);
  if (law.Side() != 0) {
    if (law.Side() * rate < -kRestRate) law.Turn(0, p);
  } else if (law.Above(p) > -1e-9 * p && rate > -kRestRate) {
    law.Turn(1, p);
  } else if (law.Below(p) > -1e-9 * p && rate < kRestRate) {
    law.Turn(-1, p);
  }
}

// Whether TurnPlay() has something to do at the end of a step.
bool Simulator::PlayTurns(double t_s, const EffectState& y) const {
  if (!Rig().hysteresis_half_width_pa) return false;
  const EffectChamber& law = system_.Law();
  if (law.Side() != 0) return law.Side() * PressureRate(t_s, y) < -kRestRate;
  const double p = system_.Gas(y).pressure_pa;
  return law.Above(p) > 0.0 || law.Below(p) > 0.0;
}

void Simulator::Advance(EffectState& y, double t_s, double to_s) {
  while (t_s < to_s) {
    TurnPlay(t_s, y);
    double h = std::min(step_s_, to_s - t_s);
    EffectState next = RungeKutta(t_s, y, h);
    if (PlayTurns(t_s + h, next)) {
      double low = 0.0, high = h;
      while (high - low > 1e-12 * step_s_) {
        const double middle = 0.5 * (low + high);
        (PlayTurns(t_s + middle, RungeKutta(t_s, y, middle)) ? high : low) = middle;
      }
      h = high;
      next = RungeKutta(t_s, y, h);
    }
    y = next;
    const double p = system_.Gas(y).pressure_pa;
    system_.Expect(p);
    system_.Law().Remember(p);
    t_s = h == to_s - t_s ? to_s : t_s + h;
  }
}

// Openings as they are at `t_s`, and where the commands that have come by then send them.
void Simulator::Command(double t_s) {
  for (Opening* opening : {&fill_, &exhaust_}) {
    opening->value = opening->At(t_s - since_s_, Rig().valve_ramp_s);
  }
  since_s_ = t_s;
  const auto& schedule = Rig().schedule;
  while (next_ < schedule.size() && schedule[next_].time_s + Rig().valve_delay_s <= t_s) {
    const int direction = schedule[next_++].direction;
    fill_.target = direction > 0 ? 1.0 : 0.0;
    exhaust_.target = direction < 0 ? 1.0 : 0.0;
  }
}

double Simulator::NextSwitch(double t_s, double limit_s) const {
  double next_s = limit_s;
  if (next_ < Rig().schedule.size()) {
    next_s = std::min(next_s, Rig().schedule[next_].time_s + Rig().valve_delay_s);
  }
  for (const Opening& opening : {fill_, exhaust_}) {
    const double end_s = since_s_ + opening.EndAfter(Rig().valve_ramp_s);
    if (end_s > t_s) next_s = std::min(next_s, end_s);
  }
  return next_s;
}

void Simulator::Sample(double t_s, const EffectState& y, EffectResult& result) const {
  const ChamberGas gas = system_.Gas(y);
  const double ambient_pa = Rig().ambient_pa;
  const double felt_pa = Rig().sensor_lag_s > 0.0 ? y[kSensor] : gas.pressure_pa;
  result.pressure_pa.push_back(gas.pressure_pa);
  result.measured_pa.push_back(ambient_pa + Rig().sensor_gain * (felt_pa - ambient_pa) +
                               Rig().sensor_offset_pa);
  result.volume_m3.push_back(gas.volume_m3);
  result.temperature_k.push_back(gas.temperature_k);
  result.supply_pa.push_back(system_.SupplyPressure(t_s, y));
  result.node_pa.push_back(system_.NodePressure(y));
  result.filled_kg.push_back(y[kSource] - y[kDroop]);
  result.emptied_kg.push_back(y[kExhaust]);
}

EffectResult Simulator::Run(const std::vector<double>& times_s) {
  EffectState y = system_.Start();
  EffectResult result;
  result.t_s = times_s;
  const double droop_start_kg = y[kDroop];
  result.gas_start_kg = y[kMass] + y[kDroop] + y[kNode] + y[kSecond];
  result.energy_start_j = system_.Energy(y);
  double t_s = 0.0;
  Command(t_s);
  for (const double sample_s : times_s) {
    while (t_s < sample_s) {
      const double to_s = NextSwitch(t_s, sample_s);
      Advance(y, t_s, to_s);
      t_s = to_s;
      Command(t_s);
    }
    Sample(sample_s, y, result);
  }
  for (double& filled_kg : result.filled_kg) filled_kg += droop_start_kg;
  result.source_kg = y[kSource];
  result.delivered_kg = y[kDelivered];
  result.exhaust_kg = y[kExhaust];
  result.leak_kg = y[kLeak];
  result.heat_j = y[kHeat];
  result.work_j = system_.Work(y);
  result.enthalpy_in_j = y[kIn];
  result.enthalpy_out_j = y[kOut];
  result.gas_kg = y[kMass] + y[kDroop] + y[kNode] + y[kSecond];
  result.energy_j = system_.Energy(y);
  return result;
}

}  // namespace

EffectResult SimulateEffects(const EffectRig& rig, const std::vector<double>& times_s,
                             double step_s) {
  return Simulator(rig, step_s).Run(times_s);
}

}  // namespace plenum::test
