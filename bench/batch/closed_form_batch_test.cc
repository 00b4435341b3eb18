#include "bench/batch/closed_form_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "model/physics/chamber.h"
#include "model/strokes/closed_form.h"
#include "model/strokes/stroke.h"

namespace plenum::bench {
namespace {

constexpr int kDraws = 6000;

struct Case {
  double c = 1e-8, b = 0.3, v0 = 1e-4, v1 = 0.0, outer = 3e5, from = 1e5, to = 2e5,
         reservoir = 1e-3;
};

using Times = void (*)(const StrokeBatch&, std::span<double>, double, Instructions);

std::vector<double> Seconds(Times times, const std::vector<Case>& cases,
                            Instructions instructions = WidestSupported(),
                            double temperature_k = model::kReferenceTemperatureK) {
  const auto column = [&](double Case::*field) {
    std::vector<double> values;
    for (const Case& one : cases) values.push_back(one.*field);
    return values;
  };
  const auto c = column(&Case::c), b = column(&Case::b), v0 = column(&Case::v0),
             v1 = column(&Case::v1), outer = column(&Case::outer), from = column(&Case::from),
             to = column(&Case::to), reservoir = column(&Case::reservoir);
  std::vector<double> seconds(cases.size(), -1.0);
  times({c, b, v0, v1, outer, from, to, reservoir}, seconds, temperature_k, instructions);
  return seconds;
}

// ∫ f from a to a + width; short ranges keep their digits.
template <class Function>
long double Integral(long double a, long double width, const Function& f) {
  if (!(width > 0.0L)) return 0.0L;
  using Rule = boost::math::quadrature::gauss_kronrod<long double, 61>;
  return Rule::integrate([&](long double x) { return f(a + x); }, 0.0L, width, 8, 1e-14L);
}

// ∫ f(y) dy with y² from `near` to `near` + `length`.
template <class Function>
long double IntegralOverRoot(long double near, long double length, const Function& f) {
  const long double root = std::sqrt(near);
  return Integral(root, length / (root + std::sqrt(near + length)), f);
}

long double Slope(const Case& k, long double p) { return k.v0 + 2.0L * k.v1 * p; }

// The differential equations, over y = √(distance to equal pressures), where 1/φ is finite.
long double ExactRise(const Case& k) {
  const long double ps = k.outer, a = 1.0L - k.b;
  const long double start = std::clamp<long double>(k.b * ps, k.from, k.to);
  const long double choked =
      Integral(k.from, start - k.from, [&](long double p) { return Slope(k, p) / ps; });
  const long double subsonic = IntegralOverRoot(ps - k.to, k.to - start, [&](long double y) {
    const long double p = ps - y * y, x = (p / ps - k.b) / a;
    return Slope(k, p) / ps * 2.0L * std::sqrt(ps * a / (1.0L + x));
  });
  return (choked + subsonic) / k.c / model::kReferencePressurePa;
}

long double ExactFall(const Case& k) {
  const long double pa = k.outer, a = 1.0L - k.b;
  const long double choke = k.b > 0.0 ? pa / k.b : 2.0L * k.from;
  const long double start = std::clamp<long double>(choke, k.to, k.from);
  const long double choked = Integral(std::log(start), std::log1p((k.from - start) / start),
                                      [&](long double y) { return Slope(k, std::exp(y)); });
  const long double subsonic = IntegralOverRoot(k.to - pa, start - k.to, [&](long double y) {
    const long double p = pa + y * y, x = (pa / p - k.b) / a;
    return Slope(k, p) / p * 2.0L * std::sqrt(p * a / (1.0L + x));
  });
  return (choked + subsonic) / k.c / model::kReferencePressurePa;
}

long double ExactFromReservoir(const Case& k) {
  const long double a = 1.0L - k.b, vr = k.reservoir;
  const auto content = [&](long double p) { return p * (k.v0 + k.v1 * p); };
  const long double mass = vr * k.outer + content(k.from);
  const auto source = [&](long double p) { return (mass - content(p)) / vr; };
  const auto bisect = [&](long double ratio) {  // p with p = ratio·p_s
    long double low = 0.0L, high = k.outer;
    for (int i = 0; i < 90; ++i) {
      const long double p = 0.5L * (low + high);
      (p < ratio * source(p) ? low : high) = p;
    }
    return low;
  };
  const long double common = bisect(1.0L);
  const long double start = std::clamp<long double>(bisect(std::max(k.b, 0.0)), k.from, k.to);
  const long double choked =
      Integral(k.from, start - k.from, [&](long double p) { return Slope(k, p) / source(p); });
  const long double subsonic = IntegralOverRoot(common - k.to, k.to - start, [&](long double y) {
    const long double p = common - y * y, ps = source(p), x = (p / ps - k.b) / a;
    const long double excess = 1.0L + (k.v0 + k.v1 * (common + p)) / vr;  // (p_s − p)/y²
    return Slope(k, p) / ps * 2.0L * std::sqrt(ps * a / (excess * (1.0L + x)));
  });
  return (choked + subsonic) / k.c / model::kReferencePressurePa;
}

class Draw {
 public:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  double CriticalRatio() {
    switch (std::uniform_int_distribution<int>(0, 5)(engine_)) {
      case 0:
        return 0.0;
      case 1:
        return 0.5;
      case 2:
        return 0.5 + LogUniform(1e-15, 0.1) * (Uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
      case 3:
        return Uniform(-0.2, 0.0);
      default:
        return Uniform(0.0, 0.95);
    }
  }
  model::Chamber AnyChamber() {
    model::Chamber chamber;
    chamber.rest_volume_m3 = LogUniform(1e-7, 1e-2);
    chamber.expansion_ratio = Uniform(0.0, 1.0) < 0.2 ? 1.0 : Uniform(1.0, 4.0);
    chamber.operating_pressure_pa = 1e5 * (1.0 + LogUniform(0.05, 9.0));
    chamber.dead_volume_m3 = chamber.rest_volume_m3 * LogUniform(1e-3, 10.0);
    return chamber;
  }
  Case AnyCase() {
    const model::Chamber chamber = AnyChamber();
    Case k;
    k.c = LogUniform(1e-11, 1e-6);
    k.b = CriticalRatio();
    k.v0 = Volume(chamber, 0.0);
    k.v1 = VolumeSlope(chamber, 0.0);
    return k;
  }
  Case Rise() {
    Case k = AnyCase();
    k.from = 1e5 * LogUniform(1.0, 5.0);
    k.outer = k.from * (1.0 + LogUniform(1e-3, 200.0));
    k.to = Uniform(0.0, 1.0) < 0.1 ? k.outer : k.from + (k.outer - k.from) * LogUniform(1e-6, 1.0);
    k.to = std::min(k.to, k.outer);
    return k;
  }
  Case Fall() {
    Case k = AnyCase();
    k.outer = Uniform(6e4, 1.1e5);
    k.from = k.outer * (1.0 + LogUniform(1e-3, 200.0));
    k.to = Uniform(0.0, 1.0) < 0.1 ? k.outer
                                   : k.outer + (k.from - k.outer) * (1.0 - LogUniform(1e-6, 1.0));
    return k;
  }
  Case FromReservoir() {  // target short of the common pressure, which is ill-conditioned
    Case k = AnyCase();
    k.from = 1e5;
    k.outer = k.from * (1.0 + LogUniform(1e-2, 100.0));
    k.reservoir = (k.v0 + k.v1 * k.outer) * LogUniform(1e-2, 1e4);
    double low = k.from, high = k.outer;
    for (int i = 0; i < 100; ++i) {
      const double p = 0.5 * (low + high);
      const double given = p * (k.v0 + k.v1 * p) - k.from * (k.v0 + k.v1 * k.from);
      (p < k.outer - given / k.reservoir ? low : high) = p;
    }
    k.to = k.from + (low - k.from) * (1.0 - LogUniform(1e-4, 1.0));
    return k;
  }

 private:
  std::mt19937_64 engine_{42};
};

void ExpectAgrees(Times times, Case (Draw::*draw)(), long double (*exact)(const Case&),
                  double tolerance) {
  Draw random;
  std::vector<Case> cases;
  while (static_cast<int>(cases.size()) < kDraws) {
    const Case k = (random.*draw)();
    if (k.from != k.to) cases.push_back(k);
  }
  const std::vector<double> seconds = Seconds(times, cases);
  double worst = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const long double expected = exact(cases[i]);
    const double error = static_cast<double>(std::abs(seconds[i] / expected - 1.0L));
    worst = std::max(worst, error);
    const Case& k = cases[i];
    ASSERT_LE(error, tolerance) << "b " << k.b << " V0 " << k.v0 << " V' " << k.v1 << " outer "
                                << k.outer << " from " << k.from << " to " << k.to << " V_R "
                                << k.reservoir;
  }
  testing::Test::RecordProperty("worst_relative_error", std::to_string(worst * 1e16) + "e-16");
}

TEST(ClosedFormBatch, RiseSolvesTheDifferentialEquation) {
  ExpectAgrees(RiseTimes, &Draw::Rise, ExactRise, 1e-14);
}

TEST(ClosedFormBatch, FallSolvesTheDifferentialEquation) {
  ExpectAgrees(FallTimes, &Draw::Fall, ExactFall, 1e-14);
}

TEST(ClosedFormBatch, ReservoirSolvesTheDifferentialEquation) {
  ExpectAgrees(RiseTimesFromReservoir, &Draw::FromReservoir, ExactFromReservoir, 1e-11);
}

TEST(ClosedFormBatch, ReproducesTheTable) {
  // p_s, p_op, ε, b, c·t_r, c·t_f in units of ambient (t_f to p_a + 0.05·(p_op − p_a)).
  constexpr double kRows[][6] = {
      {3.0, 2.0, 2.0, 0.30, 1.066905, 2.459439}, {2.2, 2.0, 2.0, 0.30, 1.809829, 2.459439},
      {1.5, 1.3, 1.2, 0.20, 0.544652, 0.964523}, {6.0, 2.0, 1.0, 0.30, 0.166679, 0.869134},
      {6.0, 5.0, 1.5, 0.30, 1.225728, 2.328377}, {2.0, 1.7, 1.5, 0.60, 0.826105, 1.297414},
  };
  for (const auto& [source, operating, expansion, b, rise, fall] : kRows) {
    const model::Chamber chamber{1e-4, expansion, operating * 1e5, 1e5, 0.0, {}};
    Case k{1e-9, b, Volume(chamber, 0.0), VolumeSlope(chamber, 0.0)};  // c = C·P0/V0 = 1/s
    k.outer = source * 1e5, k.from = 1e5, k.to = operating * 1e5;
    EXPECT_NEAR(Seconds(RiseTimes, {k})[0], rise, 1e-6);
    k.outer = 1e5, k.from = operating * 1e5, k.to = 1e5 * (1.0 + 0.05 * (operating - 1.0));
    EXPECT_NEAR(Seconds(FallTimes, {k})[0], fall, 1e-6);
  }
}

TEST(ClosedFormBatch, AgreesWithTheScalarFunctions) {
  Draw random;
  for (int i = 0; i < kDraws; ++i) {
    const model::Chamber chamber = random.AnyChamber();
    const double b = random.Uniform(0.0, 0.9);
    const double volume = Volume(chamber, 1e5), operating = chamber.operating_pressure_pa / 1e5;
    const double k1 = VolumeSlope(chamber, 0.0) * 1e5 / volume;
    const model::NormalisedStroke stroke{operating, 1.0 + k1 * (operating - 1.0), b};
    Case k{1e-9, b, Volume(chamber, 0.0), VolumeSlope(chamber, 0.0)};
    const double tau = volume * 1e4;  // seconds per τ
    k.from = 1e5, k.to = operating * 1e5, k.outer = k.to * random.Uniform(1.01, 4.0);
    const double rise = tau * model::NormalisedRiseTime(stroke, k.outer / 1e5, 1.0, operating);
    EXPECT_NEAR(Seconds(RiseTimes, {k})[0], rise, 1e-13 * rise);
    const model::FlowElement element{.sonic_conductance_m3_per_s_pa = k.c, .critical_ratio = b};
    const model::Series series = model::MakeSeries({&element, 1});
    k.reservoir = 20.0 * volume * random.Uniform(1.0, 10.0);
    const double from_reservoir = model::FillTimeFromReservoir(
        series, chamber, 3, 3.0 * k.reservoir, k.outer, k.from, k.to, 280.0);
    const double batch = Seconds(RiseTimesFromReservoir, {k}, WidestSupported(), 280.0)[0];
    if (std::isinf(from_reservoir))
      EXPECT_EQ(batch, from_reservoir);
    else
      EXPECT_NEAR(batch, from_reservoir, 1e-8 * from_reservoir);
    k.outer = 1e5, k.from = operating * 1e5, k.to = 1e5 * (1.0 + 0.1 * (operating - 1.0));
    const double fall = tau * model::NormalisedFallTime(stroke, operating, k.to / 1e5);
    EXPECT_NEAR(Seconds(FallTimes, {k})[0], fall, 1e-13 * fall);
  }
}

TEST(ClosedFormBatch, EveryVariantGivesTheSameBitsWhateverTheCount) {
  Draw random;
  std::vector<Case> cases;
  for (int i = 0; i < 1003; ++i)
    cases.push_back(i % 3 == 0   ? random.Rise()
                    : i % 3 == 1 ? random.Fall()
                                 : random.FromReservoir());
  for (const Times times : {&RiseTimes, &FallTimes, &RiseTimesFromReservoir}) {
    const std::vector<double> baseline = Seconds(times, cases, Instructions::kBaseline);
    for (const Instructions wide : {Instructions::kAvx2, Instructions::kAvx512}) {
      if (!Supported(wide)) continue;
      const std::vector<double> seconds = Seconds(times, cases, wide);
      for (std::size_t i = 0; i < cases.size(); ++i)
        ASSERT_EQ(std::memcmp(&seconds[i], &baseline[i], sizeof(double)), 0) << i;
    }
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(Seconds(times, {cases[i]})[0], baseline[i]);
    EXPECT_TRUE(Seconds(times, {}).empty());
  }
}

TEST(ClosedFormBatch, StrokesThatGoNowhereOrTooFar) {
  Case k;
  k.to = std::nextafter(k.outer, 1e9);
  EXPECT_EQ(Seconds(RiseTimes, {k})[0], model::kNever);
  k.to = k.outer;
  EXPECT_TRUE(std::isfinite(Seconds(RiseTimes, {k})[0]));
  EXPECT_EQ(Seconds(RiseTimesFromReservoir, {k})[0], model::kNever);
  k.to = k.from;
  EXPECT_EQ(Seconds(RiseTimes, {k})[0], 0.0);
  EXPECT_EQ(Seconds(RiseTimesFromReservoir, {k})[0], 0.0);
  k.outer = k.from;  // and no pressure to drive it
  EXPECT_EQ(Seconds(RiseTimes, {k})[0], 0.0);
  EXPECT_EQ(Seconds(FallTimes, {k})[0], 0.0);
  k.to = 0.9e5;
  EXPECT_EQ(Seconds(FallTimes, {k})[0], model::kNever);
}

}  // namespace
}  // namespace plenum::bench
