#include "model/physics/actuator_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plenum::model {
namespace actuator_shapes_test {

constexpr double kPi = std::numbers::pi;
double Radians(double degrees) { return degrees * kPi / 180.0; }

// By the thread itself: unrolled, a thread of length b round n turns of a cylinder is the diagonal
// of a rectangle of L by n·π·D.
double VolumeByThread(double length_m, double diameter_m, double angle_deg, double contraction) {
  const double around_m = length_m * std::tan(Radians(angle_deg));  // n·π·D
  const double turns = around_m / (kPi * diameter_m);
  const double thread_m = std::hypot(length_m, around_m);
  const double shorter_m = length_m * (1.0 - contraction);
  const double wider_m = std::sqrt(thread_m * thread_m - shorter_m * shorter_m) / (kPi * turns);
  return kPi / 4.0 * wider_m * wider_m * shorter_m;
}

TEST(ActuatorShapes, MuscleKeepsTheLengthOfItsThreads) {
  for (const double angle_deg : {15.0, 20.0, 25.0, 35.0, 50.0})
    for (const double share : {0.1, 0.5, 1.0}) {
      const double contraction = share * GreatestContraction(Radians(angle_deg));
      const auto volumes = MuscleVolumes(0.2, 0.012, Radians(angle_deg), contraction);
      EXPECT_NEAR(volumes.operating_m3 / VolumeByThread(0.2, 0.012, angle_deg, contraction), 1.0,
                  1e-12);
      EXPECT_NEAR(volumes.rest_m3, kPi / 4 * 0.012 * 0.012 * 0.2, 1e-18);
    }
}

// The published static force, F = p·π·D²/4·[3(1−κ)²/tan²θ − 1/sin²θ] (Tondu and Lopez 2000), is
// p·dV/d(−L): a derivative of the volume that was found by another way.
TEST(ActuatorShapes, MuscleDoesTheWorkOfItsPublishedForce) {
  const double length_m = 0.15, diameter_m = 0.01, angle = Radians(23.0), step = 1e-6;
  for (const double contraction : {0.05, 0.15, 0.25}) {
    const auto volume = [&](double k) {
      return MuscleVolumes(length_m, diameter_m, angle, k).operating_m3;
    };
    const double slope =
        (volume(contraction + step) - volume(contraction - step)) / (2 * step * length_m);
    const double tangent = std::tan(angle), sine = std::sin(angle);
    const double published =
        kPi / 4 * diameter_m * diameter_m *
        (3 * std::pow(1 - contraction, 2) / (tangent * tangent) - 1 / (sine * sine));
    EXPECT_NEAR(slope / published, 1.0, 1e-6);
  }
}

TEST(ActuatorShapes, MuscleIsLargestAtTheMagicAngle) {
  const double angle = Radians(20.0), greatest = GreatestContraction(angle);
  EXPECT_NEAR(greatest, 0.385597, 1e-6);  // 1 − cos 54.7356°/cos 20°
  const double most = MuscleVolumes(1, 1, angle, greatest).operating_m3;
  EXPECT_GT(most, MuscleVolumes(1, 1, angle, greatest - 0.01).operating_m3);
  EXPECT_GT(most, MuscleVolumes(1, 1, angle, greatest + 0.01).operating_m3);
}

// Tables of makers print 2.01 cm² for a piston of 16 mm.
TEST(ActuatorShapes, CylinderSweepsPistonTimesStroke) {
  const auto volumes = CylinderVolumes(0.016, 0.5, 2e-6);
  EXPECT_DOUBLE_EQ(volumes.rest_m3, 2e-6);
  EXPECT_NEAR((volumes.operating_m3 - volumes.rest_m3) * 1e6, 2.01 * 50, 0.1);
}

// A long pouch is a tube whose circumference is twice its width.
TEST(ActuatorShapes, LongPouchIsATube) {
  const double tube_m2 = std::pow(2 * 0.03 / kPi, 2) * kPi / 4;
  EXPECT_NEAR(PouchVolumes(0.03, 3.0).operating_m3 / (tube_m2 * 3.0), 1.0, 0.005);
  EXPECT_EQ(PouchVolumes(0.03, 0.1).operating_m3, PouchVolumes(0.1, 0.03).operating_m3);
}

// A square teabag of 1 by 1 holds between 0.19 and 0.217 (Kepert's best and the bound known).
TEST(ActuatorShapes, SquarePouchIsATeabag) {
  const double volume = PouchVolumes(1.0, 1.0).operating_m3;
  EXPECT_GT(volume, 0.19);
  EXPECT_LT(volume, 0.217);
  EXPECT_NEAR(PouchVolumes(1.0, 1.0).rest_m3 / volume, kFlatShare, 1e-12);
}

TEST(ActuatorShapes, BodyIsItsTube) {
  EXPECT_NEAR(BodyVolumes(0.1, 2.0).operating_m3, 0.0157079632679, 1e-12);
}

}  // namespace actuator_shapes_test
}  // namespace plenum::model
