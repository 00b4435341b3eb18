// What a first look at a set must not be taken for.
#include "calibration/search/contenders.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "calibration/search/effect_search.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace contenders_test {

// A chamber that empties through a clogged exhaust. Without it the declared numbers fit only beyond
// their uncertainties, so that fits with an effect start from what was declared, far off.
Dataset Emptied() {
  Dataset dataset;
  for (const double initial_pa : {1.9e5, 1.6e5}) {
    Run run = test::DeclaredRun("emptied", 1e5, true);
    run.supply = Supply::kNone;
    run.initial_pressure_pa = initial_pa;
    run.valve = {{0.0, model::ValveState::kHold}, {0.2, model::ValveState::kDeflate}};
    run.t_s.clear();
    for (int i = 0; i <= 80; ++i) run.t_s.push_back(0.02 * i);
    test::Measure(
        [&](test::EffectRig& rig) {
          rig.source = test::EffectRig::Source::kNone;
          rig.initial_pa = initial_pa;
          rig.exhaust_restriction = test::ExhaustRestriction{0.6 * test::kBenchConductance, 0.25};
        },
        3, 150.0, run);
    dataset.runs.push_back(run);
  }
  dataset.runs[1].id = "emptied again";
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.01;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = 0.1;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kCriticalRatio)] = 0.1;
  return dataset;
}

struct Bench {
  explicit Bench(Dataset measured = Emptied()) : dataset(std::move(measured)) {
    data.forward = &forward;
    data.observed = &observed;
    data.runs = {0, 1};
    data.sizes = SizesOf(dataset);
  }
  Bench(const Bench&) = delete;
  const Dataset dataset;
  const ForwardModel forward{dataset};
  const std::vector<ObservedRun> observed = Observe(dataset);
  FitData data;
};

TEST(Contenders, NoneIsGivenUpWhileWorseThanWhatItContains) {
  const Bench bench;
  const SearchOptions options;
  Contenders sets(bench.data, options);
  sets.FitBase();
  EXPECT_FALSE(PriorsHold(sets.Base().fit));
  std::vector<Contenders::Job> jobs;
  const EffectSet named = NamedEffects(bench.dataset.runs);
  for (const model::EffectSpec* spec : named) sets.AddJobs(sets.Base(), spec, jobs);
  sets.RunJobs(jobs, 0.0, 1.0, "single effects");
  const double base = sets.Base().fit.bic;
  for (const model::EffectSpec* spec : named) {
    for (const char* id : {"exhaust_restriction", "dead_volume", "sensor_offset", "sensor_gain"})
      if (spec->id == id) {
        EXPECT_LT(sets.Find({spec})->fit.bic, base + 20.0) << id;
      }
  }
}

// With the BIC known that a set must come to, those near it are fitted as well as without; of the
// others some are left before they converge.
TEST(Contenders, WhatCannotComeToItsGoalIsNotTakenFurther) {
  const Bench bench(test::MeasuredBench(
      [](test::EffectRig& rig) {
        rig.leak = test::OrificeLeak{3e-11, 0.3};
      },
      29));
  const SearchOptions options;
  Contenders without(bench.data, options), with(bench.data, options);
  const EffectSet named = NamedEffects(bench.dataset.runs);
  for (Contenders* sets : {&without, &with}) {
    std::vector<Contenders::Job> jobs;
    sets->FitBase();
    for (const model::EffectSpec* spec : named) sets->AddJobs(sets->Base(), spec, jobs);
    std::optional<double> goal;
    if (sets == &with) goal = without[*without.Best(1)].fit.bic;
    sets->RunJobs(jobs, 0.0, 1.0, "single effects", goal);
  }
  const Contender& found = without[*without.Best(1)];
  ASSERT_LT(found.fit.bic, without.Base().fit.bic - 100.0);
  EXPECT_EQ(with[*with.Best(1)].effects, found.effects);
  int left = 0;
  for (const Contender& contender : without.list) {
    const Fit& fit = with.Find(contender.effects)->fit;
    if (contender.fit.bic < found.fit.bic + 20.0) {
      EXPECT_NEAR(fit.bic, contender.fit.bic, 0.1);
    } else if (fit.status == FitStatus::kIterationsSpent) {
      left += contender.fit.status == FitStatus::kConverged;
    }
  }
  EXPECT_GT(left, 0);
}

TEST(Contenders, GoOnFromAnEarlierSearchWhereItFoundSomething) {
  const Bench bench;
  const SearchOptions options;
  Contenders before(bench.data, options);
  before.FitBase();
  std::vector<Contenders::Job> jobs;
  const EffectSet specs = {model::FindEffect("exhaust_restriction"), model::FindEffect("creep")};
  for (const model::EffectSpec* spec : specs) before.AddJobs(before.Base(), spec, jobs);
  const std::size_t starts = jobs.size() - 1;
  ASSERT_GT(starts, 1u) << "creep has several";
  before.RunJobs(jobs, 0.0, 1.0, "single effects");
  before.Find({specs[1]})->fit.bic = before.Base().fit.bic;

  Contenders sets(bench.data, options);
  sets.earlier = before.list;
  sets.FitBase();
  std::vector<Contenders::Job> again;
  sets.AddJobs(sets.Base(), specs[0], again);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].start.effects[0].parameters,
            before.Find({specs[0]})->fit.state.effects[0].parameters);
  sets.AddJobs(sets.Base(), specs[1], again);
  EXPECT_EQ(again.size(), 1u + starts);
}

// All effects are tried again only where the leading sets of the search before hold the answer.
TEST(Contenders, LeadBeforeAllAreTriedAgain) {
  const Bench bench;
  std::set<std::string> stages;
  SearchOptions options;
  options.clocks_may_be_off = false;
  options.progress = [&](double, const std::string& stage) { stages.insert(stage); };
  const auto never = [](const Fit&) { return false; };
  const auto clogged = [](const Fit& fit) {
    return !fit.state.effects.empty() && fit.state.effects[0].spec->id == "exhaust_restriction";
  };
  const SearchResult first = SearchEffects(bench.data, options, never);
  ASSERT_TRUE(first.complete);
  EXPECT_FALSE(first.enough);
  EXPECT_TRUE(stages.contains("single effects"));

  stages.clear();
  const SearchResult in_vain = SearchEffects(bench.data, options, never, first);
  EXPECT_FALSE(stages.contains("single effects"));
  EXPECT_FALSE(in_vain.enough);
  EXPECT_EQ(in_vain.contenders[in_vain.chosen].effects, first.contenders[first.chosen].effects);

  stages.clear();
  const SearchResult again = SearchEffects(bench.data, options, clogged, first);
  EXPECT_TRUE(stages.contains("single effects"));
  EXPECT_TRUE(again.enough);
}

}  // namespace contenders_test
}  // namespace plenum::calibration
