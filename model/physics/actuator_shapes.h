// Volumes of actuators that are described by their shape, at rest and at the operating pressure.
#ifndef PLENUM_MODEL_PHYSICS_ACTUATOR_SHAPES_H_
#define PLENUM_MODEL_PHYSICS_ACTUATOR_SHAPES_H_

namespace plenum::model {

struct ActuatorVolumes {
  double rest_m3 = 0.0, operating_m3 = 0.0;
};

// Sheets that lie flat at rest hold nothing; the chamber law needs a rest volume, and takes this
// share of the inflated one.
inline constexpr double kFlatShare = 1e-3;
// Of the swept volume, where the dead volume of a cylinder is not known. An assumption.
inline constexpr double kDeadShare = 0.05;

// The swept volume π·bore²/4·stroke comes on top of the dead volume. No piston, load or friction.
ActuatorVolumes CylinderVolumes(double bore_m, double stroke_m, double dead_m3);
// The same of the other side of the piston, less what the rod takes. Valid: rod < bore.
ActuatorVolumes RodSideVolumes(double bore_m, double rod_m, double stroke_m, double dead_m3);

// McKibben muscle: threads that do not stretch, of length L/cos θ, wind round a cylinder of length
// L and diameter D at the braid angle θ to its axis. Shortened to L·(1−κ),
//   V/V0 = (1−κ)·[1 − (1−κ)²·cos²θ] / sin²θ,   V0 = π·D²·L/4
// (Chou and Hannaford, IEEE Trans. Robotics and Automation 12, 1996). Thickness of wall and braid
// and the rounded ends are left out. Valid: 0 < κ ≤ GreatestContraction(θ).
ActuatorVolumes MuscleVolumes(double length_m, double diameter_m, double braid_angle_rad,
                              double contraction);

// 1 − 1/(√3·cos θ): there the braid stands at 54.7° and the volume is greatest. Valid: θ below it.
double GreatestContraction(double braid_angle_rad);

// A rectangle of two sheets, joined at all four sides, inflated to a pillow. With w the shorter and
// h the longer side,
//   V = w³·[h/(π·w) − 0.142·(1 − 10^(−h/w))]
// (Robin, Int. J. of Mathematical Education in Science and Technology 35, 2004, the "paper bag
// problem"); right for h → ∞, some 5 % low for a square.
ActuatorVolumes PouchVolumes(double width_m, double length_m);

// A tube that lies flat and grows to length and diameter: π·d²·L/4. What still lies inside is left
// out.
ActuatorVolumes BodyVolumes(double diameter_m, double length_m);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_ACTUATOR_SHAPES_H_
