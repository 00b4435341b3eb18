// What a rig may show that no effect of the contract describes: cases in which a diagnosis must say
// that it does not know. They act in the simulator of effect_form.h; none of them with
// heat_transfer, whose work needs laws without a memory of their own.
//
// A valve that sticks, a regulator that swings and a sensor that drifts are not here: the first is
// a schedule, the second a course of the source, the third is added to the readings.
#ifndef PLENUM_TESTS_SUPPORT_EFFECTS_UNLISTED_EFFECTS_H_
#define PLENUM_TESTS_SUPPORT_EFFECTS_UNLISTED_EFFECTS_H_

#include <algorithm>
#include <cmath>
#include <optional>

namespace plenum::test {

// First loading is stiffer than what follows (Mullins): with x_max the highest x so far,
//   V_qs = V0·[1 + (ε−1)·x·(1 + d·(1 − x/x_max))]  below x_max, the base law at and above it.
struct Softening {
  double share = 0.0;  // d
};

// The tube kinks as the actuator bends: the conductance of the line is C·(1 − w·u⁴),
// u = (V − V0)/(V_op − V0) within [0, 1].
struct KinkingLine {
  double loss = 0.0;  // w
};

// A rigid volume at ambient temperature behind a small hole in the chamber, which gas passes both
// ways; at the start it has the chamber's pressure.
struct SecondChamber {
  double volume_m3 = 0.0;
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
};

// A seam that gapes above a pressure: an orifice of C·clip((p − p_open)/width, 0, 1) to ambient.
struct GapingSeam {
  double open_pa = 0.0;
  double width_pa = 0.0;
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
};

// A wall that buckles at one pressure: a share w of the expansion comes at x_c,
//   x → (1 − w)·x + w·(S((x − x_c)/δ) − S(−x_c/δ)),  S(z) = 1/(1 + e^−z).
struct SnapThrough {
  double share = 0.0;   // w
  double centre = 0.0;  // x_c
  double width = 0.0;   // δ
};

struct UnlistedEffects {
  std::optional<Softening> softening;
  std::optional<KinkingLine> kinking_line;
  std::optional<SecondChamber> second_chamber;
  std::optional<GapingSeam> gaping_seam;
  std::optional<SnapThrough> snap_through;
};

inline double SnappedShare(const SnapThrough& snap, double x) {
  const auto sigmoid = [&](double at) {
    return 1.0 / (1.0 + std::exp(-(at - snap.centre) / snap.width));
  };
  return (1.0 - snap.share) * x + snap.share * (sigmoid(x) - sigmoid(0.0));
}

inline double KinkFactor(const KinkingLine& kink, double share_of_expansion) {
  const double u = std::clamp(share_of_expansion, 0.0, 1.0);
  return 1.0 - kink.loss * u * u * u * u;
}

inline double OpenShare(const GapingSeam& seam, double pressure_pa) {
  return std::clamp((pressure_pa - seam.open_pa) / seam.width_pa, 0.0, 1.0);
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_EFFECTS_UNLISTED_EFFECTS_H_
