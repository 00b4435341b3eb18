// Natural ties, made by the independent simulator: the proposed run must decide them whichever side
// is true, although the rival may fit itself to it.
#include "calibration/experiment/experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/calibration/noise/processes.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::calibration {
namespace experiment_test {

using model::ValveState;
using test::EffectRig;

constexpr double kNoisePa = 200.0;
constexpr double kUnitC = 1e-8;  // of a sonic conductance, m³/(s·Pa) per dm³/(s·bar)

// One side of a tie: the effect to fit, and the same made true on the bench.
struct Side {
  std::string id, law;
  std::function<void(EffectRig&)> make_true;
};

struct Tie {
  std::string name;
  std::vector<Side> sides;
  std::vector<model::ValveCommand> schedule;
  double end_s, spacing_s;
  std::array<double, kDeclaredCount> uncertainty{};
};

void PrintTo(const Tie& tie, std::ostream* out) { *out << tie.name; }

EffectRig BenchOf(const calibration::Run& run) {
  EffectRig rig;
  rig.blocked = run.blocked;
  rig.initial_pa = run.initial_pressure_pa.value_or(1e5);
  rig.source_pa = run.source_pressure_pa;
  rig.fill = rig.exhaust = {{0.05 * kUnitC, 0.3}};
  for (const model::ValveCommand& command : run.valve)
    rig.schedule.push_back({command.time_s, command.state == ValveState::kInflate   ? 1
                                            : command.state == ValveState::kDeflate ? -1
                                                                                    : 0});
  return rig;
}

// Readings of the run on a bench with that side true.
void Measure(Run& run, const Side& truth, std::uint64_t seed) {
  EffectRig rig = BenchOf(run);
  truth.make_true(rig);
  run.pressure_pa = test::SimulateEffects(rig, run.t_s, 5e-4).measured_pa;
  const std::vector<double> noise = test::WhiteNoise(seed, run.t_s.size(), kNoisePa);
  for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
}

Run MakeRun(const std::string& id, double source_pa, const Tie& tie) {
  Run run;
  run.id = id;
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  const model::FlowElement pair{0.05 * kUnitC, 0.3};
  run.line = {{pair, pair, {}}};
  run.supply = Supply::kRegulated;
  run.source_pressure_pa = source_pa;
  run.initial_pressure_pa = 1e5;
  run.valve = tie.schedule;
  for (double t_s = 0.0; t_s < tie.end_s; t_s += tie.spacing_s) run.t_s.push_back(t_s);
  return run;
}

// Fits of every side to a data set.
struct Fitted {
  explicit Fitted(const Dataset& dataset, const Tie& tie)
      : forward(dataset), observed(Observe(dataset)) {
    data.forward = &forward;
    data.observed = &observed;
    data.sizes = SizesOf(dataset);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i) data.runs.push_back(i);
    for (const Side& side : tie.sides) {
      Fit best;
      for (const model::Effect& start :
           EffectStarts(*model::FindEffect(side.id, side.law), data.sizes)) {
        ModelState state = forward.Declared();
        state.effects = {start};
        Fit fit = FitModel(data, state, {});
        if (!best.Usable() || fit.chi2_data < best.chi2_data) best = std::move(fit);
      }
      fits.push_back(std::move(best));
    }
  }
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  FitData data;
  std::vector<Fit> fits;
};

class NaturalTie : public ::testing::TestWithParam<Tie> {};

TEST_P(NaturalTie, IsDecidedByTheProposedRunWhicheverSideIsTrue) {
  const Tie& tie = GetParam();
  for (std::size_t truth = 0; truth < tie.sides.size(); ++truth) {
    SCOPED_TRACE(tie.sides[truth].id + " true");
    Dataset dataset;
    dataset.relative_uncertainty = tie.uncertainty;
    dataset.runs = {MakeRun("r1", 3e5, tie), MakeRun("r2", 2.6e5, tie)};
    for (std::size_t i = 0; i < 2; ++i) Measure(dataset.runs[i], tie.sides[truth], 10 * truth + i);
    const Fitted before(dataset, tie);
    std::vector<TiedFit> tied;
    for (std::size_t k = 0; k < tie.sides.size(); ++k) {
      ASSERT_TRUE(before.fits[k].Usable()) << before.fits[k].detail;
      tied.push_back({{tie.sides[k].id}, &before.fits[k]});
      EXPECT_LT(std::abs(before.fits[k].chi2_data - before.fits[truth].chi2_data), 12.0)
          << "no tie: " << tie.sides[k].id;
    }
    const auto experiment = DesignExperiment(before.data, tied, {});
    ASSERT_TRUE(experiment.has_value());
    EXPECT_GE(experiment->expected_delta_bic, kDecisiveDeltaBic) << experiment->why;
    EXPECT_GT(experiment->expected_difference_pa, 0.0);
    EXPECT_TRUE(experiment->measure.empty()) << experiment->measure.front();
    RecordProperty("why", experiment->why);

    dataset.runs.push_back(experiment->run);
    Measure(dataset.runs.back(), tie.sides[truth], 77 + truth);
    const Fitted after(dataset, tie);
    for (std::size_t k = 0; k < tie.sides.size(); ++k) {
      if (k == truth) continue;
      EXPECT_GT(after.fits[k].bic - after.fits[truth].bic, 10.0)
          << tie.sides[k].id << ": " << experiment->why;
    }
  }
}

std::vector<Tie> Ties() {
  const auto leak = [](EffectRig& rig) { rig.leak = test::OrificeLeak{0.0004 * kUnitC, 0.3}; };
  const auto creep = [](EffectRig& rig) { rig.creep = test::Creep{0.08, 2.0}; };
  const auto delay = [](EffectRig& rig) { rig.valve_delay_s = 0.012; };
  const auto ramp = [](EffectRig& rig) { rig.valve_ramp_s = 0.024; };
  const auto lag = [](EffectRig& rig) { rig.sensor_lag_s = 0.012; };
  const auto gain = [](EffectRig& rig) { rig.sensor_gain = 1.012; };
  const auto bent = [](EffectRig& rig) { rig.compliance = test::Compliance{0.04, 0.0}; };
  const auto dead = [](EffectRig& rig) { rig.dead_volume_m3 = 3e-6; };
  const auto one_way = [](EffectRig& rig) { rig.fill_factor = 0.97; };
  using enum ValveState;
  return {
      {"leak or creep in a short hold",
       {{"leak", "orifice", leak}, {"creep", "", creep}},
       {{0.1, kInflate}, {0.8, kHold}},
       1.1,
       0.01,
       {0, 0, 0, 0, 0.03}},
      {"delay, ramp or lag in a rise of few samples",
       {{"valve_delay", "", delay}, {"valve_ramp", "", ramp}, {"sensor_lag", "", lag}},
       {{0.1, kInflate}},
       0.9,
       0.05,
       {0, 0, 0, 0, 0.03}},
      {"gain or bent compliance in a rise",
       {{"sensor_gain", "", gain}, {"nonlinear_compliance", "", bent}},
       {{0.1, kInflate}, {0.5, kDeflate}},
       0.9,
       0.02,
       {0.03, 0.03, 0.03, 0, 0.05}},
      {"dead volume or a conductance of its own in a rise",
       {{"dead_volume", "", dead}, {"directional_conductance", "", one_way}},
       {{0.1, kInflate}},
       0.9,
       0.02,
       {}},
  };
}

INSTANTIATE_TEST_SUITE_P(Ties, NaturalTie, ::testing::ValuesIn(Ties()));

// Two sets that no run parts must not hide which run parts the third from both.
TEST(DesignExperiment, PartsWhatCanBeParted) {
  const Tie tie = Ties().front();
  Dataset dataset;
  dataset.relative_uncertainty = tie.uncertainty;
  dataset.runs = {MakeRun("r1", 3e5, tie), MakeRun("r2", 2.6e5, tie)};
  for (std::size_t i = 0; i < 2; ++i) Measure(dataset.runs[i], tie.sides[0], i);
  const Fitted before(dataset, tie);
  const std::vector<TiedFit> tied = {
      {{"leak"}, &before.fits[0]}, {{"creep"}, &before.fits[1]}, {{"twin"}, &before.fits[1]}};
  const auto experiment = DesignExperiment(before.data, tied, {});
  ASSERT_TRUE(experiment.has_value());
  EXPECT_LT(experiment->expected_delta_bic, kDecisiveDeltaBic) << experiment->why;
  dataset.runs.push_back(experiment->run);
  Measure(dataset.runs.back(), tie.sides[0], 77);
  const Fitted after(dataset, tie);
  EXPECT_GT(after.fits[1].bic - after.fits[0].bic, kDecisiveDeltaBic) << experiment->why;
}

TEST(DesignExperiment, NeedsTwoFits) {
  const Tie tie = Ties().front();
  Dataset dataset;
  dataset.runs = {MakeRun("r1", 3e5, tie)};
  Measure(dataset.runs.front(), tie.sides.front(), 1);
  const Fitted fitted(dataset, tie);
  EXPECT_FALSE(DesignExperiment(fitted.data, {{{"leak"}, &fitted.fits[0]}}, {}).has_value());
  EXPECT_FALSE(DesignExperiment(fitted.data, {}, {}).has_value());
}

}  // namespace experiment_test
}  // namespace plenum::calibration
