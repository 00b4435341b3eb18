// What an effect may do to a run: the numbers it may change before, and the hooks called inside.
//
// One actuator at an instant is a Moment. The base model fills it step by step — volume law, flows,
// balance — and after each step every effect of the group may replace or add to what stands there:
//   BeforeVolume   the pressure at which the volume law is taken, the pressures at the line's ends
//   AfterVolume    volume, its rate and slope; temperature and wall heat
//   AfterFlow      what enters and leaves the actuator
// Then the pressure follows from the balance of one volume,
//   dp/dt = [κ·(P0/T0)·(T_in·Q_in − T·Q_out) + (κ−1)·Q_w − κ·p·V̇] / (V + κ·p·V'),
// with κ = 1 and T = T_in = T_a isothermal, κ = γ with the energy balance; V' is the part of the
// volume that goes with the pressure at once, V̇ the rate of the rest. Of dense gas:
// simulate/dense_balance.h. Sources: physics of an expanding chamber with enthalpy flows, ISO 6358
// for the flows.
#ifndef PLENUM_MODEL_EFFECTS_UNIT_H_
#define PLENUM_MODEL_EFFECTS_UNIT_H_

#include <vector>

#include "model/effects/effect.h"
#include "model/flow/dense_gas.h"
#include "model/flow/simulate_line.h"
#include "model/physics/air.h"
#include "model/physics/monotone_curve.h"

namespace plenum::model {

// The numbers of a group that effects may change before the run. T: double, Dual or WideDual.
template <class T>
struct GroupSetup {
  T ambient_pressure_pa, ambient_temperature_k;
  T rest_volume_m3, expansion_ratio, operating_pressure_pa, dead_volume_m3;
  const MonotoneCurve* volume_curve = nullptr;  // instead of rest volume and expansion ratio
  bool blocked = false;                         // the volume stays at the rest volume
  bool bent = false;                            // the law, by effects/nonlinear_compliance.h with
  T curvature = T(0.0), s_amplitude = T(0.0);   // these
  T initial_pressure_pa, initial_temperature_k;
  T source_pressure_pa;  // at the start; the ambient pressure without a source
  T flow_factor;         // √(T0/T_a) and the gas
  double heat_capacity_ratio = 1.4;
  const DenseGas* dense = nullptr;  // the gas, where it is too dense to be ideal
  double reference_density_kg_per_m3 = kReferenceDensityKgPerM3,
         viscosity_pa_s = ViscosityPaS(Gas::kAir);
  std::vector<LineElement<T>> fill, exhaust;  // in the order crossed, flow_factor included
  std::size_t exhaust_fixed = 0;  // elements at the end of the exhaust that the valve does not turn
  std::vector<LineElement<T>> feed;  // between source and Moment::head_pa; empty: none
  T valve_delay_s = T(0.0), valve_ramp_s = T(0.0);

  // Volume law without dead volume, and its slope dV/dp.
  T QuasiStaticVolume(const T& pressure_pa) const;
  T QuasiStaticSlope(const T& pressure_pa) const;
  // V(p_op) of the actuator when it is not blocked.
  T OperatingVolume() const;
  // m³ ANR of gas at a state, and its temperature where that is known.
  T Content(const T& pressure_pa, const T& volume_m3, const T& temperature_k) const;
  T Temperature(const T& pressure_pa, const T& volume_m3, const T& content_m3) const;
  // Pa·m³ per m³ ANR at the ambient temperature.
  T ContentRate() const {
    return kReferencePressurePa * ambient_temperature_k / kReferenceTemperatureK;
  }

 private:
  T Law(const T& pressure_pa) const;
  T BentPressure(const T& pressure_pa) const;
};

// ANR, from other actuators and into them, and the heat that comes with the first.
template <class T>
struct PassedGas {
  T in_m3_per_s = T(0.0), out_m3_per_s = T(0.0), heat_w = T(0.0);
};

// One actuator at an instant.
template <class T>
struct Moment {
  T pressure_pa;
  T volume_pressure_pa;               // at which the volume law is taken
  bool volume_follows = true;         // whether that moves with the pressure
  T head_pa, tail_pa;                 // at the ends of the line
  T quasi_static_volume_m3;           // without dead volume
  T volume_m3;                        // of the gas, dead volume included
  T followed_volume_m3 = T(0.0);      // that inertia strives for, without dead volume
  T volume_slope_m3_per_pa = T(0.0);  // V'
  T volume_rate_m3_per_s = T(0.0);    // V̇
  T temperature_k, tail_temperature_k;
  T content_m3 = T(0.0);             // ANR; of dense gas
  double heat_capacity_ratio = 1.0;  // κ
  T wall_heat_w = T(0.0);
  T line_factor = T(1.0);        // on the conductance of the line, both ways
  T draw_m3_per_s = T(0.0);      // ANR, out of the source
  T line_in_m3_per_s = T(0.0);   // ANR, head to tail
  T line_out_m3_per_s = T(0.0);  // ANR, tail to ambient
  PassedGas<T> passed;
  T in_m3_per_s = T(0.0), out_m3_per_s = T(0.0);  // ANR, into and out of the actuator
  T leak_m3_per_s = T(0.0);                       // the part of out that leaks
  T pressure_rate_pa_per_s = T(0.0);
};

template <class T>
class EffectUnit {
 public:
  virtual ~EffectUnit() = default;

  virtual void Prepare(GroupSetup<T>&) {}

  // States of its own. `size` is the typical size of each, for error control.
  virtual int states() const { return 0; }
  virtual void Start(const GroupSetup<T>&, const Moment<T>&, T* /*x*/, double* /*size*/) {}
  // They may ring too fast to move the actuator's pressure, which is what is looked at.
  virtual bool hidden_states() const { return false; }

  virtual void BeforeVolume(const GroupSetup<T>&, const T* /*x*/, Moment<T>&) const {}
  virtual void AfterVolume(const GroupSetup<T>&, const T* /*x*/, Moment<T>&) const {}
  virtual void AfterFlow(const GroupSetup<T>&, const T* /*x*/, Moment<T>&) const {}
  virtual void Rates(const GroupSetup<T>&, const Moment<T>&, const T* /*x*/, T* /*dxdt*/) const {}

  // Gas in stores of its own behind the valve, m³ ANR.
  virtual T Stored(const GroupSetup<T>&, const T* /*x*/) const { return T(0.0); }

  // What the source gives at a time: turns its pressure, Pa, into the one then. Of all groups the
  // first such unit acts, since they share the source.
  virtual bool acts_on_source() const { return false; }
  virtual void Source(const T& /*t_s*/, T& /*pressure_pa*/) const {}

  // What the sensor shows: turns the gauge pressure, Pa, into the reading.
  virtual void Measure(const T* /*x*/, T& /*gauge_pa*/) const {}

  // Modes: the present one holds while all guards are positive. Settle chooses the mode from the
  // instant on; it is called at the start and wherever a step was cut. There the pressure's rate is
  // that of a moment later.
  virtual int guards() const { return 0; }
  virtual void Guards(const Moment<T>&, const T* /*x*/, T* /*guards*/) const {}
  virtual void Settle(const Moment<T>&, const T* /*x*/) {}
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_UNIT_H_
