#include "bench/batch/simulate_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "bench/batch/simulate_lanes.h"
#include "model/effects/effect.h"
#include "model/strokes/closed_form.h"
#include "model/strokes/stroke.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::bench {
namespace {

constexpr int kDraws = 3000;

class Draw {
 public:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  int Below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(engine_); }

  model::FlowElement Element() {
    return {LogUniform(5e-11, 2e-8), Below(5) == 0 ? 0.0 : Uniform(0.0, 0.9)};
  }

  // What the lanes take.
  model::Rig LaneRig() {
    const double ambient_pa = Uniform(70e3, 105e3);
    const double operating_pa = ambient_pa * LogUniform(1.02, 6.0);
    model::GroupRig group;
    group.count = 1 + Below(6);
    group.chamber.rest_volume_m3 = LogUniform(1e-6, 1e-3);
    group.chamber.expansion_ratio = Below(5) == 0 ? 1.0 : Uniform(1.0, 5.0);
    group.chamber.operating_pressure_pa = operating_pa;
    group.chamber.ambient_pressure_pa = ambient_pa;
    group.chamber.dead_volume_m3 =
        Below(2) == 0 ? 0.0 : Uniform(0.0, 1.0) * group.chamber.rest_volume_m3;
    group.blocked = Below(8) == 0;
    group.fill = {Element()};
    group.exhaust = {Element()};
    model::Rig rig = model::RigOf(model::NoSource{}, {group});
    rig.ambient = {ambient_pa, Uniform(270.0, 320.0)};
    rig.gas = Below(4) == 0 ? model::Gas::kCo2 : model::Gas::kAir;
    const double source_pa = operating_pa * LogUniform(1.0002, 5.0);
    if (Below(2) == 0) {
      rig.source = model::Regulated(source_pa);
    } else {
      model::ReservoirSource reservoir;
      reservoir.initial_pressure_pa = source_pa;
      reservoir.volume_m3 = group.count * group.chamber.rest_volume_m3 * LogUniform(1.0, 1e3);
      rig.source = reservoir;
    }
    return rig;
  }

  // Mostly rigs for the lanes; the others differ in what lanes do not know.
  model::Rig AnyRig() {
    model::Rig rig = LaneRig();
    model::GroupRig& group = rig.groups[0];
    switch (Below(12)) {
      case 0:
        group.fill.push_back(Element());
        break;
      case 1:
        group.exhaust[0].subsonic_index = 0.6;
        break;
      case 2:
        group.fill[0].cracking_pressure_pa = 500.0;
        break;
      case 3:
        group.effects = {{model::FindEffect("dead_volume"), {1e-5}}};
        break;
      case 4:
        rig.groups.push_back(group);
        rig.groups[1].chamber.rest_volume_m3 *= 1.7;
        break;
      case 5:
        if (auto* source = std::get_if<model::RegulatedSource>(&rig.source))
          source->regulator = Element();
        break;
      case 6:
        if (auto* source = std::get_if<model::RegulatedSource>(&rig.source)) {
          source->flow_max_m3_per_s = 1e-4;
        }
        break;
      case 7:
        rig.groups[0].fill.clear();
        break;
      default:
        break;
    }
    return rig;
  }

 private:
  std::mt19937_64 engine_{20260};
};

model::SimulateOptions At(double tolerance) {
  model::SimulateOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance_pa = 1e-6 * std::min(1.0, tolerance * 1e8);
  return options;
}

std::vector<model::FullStroke> Batch(const std::vector<model::Rig>& rigs,
                                     const model::SimulateOptions& options,
                                     Instructions instructions = WidestSupported(),
                                     int threads = 1) {
  std::size_t groups = 0;
  for (const model::Rig& rig : rigs) groups += rig.groups.size();
  std::vector<model::FullStroke> strokes(groups, {-1.0, -1.0, -1.0});
  FullStrokesOfMany(rigs, options, strokes, threads, instructions);
  return strokes;
}

std::vector<model::FullStroke> OneByOne(const std::vector<model::Rig>& rigs,
                                        const model::SimulateOptions& options) {
  std::vector<model::FullStroke> strokes;
  for (const model::Rig& rig : rigs) {
    for (const model::FullStroke& stroke : model::FullStrokes(rig, options))
      strokes.push_back(stroke);
  }
  return strokes;
}

bool SameBits(const model::FullStroke& a, const model::FullStroke& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return bits(a.rise_time_s) == bits(b.rise_time_s) && bits(a.fall_time_s) == bits(b.fall_time_s) &&
         bits(a.frequency_max_hz) == bits(b.frequency_max_hz) && a.status == b.status;
}

// Largest difference of a and b per b; infinities must agree.
double Deviation(double a, double b) { return a == b ? 0.0 : std::abs(a / b - 1.0); }

TEST(SimulateBatch, AgreesWithTheScalarSimulator) {
  Draw draw;
  std::vector<model::Rig> rigs;
  for (int i = 0; i < kDraws; ++i) rigs.push_back(draw.AnyRig());
  const model::SimulateOptions options = At(1e-11);
  const auto many = Batch(rigs, options);
  const auto single = OneByOne(rigs, options);
  ASSERT_EQ(many.size(), single.size());
  int reached = 0;
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_LE(Deviation(many[i].rise_time_s, single[i].rise_time_s), 1e-8) << i;
    EXPECT_LE(Deviation(many[i].fall_time_s, single[i].fall_time_s), 1e-8) << i;
    EXPECT_LE(Deviation(many[i].frequency_max_hz, single[i].frequency_max_hz), 1e-8) << i;
    reached += many[i].frequency_max_hz > 0.0 ? 1 : 0;
  }
  EXPECT_GT(reached, kDraws / 2);
  EXPECT_LT(reached, static_cast<int>(many.size()));
}

// Rise time from 1 bar at constant pressure, and fall time, in closed form.
TEST(SimulateBatch, ErrorFollowsTheTolerance) {
  Draw draw;
  std::vector<model::Rig> rigs;
  std::vector<double> rise_s, fall_s;
  while (rigs.size() < kDraws) {
    model::Rig rig = draw.LaneRig();
    rig.ambient = {};
    rig.gas = model::Gas::kAir;
    model::GroupRig& group = rig.groups[0];
    group.blocked = false;
    model::Chamber& chamber = group.chamber;
    chamber.operating_pressure_pa *= model::kReferencePressurePa / chamber.ambient_pressure_pa;
    chamber.ambient_pressure_pa = model::kReferencePressurePa;
    chamber.dead_volume_m3 = 0.0;
    const double ratio = chamber.operating_pressure_pa / model::kReferencePressurePa;
    const double source = ratio * draw.LogUniform(1.01, 5.0);
    if (0.05 * (ratio - 1.0) < 2e-3) continue;  // the fall would end on the straight line
    rig.source = model::Regulated(source * model::kReferencePressurePa);
    rigs.push_back(rig);
    const auto seconds = [&](double tau, const model::FlowElement& element) {
      return tau * chamber.rest_volume_m3 /
             (element.sonic_conductance_m3_per_s_pa * model::kReferencePressurePa);
    };
    const auto& fill = group.fill[0];
    const auto& exhaust = group.exhaust[0];
    rise_s.push_back(
        seconds(model::NormalisedRiseTime({ratio, chamber.expansion_ratio, fill.critical_ratio},
                                          source, 1.0, 1.0 + 0.95 * (ratio - 1.0)),
                fill));
    fall_s.push_back(
        seconds(model::NormalisedFallTime({ratio, chamber.expansion_ratio, exhaust.critical_ratio},
                                          ratio, 1.0 + 0.05 * (ratio - 1.0)),
                exhaust));
  }
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const auto strokes = Batch(rigs, At(tolerance));
    double worst = 0.0;
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      worst = std::max({worst, Deviation(strokes[i].rise_time_s, rise_s[i]),
                        Deviation(strokes[i].fall_time_s, fall_s[i])});
    }
    EXPECT_LE(worst, 50.0 * tolerance) << tolerance;
  }
}

TEST(SimulateBatch, ReservoirAgreesWithTheQuadrature) {
  Draw draw;
  std::vector<model::Rig> rigs;
  while (rigs.size() < kDraws) {
    model::Rig rig = draw.LaneRig();
    rig.ambient.temperature_k = model::kReferenceTemperatureK;
    rig.gas = model::Gas::kAir;
    rig.groups[0].blocked = false;
    if (std::holds_alternative<model::ReservoirSource>(rig.source)) rigs.push_back(rig);
  }
  const auto strokes = Batch(rigs, At(1e-11));
  int compared = 0;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const auto& reservoir = std::get<model::ReservoirSource>(rigs[i].source);
    const model::GroupRig& group = rigs[i].groups[0];
    const model::Chamber& chamber = group.chamber;
    const double ambient_pa = chamber.ambient_pressure_pa;
    const double to_pa = ambient_pa + 0.95 * (chamber.operating_pressure_pa - ambient_pa);
    const double given_m3 = group.count * (Content(chamber, to_pa) - Content(chamber, ambient_pa));
    const double source_pa = reservoir.initial_pressure_pa - given_m3 / reservoir.volume_m3;
    if (source_pa < to_pa * (1.0 - 1e-5)) {
      EXPECT_EQ(strokes[i].rise_time_s, model::kInf) << i;
    } else if (to_pa < 0.998 * source_pa) {
      const double exact_s = model::FillTimeFromReservoir(
          model::MakeSeries(group.fill), chamber, group.count, reservoir.volume_m3,
          reservoir.initial_pressure_pa, ambient_pa, to_pa);
      EXPECT_LE(Deviation(strokes[i].rise_time_s, exact_s), 1e-8) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, kDraws / 3);
}

TEST(SimulateBatch, NeitherOrderNorSizeNorInstructionsMatter) {
  Draw draw;
  std::vector<model::Rig> rigs;
  for (int i = 0; i < kDraws; ++i) rigs.push_back(draw.LaneRig());
  const model::SimulateOptions options = At(1e-8);
  const auto strokes = Batch(rigs, options);
  const auto reversed = Batch({rigs.rbegin(), rigs.rend()}, options);
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    EXPECT_TRUE(SameBits(strokes[i], reversed[rigs.size() - 1 - i])) << i;
  }
  for (std::size_t size : {1, 2, 7, 63, 64, 65, 129}) {
    const auto some =
        Batch({rigs.begin(), rigs.begin() + static_cast<std::ptrdiff_t>(size)}, options);
    for (std::size_t i = 0; i < size; ++i) EXPECT_TRUE(SameBits(some[i], strokes[i])) << size;
  }
  for (const Instructions instructions :
       {Instructions::kBaseline, Instructions::kAvx2, Instructions::kAvx512}) {
    if (!Supported(instructions)) continue;
    const auto same = Batch(rigs, options, instructions);
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      EXPECT_TRUE(SameBits(same[i], strokes[i])) << i << ' ' << static_cast<int>(instructions);
    }
  }
}

TEST(SimulateBatch, ThreadsDoNotMatter) {
  Draw draw;
  std::vector<model::Rig> rigs;
  for (int i = 0; i < 2500; ++i) rigs.push_back(draw.LaneRig());
  const auto alone = Batch(rigs, At(1e-6));
  const auto shared = Batch(rigs, At(1e-6), WidestSupported(), 3);
  for (std::size_t i = 0; i < rigs.size(); ++i) EXPECT_TRUE(SameBits(alone[i], shared[i])) << i;
}

TEST(SimulateBatch, TargetsNearAndBeyondTheEndOfTheStroke) {
  Draw draw;
  std::vector<model::Rig> rigs;
  for (const double excess : {-0.1, -1e-4, -1e-8, 0.0, 1e-9, 1e-7, 1e-5, 1e-3, 5e-3}) {
    for (int i = 0; i < 10; ++i) {
      rigs.push_back(draw.LaneRig());
      model::GroupRig& group = rigs.back().groups[0];
      group.blocked = false;
      const model::Chamber& chamber = group.chamber;
      const double end_pa = chamber.operating_pressure_pa * (1.0 + excess);
      rigs.back().source = model::Regulated(end_pa);
      if (i % 2 == 0) continue;
      model::ReservoirSource reservoir;
      reservoir.volume_m3 = group.count * chamber.rest_volume_m3 * draw.LogUniform(1.0, 100.0);
      reservoir.initial_pressure_pa =
          end_pa + group.count *
                       (Content(chamber, end_pa) - Content(chamber, chamber.ambient_pressure_pa)) /
                       reservoir.volume_m3;
      rigs.back().source = reservoir;
    }
  }
  model::SimulateOptions options = At(1e-10);
  options.rise_fraction = 1.0;
  for (const double fall_fraction : {0.0, 1e-6, 1e-4}) {
    options.fall_fraction = fall_fraction;
    const auto many = Batch(rigs, options);
    const auto single = OneByOne(rigs, options);
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      EXPECT_LE(Deviation(many[i].rise_time_s, single[i].rise_time_s), 1e-6) << i;
      EXPECT_LE(Deviation(many[i].fall_time_s, single[i].fall_time_s), 1e-6) << i;
    }
    EXPECT_EQ(many[0].rise_time_s, model::kInf);
    EXPECT_TRUE(std::isfinite(many.back().rise_time_s));
  }
}

// Each fault in a rig that is otherwise fit for the lanes.
TEST(SimulateBatch, RefusesWhatTheSimulatorRefuses) {
  model::Rig good =
      model::RigOf(model::Regulated(3e5), {model::OneActuator(2e5, 2.0, {1e-8, 0.3})});
  const double nan = std::nan("");
  std::vector<model::Rig> rigs(17, good);
  rigs[0].groups.clear();
  rigs[1].ambient.pressure_pa = nan;
  rigs[2].ambient.pressure_pa = 0.9e5;  // not the chamber's
  rigs[3].ambient.temperature_k = 0.0;
  rigs[4].source = model::Regulated(-1.0);
  rigs[5].groups[0].count = 0;
  rigs[6].groups[0].chamber.rest_volume_m3 = 0.0;
  rigs[7].groups[0].chamber.expansion_ratio = 0.5;
  rigs[8].groups[0].chamber.operating_pressure_pa = 1e5;
  rigs[9].groups[0].chamber.dead_volume_m3 = -1e-9;
  rigs[10].groups[0].fill[0].sonic_conductance_m3_per_s_pa = nan;
  rigs[11].groups[0].exhaust[0].critical_ratio = 1.0;
  rigs[12].groups[0].exhaust[0].subsonic_index = 0.0;
  rigs[13].groups[0].initial_temperature_k = -1.0;
  rigs[14].source = model::ReservoirSource{.volume_m3 = 0.0, .initial_pressure_pa = 3e5};
  rigs[15].source = model::ReservoirSource{
      .volume_m3 = 1e-3, .volume_rising_m3 = nan, .initial_pressure_pa = 3e5};
  const auto many = Batch(rigs, At(1e-9));
  const auto single = OneByOne(rigs, At(1e-9));
  ASSERT_EQ(many.size(), 16u);
  for (std::size_t i = 0; i + 1 < many.size(); ++i) {
    EXPECT_EQ(single[i].rise_time_s, model::kInf) << i;
    EXPECT_EQ(many[i].rise_time_s, model::kInf) << i;
    EXPECT_LE(Deviation(many[i].fall_time_s, single[i].fall_time_s), 1e-8) << i;
    EXPECT_EQ(many[i].frequency_max_hz, 0.0) << i;
  }
  EXPECT_LE(Deviation(many.back().rise_time_s, single.back().rise_time_s), 1e-8);

  model::SimulateOptions options = At(1e-9);
  options.rise_fraction = 0.0;
  EXPECT_EQ(Batch({good}, options)[0].fall_time_s, model::kInf);
}

// Below the rounding of a step no lane gets on; what comes of it is the simulator's to say.
TEST(SimulateBatch, ToleranceThatNoStepMeets) {
  Draw draw;
  const std::vector<model::Rig> rigs = {draw.LaneRig(), draw.LaneRig(), draw.LaneRig()};
  model::SimulateOptions options;
  options.relative_tolerance = 1e-30;
  options.absolute_tolerance_pa = 1e-30;
  options.steps_max = 2000;
  const auto many = Batch(rigs, options);
  const auto single = OneByOne(rigs, options);
  for (std::size_t i = 0; i < rigs.size(); ++i) EXPECT_TRUE(SameBits(many[i], single[i])) << i;
}

TEST(SimulateBatch, ObeysTheOptionsOfTheSimulator) {
  const model::Rig rig =
      model::RigOf(model::Regulated(3e5), {model::OneActuator(2e5, 2.0, {1e-8, 0.3})});
  const std::vector<model::Rig> rigs(3000, rig);
  const double rise_s = model::FullStrokes(rig, At(1e-10))[0].rise_time_s;

  // A lane that may not take enough steps hands over to the simulator, which may not either.
  model::SimulateOptions options = At(1e-10);
  options.steps_max = 3;
  EXPECT_EQ(model::FullStrokes(rig, options)[0].rise_time_s, model::kInf);
  EXPECT_EQ(Batch({rig}, options)[0].rise_time_s, model::kInf);

  options = At(1e-10);
  options.linear_ratio = 0.2;  // below b
  EXPECT_LE(Deviation(Batch({rig}, options)[0].rise_time_s,
                      model::FullStrokes(rig, options)[0].rise_time_s),
            1e-8);
  options.linear_ratio = 0.5;
  EXPECT_LE(Deviation(Batch({rig}, options)[0].rise_time_s,
                      model::FullStrokes(rig, options)[0].rise_time_s),
            1e-8);
  EXPECT_GT(Deviation(Batch({rig}, options)[0].rise_time_s, rise_s), 1e-3);

  int asked = 0;
  options = At(1e-10);
  options.cancelled = [&asked] { return ++asked > 1; };
  const auto strokes = Batch(rigs, options);
  EXPECT_LE(Deviation(strokes.front().rise_time_s, rise_s), 1e-8);
  EXPECT_EQ(strokes.back().rise_time_s, model::kInf);
}

TEST(SimulateLanes, SaysWhichLegsTookTooManySteps) {
  const Leg leg = {.conductance_pa_m3_per_s_pa = 1e-3,
                   .critical_ratio = 0.3,
                   .volume_at_zero_m3 = 0.0,
                   .volume_slope_m3_per_pa = 5e-10,
                   .outer_pa = 3e5,
                   .per_reservoir_m3 = 0.0,
                   .start_pa = 1e5,
                   .from_pa = 1e5,
                   .to_pa = 2e5};
  Leg tiny = leg;
  tiny.to_pa = 1.0001e5;
  std::vector<Leg> legs(100, leg);
  legs[37] = tiny;
  std::vector<double> seconds(legs.size(), -1.0);
  LegTimes(LegStroke::kRise, LegFlow::kSubsonic, legs, {1e-10, 1e-6, 1}, seconds);
  for (std::size_t i = 0; i < legs.size(); ++i) EXPECT_EQ(std::isnan(seconds[i]), i != 37) << i;
  LegTimes(LegStroke::kRise, LegFlow::kSubsonic, legs, {1e-10, 1e-6, 1000}, seconds);
  for (std::size_t i = 0; i < legs.size(); ++i) EXPECT_TRUE(seconds[i] > 0.0) << i;
}

TEST(SimulateBatch, EmptyList) { EXPECT_TRUE(Batch({}, At(1e-8)).empty()); }

}  // namespace
}  // namespace plenum::bench
