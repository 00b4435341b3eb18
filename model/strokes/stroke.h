// Rise and fall time through a whole line by quadrature, for any chamber law.
//
// From d(pV)/dt = P0·(T/T0)·Q the time is an integral over pressure, t = ∫ W(p) dp /
// (P0·(T/T0)·Q(p)). Where the line is choked Q is constant in filling and proportional to p in
// emptying; elsewhere the integral runs over θ with q = q*·sinθ, in which the march r(q) is
// explicit and smooth up to both ends. Gauss–Legendre panels that shrink towards the choked end
// where a second element is close to choking give 1e-9 relative (5e-8 at worst, where two elements
// choke at exactly the same flow).
#ifndef PLENUM_MODEL_STROKES_STROKE_H_
#define PLENUM_MODEL_STROKES_STROKE_H_

#include <limits>

#include "model/flow/series.h"
#include "model/physics/chamber.h"

namespace plenum::model {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// Seconds to fill from `from_pa` up to `to_pa` through `fill` out of a source of constant pressure.
// `flow_max_m3_per_s` (ANR, per actuator) caps the flow, as a supply with a flow limit does.
// kNever where `to_pa` lies above the source pressure; 0 where from ≥ to. The series carries the
// gas and temperature factor; `temperature_k` turns standard volume into content.
double FillTime(const Series& fill, const Chamber& chamber, double source_pa, double from_pa,
                double to_pa, double temperature_k = kReferenceTemperatureK,
                double flow_max_m3_per_s = kNever);

// Seconds to empty from `from_pa` down to `to_pa` through `exhaust` into what the chamber empties
// into (ExhaustPa()); kNever below that.
//
// Of an evacuated chamber (chamber.h) the fill empties it into a rail and the exhaust lets air in
// from the surroundings; elements stand in the order crossed there, too, and the flow has no cap.
double EmptyTime(const Series& exhaust, const Chamber& chamber, double from_pa, double to_pa,
                 double temperature_k = kReferenceTemperatureK);

// Seconds to fill `count` equal chambers at once out of a closed reservoir (no compressor) that
// starts at `reservoir_pa`: the content of reservoir and chambers together is constant, so the
// reservoir pressure is a function of the chamber pressure and one quadrature suffices. kNever
// where the common pressure does not reach `to_pa`. Not for evacuated chambers.
double FillTimeFromReservoir(const Series& fill, const Chamber& chamber, int count,
                             double reservoir_m3, double reservoir_pa, double from_pa, double to_pa,
                             double temperature_k = kReferenceTemperatureK);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_STROKE_H_
