#include "model/strokes/stroke_enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "model/strokes/stroke.h"

namespace plenum::model {
namespace stroke_enclosure_test {

class Draw {
 public:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Log(double low, double high) { return std::exp(Between(std::log(low), std::log(high))); }
  std::vector<FlowElement> Elements() {
    std::vector<FlowElement> elements(static_cast<std::size_t>(Between(1.0, 8.0)));
    for (FlowElement& element : elements) {
      element.sonic_conductance_m3_per_s_pa = Log(1e-10, 3e-8);
      element.critical_ratio = Between(0.0, 1.0) < 0.1 ? 0.0 : Between(0.02, 0.6);
    }
    if (elements.size() > 2 && Between(0.0, 1.0) < 0.3) elements[2] = elements[0];
    return elements;
  }
  Chamber Room() {
    Chamber chamber;
    chamber.rest_volume_m3 = Log(1e-6, 1e-3);
    chamber.expansion_ratio = Between(1.0, 4.0);
    chamber.operating_pressure_pa = Log(1.2e5, 6e5);
    chamber.dead_volume_m3 = Log(1e-8, 1e-5);
    return chamber;
  }

 private:
  std::mt19937_64 random_{7};
};

#ifdef PLENUM_SANITIZED
constexpr int kDraws = 2000;
#else
constexpr int kDraws = 20000;
#endif

// How often, and how closely, enclosures hold the quadrature's time.
struct Tally {
  int known = 0, all = 0;
  double apart = 0.0;
  void Add(const Enclosure& enclosure, double seconds) {
    ++all;
    ASSERT_LE(enclosure.low_s, seconds);
    ASSERT_GE(enclosure.high_s, seconds);
    if (std::isinf(enclosure.high_s)) return;
    ++known;
    apart += enclosure.high_s / enclosure.low_s - 1.0;
  }
};

TEST(StrokeEnclosure, HoldsTheTimesOfRandomLines) {
  Draw draw;
  Tally fills, empties;
  for (int i = 0; i < kDraws && !HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    const std::vector<FlowElement> elements = draw.Elements();
    const double factor = draw.Between(0.7, 1.1), temperature_k = draw.Between(270.0, 320.0);
    const Chamber chamber = draw.Room();
    const Series series = MakeSeries(elements, factor);
    const double from_pa = chamber.ambient_pressure_pa, top_pa = chamber.operating_pressure_pa;

    const double source_pa = top_pa * draw.Log(1.0005, 5.0);
    const double to_pa = draw.Between(from_pa, top_pa);
    const double limit =
        i % 3 == 0 ? series.choked_flow_m3_per_s_pa * draw.Between(0.3, 1.2) : kNever;
    const CurveNodes fill = MarchNodes(elements, factor, top_pa / source_pa, limit);
    for (double target_pa : {to_pa, top_pa})
      fills.Add(EncloseFillTime(fill, chamber, source_pa, from_pa, target_pa, temperature_k),
                FillTime(series, chamber, source_pa, from_pa, target_pa, temperature_k,
                         limit * source_pa));

    const double low_pa = from_pa + (top_pa - from_pa) * draw.Log(0.02, 0.9);
    const CurveNodes exhaust = MarchNodes(elements, factor, from_pa / low_pa);
    empties.Add(EncloseEmptyTime(exhaust, chamber, top_pa, low_pa, temperature_k),
                EmptyTime(series, chamber, top_pa, low_pa, temperature_k));
  }
  for (const Tally& tally : {fills, empties}) {
    std::printf("%d of %d known, %.4f apart\n", tally.known, tally.all, tally.apart / tally.known);
    EXPECT_GT(tally.known, 0.95 * tally.all);
    EXPECT_LT(tally.apart, 0.04 * tally.known);
  }
}

// Without critical ratios they are the times.
TEST(StrokeEnclosure, ClosedFormsHoldTheTimesFromAbove) {
  Draw draw;
  double fills = 0.0, empties = 0.0;
  const auto add = [](double most_s, double seconds, bool exact, double& above) {
    ASSERT_GE(most_s, seconds);
    ASSERT_LE(most_s, exact ? seconds * (1.0 + 1e-5) : kNever);
    above += most_s / seconds - 1.0;
  };
  for (int i = 0; i < kDraws && !HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    std::vector<FlowElement> elements = draw.Elements();
    const bool exact = i % 4 == 0;
    if (exact)
      for (FlowElement& element : elements) element.critical_ratio = 0.0;
    const double factor = draw.Between(0.7, 1.1), temperature_k = draw.Between(270.0, 320.0);
    const Chamber chamber = draw.Room();
    const Series series = MakeSeries(elements, factor);
    const double from_pa = chamber.ambient_pressure_pa, top_pa = chamber.operating_pressure_pa;
    const double source_pa = top_pa * draw.Log(1.0005, 5.0);
    const double to_pa = draw.Between(1.001 * from_pa, top_pa);
    add(FillTimeAtMost(elements, factor, chamber, source_pa, from_pa, to_pa, temperature_k),
        FillTime(series, chamber, source_pa, from_pa, to_pa, temperature_k), exact, fills);
    const double low_pa = from_pa + (top_pa - from_pa) * draw.Log(0.02, 0.9);
    add(EmptyTimeAtMost(elements, factor, chamber, top_pa, low_pa, temperature_k),
        EmptyTime(series, chamber, top_pa, low_pa, temperature_k), exact, empties);
    // A limit that the line may come to.
    const double limit_m3_per_s =
        series.choked_flow_m3_per_s_pa * source_pa * draw.Between(0.3, 1.2);
    ASSERT_GE(FillTimeAtMost(elements, factor, chamber, source_pa, from_pa, to_pa, temperature_k,
                             limit_m3_per_s),
              FillTime(series, chamber, source_pa, from_pa, to_pa, temperature_k, limit_m3_per_s));
  }
  EXPECT_LT(fills, 0.3 * kDraws);
  EXPECT_LT(empties, 0.3 * kDraws);
}

TEST(StrokeEnclosure, KnowsNothingOfOtherCurvesAndTables) {
  FlowElement element{.sonic_conductance_m3_per_s_pa = 1e-8, .critical_ratio = 0.3};
  Chamber chamber;
  chamber.rest_volume_m3 = 1e-4;
  chamber.expansion_ratio = 2.0;
  chamber.operating_pressure_pa = 2e5;
  const auto known = [&] {
    const CurveNodes nodes = MarchNodes({{element}}, 1.0, 2.0 / 3.0);
    const bool above =
        std::isfinite(FillTimeAtMost({{element}}, 1.0, chamber, 3e5, 1e5, 2e5, 293.15));
    EXPECT_EQ(std::isfinite(EmptyTimeAtMost({{element}}, 1.0, chamber, 2e5, 1.2e5, 293.15)), above);
    EXPECT_EQ(std::isfinite(EncloseFillTime(nodes, chamber, 3e5, 1e5, 2e5, 293.15).high_s), above);
    return above;
  };
  EXPECT_TRUE(known());
  element.subsonic_index = 0.6;
  EXPECT_FALSE(known());
  element.subsonic_index = 0.5;
  chamber.volume_curve = MonotoneCurve({1e5, 2e5}, {1e-4, 2e-4});
  EXPECT_FALSE(known());
}

}  // namespace stroke_enclosure_test
}  // namespace plenum::model
