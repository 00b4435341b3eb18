// A tank that pumps go on filling: against closed forms, and against every stroke of a mission.
#include "model/strokes/refill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/physics/air.h"

namespace plenum::model {
namespace refill_test {

constexpr double kLow = 1e5, kHigh = 8e5;

// Delivery and current fall and rise straight from ambient to the highest pressure.
CompressorCurve Straight(double most_m3_per_s, double least_m3_per_s, double low_a, double high_a) {
  return {.free_air_m3_per_s = MonotoneCurve({kLow, kHigh}, {most_m3_per_s, least_m3_per_s}),
          .current_a = MonotoneCurve({kLow, kHigh}, {low_a, high_a}),
          .voltage_v = 12.0,
          .pressure_max_pa = kHigh};
}

RefillInput Input(const CompressorCurve& curve) {
  RefillInput input;
  input.compressor = &curve;
  input.compressors = 2;
  input.duty = 0.6;
  input.capacity_m3_per_pa = 2e-3 / kReferencePressurePa;
  input.fill_pa = 7e5;
  input.kept_pa = 3e5;
  input.draw_m3_per_s = 2e-4;
  return input;
}

// Pumps that deliver the same at every pressure: all is straight.
TEST(Refill, OfPumpsThatDeliverTheSameAtEveryPressure) {
  const CompressorCurve curve = Straight(1e-4, 1e-4, 2.0, 2.0);
  RefillInput input = Input(curve);
  const double delivered = 2 * 0.6 * 1e-4, draw = input.draw_m3_per_s;
  const double alone_s = input.capacity_m3_per_pa * 4e5 / draw;
  input.seconds = 1.5 * alone_s;
  const Refill refill = RefillTank(input);
  const double air_m3 = 0.5 * alone_s * draw;
  EXPECT_NEAR(refill.on_s, 0.6 * air_m3 / delivered, 1e-8 * refill.on_s);
  EXPECT_NEAR(refill.energy_j, 2 * 24.0 * refill.on_s, 1e-8 * refill.energy_j);
  EXPECT_NEAR(refill.stop_pa,
              3e5 + (draw - delivered) * air_m3 / delivered / input.capacity_m3_per_pa, 1e-3);
  EXPECT_NEAR(refill.lasts_s, input.capacity_m3_per_pa * 4e5 / (draw - delivered),
              1e-8 * refill.lasts_s);
}

// Delivery falls straight with pressure: pressure comes near a balance exponentially.
TEST(Refill, OfPumpsWhoseDeliveryFallsStraight) {
  const CompressorCurve curve = Straight(1.5e-4, 0.1e-4, 2.0, 2.0);
  RefillInput input = Input(curve);
  const double slope = 2 * 0.6 * (1.5e-4 - 0.1e-4) / (kHigh - kLow);
  const double delivered_low = 2 * 0.6 * 1.5e-4;
  const double balance_pa = kLow + (delivered_low - input.draw_m3_per_s) / slope;
  for (const double stop_pa : {3.2e5, 4e5, 5.5e5, 6.9e5}) {
    const double running_s = input.capacity_m3_per_pa / slope *
                             std::log((stop_pa - balance_pa) / (input.kept_pa - balance_pa));
    input.seconds =
        input.capacity_m3_per_pa * (input.fill_pa - stop_pa) / input.draw_m3_per_s + running_s;
    input.stop_pa = 0.0;
    const Refill lowest = RefillTank(input);
    EXPECT_NEAR(lowest.stop_pa, stop_pa, 1e-7 * stop_pa);
    EXPECT_NEAR(lowest.on_s, 0.6 * running_s, 1e-7 * running_s);
    input.stop_pa = stop_pa;
    const Refill given = RefillTank(input);
    EXPECT_NEAR(given.lasts_s, input.seconds, 1e-8 * input.seconds);
    EXPECT_NEAR(given.on_s, lowest.on_s, 1e-7 * running_s);
    EXPECT_NEAR(given.energy_j, lowest.energy_j, 1e-7 * lowest.energy_j);
  }
}

TEST(Refill, PumpsThatDeliverEnoughHoldThePressureThatIsKept) {
  const CompressorCurve curve = Straight(4e-4, 1e-4, 2.0, 3.0);
  RefillInput input = Input(curve);
  input.seconds = 3600.0;
  const Refill refill = RefillTank(input);
  EXPECT_TRUE(std::isinf(refill.lasts_s));
  EXPECT_EQ(refill.stop_pa, input.kept_pa);
  const double delivery = 4e-4 - 3e-4 * 2.0 / 7.0;  // of one pump at what is kept
  const double air_m3 =
      3600.0 * input.draw_m3_per_s - input.capacity_m3_per_pa * (input.fill_pa - input.kept_pa);
  EXPECT_NEAR(refill.on_s, air_m3 / (2 * delivery), 1e-9 * refill.on_s);
  EXPECT_NEAR(refill.energy_j, 2 * 12.0 * (2.0 + 2.0 / 7.0) * refill.on_s, 1e-6 * refill.energy_j);
}

TEST(Refill, AsksNothingOfPumpsWhereTheTankIsEnough) {
  const CompressorCurve curve = Straight(1e-4, 1e-5, 2.0, 3.0);
  RefillInput input = Input(curve);
  input.seconds = 0.99 * input.capacity_m3_per_pa * 4e5 / input.draw_m3_per_s;
  const Refill refill = RefillTank(input);
  EXPECT_EQ(refill.on_s, 0.0);
  EXPECT_EQ(refill.energy_j, 0.0);
  EXPECT_GT(refill.lasts_s, input.seconds);
}

TEST(Refill, SaysHowLongATankLastsThatDoesNotLast) {
  const CompressorCurve curve = Straight(1e-4, 1e-5, 2.0, 3.0);
  RefillInput input = Input(curve);
  input.seconds = 1e5;
  EXPECT_LT(RefillTank(input).lasts_s, input.seconds);
  input.kept_pa = 7.5e5;  // above the fill
  EXPECT_LT(RefillTank(input).lasts_s, 0.0);
}

// Every stroke takes its air at once, and pumps run beside it, by small steps of time.
TEST(Refill, AsEveryStrokeOfAMission) {
  const CompressorCurve curve = Straight(1.5e-4, 0.2e-4, 2.0, 4.0);
  RefillInput input = Input(curve);
  constexpr int kStrokes = 1000, kSteps = 200;
  const double period_s = 0.05;
  input.seconds = (kStrokes - 1) * period_s;
  input.draw_m3_per_s = 2.3e-4;
  const Refill refill = RefillTank(input);
  ASSERT_GE(refill.lasts_s, input.seconds);
  ASSERT_GT(refill.on_s, 0.0);
  double pa = input.fill_pa, on_s = 0.0, energy_j = 0.0;
  for (int stroke = 1; stroke < kStrokes; ++stroke) {
    pa -= input.draw_m3_per_s * period_s / input.capacity_m3_per_pa;
    for (int step = 0; step < kSteps; ++step) {
      const double step_s = period_s / kSteps;
      const double drawn_later_pa =
          input.draw_m3_per_s * (period_s - (step + 0.5) * step_s) / input.capacity_m3_per_pa;
      // The controller looks at the mean of a period.
      if (pa + drawn_later_pa > refill.stop_pa) continue;
      pa += 2 * 0.6 * FreeAirDelivery(curve, pa) * step_s / input.capacity_m3_per_pa;
      on_s += 0.6 * step_s;
      energy_j += 2 * 0.6 * ElectricalPower(curve, pa) * step_s;
    }
  }
  EXPECT_NEAR(pa, input.kept_pa, 1e-3 * input.kept_pa);
  EXPECT_NEAR(on_s, refill.on_s, 2e-3 * refill.on_s);
  EXPECT_NEAR(energy_j, refill.energy_j, 2e-3 * refill.energy_j);
}

// More in the tank, more pumps, less to keep or to draw: never more energy nor a higher stop.
TEST(Refill, ALighterMissionNeverTakesMore) {
  const CompressorCurve curve = Straight(1.5e-4, 0.1e-4, 4.0, 2.0);  // current falls
  RefillInput input = Input(curve);
  input.seconds = 55.0;
  const Refill refill = RefillTank(input);
  ASSERT_GE(refill.lasts_s, input.seconds);
  ASSERT_GT(refill.energy_j, 0.0);
  RefillInput lighter[] = {input, input, input, input};
  lighter[0].fill_pa *= 1.01;
  lighter[1].capacity_m3_per_pa *= 1.01;
  lighter[2].kept_pa *= 0.99;
  lighter[3].draw_m3_per_s *= 0.99;
  for (const RefillInput& other : lighter) {
    const Refill less = RefillTank(other);
    EXPECT_LT(less.energy_j, refill.energy_j);
    EXPECT_LT(less.stop_pa, refill.stop_pa);
    EXPECT_LT(less.on_s, refill.on_s);
  }
}

}  // namespace refill_test
}  // namespace plenum::model
