#include "model/effects/unit.h"

#include <cmath>
#include <numbers>

namespace plenum::model {

template <class T>
T GroupSetup<T>::Law(const T& pressure_pa) const {
  if (volume_curve) return CurveAt(*volume_curve, pressure_pa);
  const T x = (pressure_pa - ambient_pressure_pa) / (operating_pressure_pa - ambient_pressure_pa);
  return rest_volume_m3 * (1.0 + (expansion_ratio - 1.0) * x);
}

// The pressure at which the law is read: the share x of the operating pressure is bent to
// x + a·x·(x−1) + s·sin(2πx)/(2π).
template <class T>
T GroupSetup<T>::BentPressure(const T& pressure_pa) const {
  using std::sin;
  if (!bent) return pressure_pa;
  const T span = operating_pressure_pa - ambient_pressure_pa;
  const T x = (pressure_pa - ambient_pressure_pa) / span;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const T bent_x = x + curvature * x * (x - 1.0) + s_amplitude * sin(kTurn * x) / kTurn;
  return ambient_pressure_pa + bent_x * span;
}

template <class T>
T GroupSetup<T>::QuasiStaticVolume(const T& pressure_pa) const {
  return Law(blocked ? ambient_pressure_pa : BentPressure(pressure_pa));
}

template <class T>
T GroupSetup<T>::QuasiStaticSlope(const T& pressure_pa) const {
  using std::cos;
  if (blocked) return T(0.0);
  const T span = operating_pressure_pa - ambient_pressure_pa;
  T slope = volume_curve ? CurveSlopeAt(*volume_curve, BentPressure(pressure_pa))
                         : T(rest_volume_m3 * (expansion_ratio - 1.0) / span);
  if (!bent) return slope;
  const T x = (pressure_pa - ambient_pressure_pa) / span;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return slope * (1.0 + curvature * (2.0 * x - 1.0) + s_amplitude * cos(kTurn * x));
}

template <class T>
T GroupSetup<T>::OperatingVolume() const {
  return Law(operating_pressure_pa);
}

template <class T>
T GroupSetup<T>::Content(const T& pressure_pa, const T& volume_m3, const T& temperature_k) const {
  if (dense) return volume_m3 / dense->Volume(pressure_pa, temperature_k) / kContentPerKelvin;
  return pressure_pa * volume_m3 / kReferencePressurePa * kReferenceTemperatureK / temperature_k;
}

template <class T>
T GroupSetup<T>::Temperature(const T& pressure_pa, const T& volume_m3, const T& content_m3) const {
  if (dense) return dense->Temperature(pressure_pa, volume_m3 / (content_m3 * kContentPerKelvin));
  return pressure_pa * volume_m3 / (kReferencePressurePa * content_m3) * kReferenceTemperatureK;
}

template struct GroupSetup<double>;
template struct GroupSetup<Dual>;
template struct GroupSetup<WideDual>;

}  // namespace plenum::model
