// Rise and fall time of a linear chamber through one ISO 6358 element at constant source pressure,
// in closed form (isothermal at T0, m = 0.5, no cracking pressure).
//
// Normalised form: p in units of ambient, v = 1 + k·(p−1), k = (ε−1)/(p_op−1), τ = c·t with
// c = C·P0/V0.
//   choked inflation:    τ = Δ[p·v(p)]/p_s
//   subsonic inflation:  p = p_s·(b + (1−b)·sinθ),
//                        τ = (1−b)·{(1−k+2k·p_s·b)·Δθ − 2k·p_s·(1−b)·Δcosθ}
//   choked deflation:    τ = (1−k)·ln(p1/p2) + 2k·(p1−p2)
//   subsonic deflation:  1/p = b + (1−b)·sinθ,  τ = (1−b)·[(1−k)·ΔI1 + 2k·ΔI2]
// The antiderivatives I1, I2 lose digits near b = ½; there Gauss–Legendre in θ is used.
#ifndef PLENUM_MODEL_STROKES_CLOSED_FORM_H_
#define PLENUM_MODEL_STROKES_CLOSED_FORM_H_

namespace plenum::model {

struct NormalisedStroke {
  double operating_pressure_ratio;  // p_op/p_a > 1
  double expansion_ratio;           // ε ≥ 1
  double critical_ratio;            // b in [0, 1)
};

// τ from pressure ratio `from` up to `to`; +∞ if `to` exceeds the source pressure ratio.
// `from` ≤ `to`. The source pressure itself is reached in finite time.
double NormalisedRiseTime(const NormalisedStroke& stroke, double source_pressure_ratio, double from,
                          double to);

// τ from pressure ratio `from` down to `to` ≥ 1, venting to ambient.
double NormalisedFallTime(const NormalisedStroke& stroke, double from, double to);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_CLOSED_FORM_H_
