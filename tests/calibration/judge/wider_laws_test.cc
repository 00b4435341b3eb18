// Heat to a wall that warms holds heat to one that stays as it is as its limit.
#include "calibration/judge/wider_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "calibration/judge/ties.h"
#include "tests/calibration/bench.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace wider_laws_test {

using model::FindEffect;

// Two runs that the model itself made with these effects, and noise.
Dataset Made(const std::vector<model::Effect>& effects, double noise_pa) {
  Dataset dataset;
  dataset.runs = {test::DeclaredRun("low", 2.6e5, false), test::DeclaredRun("high", 3.4e5, false)};
  const ForwardModel forward(dataset);
  ModelState state = forward.Declared();
  state.effects = effects;
  for (std::size_t r = 0; r < dataset.runs.size(); ++r) {
    Run& run = dataset.runs[r];
    run.pressure_pa = forward.Predict(r, state, {}, {}).reading.pressure_pa;
    const std::vector<double> noise = test::WhiteNoise(7 + r, run.t_s.size(), noise_pa);
    for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
  }
  return dataset;
}

struct Fitted {
  explicit Fitted(const Dataset& measured)
      : dataset(measured),
        forward(dataset),
        observed(Observe(dataset)),
        bench{dataset, forward, observed, {}, {}, OriginalsOf(dataset), {}} {
    bench.data.forward = &forward;
    bench.data.observed = &observed;
    bench.data.sizes = SizesOf(dataset);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i) bench.data.runs.push_back(i);
    for (const char* id : {"heat_transfer", "wall_heat"}) {
      Contender contender{.effects = {FindEffect(id)}, .fit = {}};
      std::vector<model::Effect> starts = EffectStarts(*FindEffect(id), bench.data.sizes);
      if (contenders.size() == 1u) {  // and the limit
        const double time_constant_s = contenders[0].fit.state.effects[0].parameters[0];
        starts.push_back({FindEffect(id), {time_constant_s, 1e5, 0.05}});
      }
      for (const model::Effect& start : starts) {
        ModelState state = forward.Declared();
        state.effects = {start};
        Fit fit = FitModel(bench.data, state, {});
        Narrow(bench.data, {}, fit);
        if (!contender.fit.Usable() || fit.chi2_data < contender.fit.chi2_data)
          contender.fit = std::move(fit);
      }
      contenders.push_back(std::move(contender));
    }
  }
  const Contender& heat() const { return contenders[0]; }
  const Contender& wall() const { return contenders[1]; }

  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  Bench bench;
  std::vector<Contender> contenders;
};

TEST(WiderIn, IsALawOfTheSameEquationWithTheSameNumbersAndMore) {
  const auto* heat = FindEffect("heat_transfer");
  const auto* wall = FindEffect("wall_heat");
  const auto* lag = FindEffect("sensor_lag");  // whose only number has the same name
  const auto* gain = FindEffect("sensor_gain");
  EXPECT_EQ(WiderIn({wall}, {heat}), wall);
  EXPECT_EQ(WiderIn({wall, gain}, {heat, gain}), wall);
  EXPECT_EQ(WiderIn({heat}, {wall}), nullptr);
  EXPECT_EQ(WiderIn({wall}, {lag}), nullptr);
  EXPECT_EQ(WiderIn({wall, gain}, {heat, lag}), nullptr);
  EXPECT_EQ(WiderIn({wall, gain}, {heat}), nullptr);
}

TEST(StandsAtLimitAlone, AWallThatWouldHaveBeenSeen) {
  const Fitted fitted(Made({{FindEffect("heat_transfer"), {0.2}}}, test::kBenchNoisePa));
  EXPECT_TRUE(StandsAtLimitAlone(fitted.bench, fitted.wall(), fitted.heat(), 1.0));
  EXPECT_FALSE(StandsAtLimitAlone(fitted.bench, fitted.heat(), fitted.wall(), 1.0));
  EXPECT_EQ(TiedWith(fitted.bench, fitted.contenders, fitted.heat(), 1.0, 1e3).size(), 1u);
}

TEST(StandsAtLimitAlone, NotAWallThatIsThere) {
  const Fitted fitted(Made({{FindEffect("wall_heat"), {0.2, 1.0, 0.0}}}, test::kBenchNoisePa));
  EXPECT_LT(fitted.wall().fit.bic, fitted.heat().fit.bic - 10.0);
  EXPECT_FALSE(StandsAtLimitAlone(fitted.bench, fitted.wall(), fitted.heat(), 1.0));
}

// What little heat passes, any wall can hold.
TEST(StandsAtLimitAlone, NotWhereTheDataCouldNotHaveShownIt) {
  const Fitted fitted(Made({{FindEffect("heat_transfer"), {1e4}}}, test::kBenchNoisePa));
  EXPECT_FALSE(StandsAtLimitAlone(fitted.bench, fitted.wall(), fitted.heat(), 1.0));
  EXPECT_EQ(TiedWith(fitted.bench, fitted.contenders, fitted.heat(), 1.0, 1e3).size(), 2u);
}

}  // namespace wider_laws_test
}  // namespace plenum::calibration
