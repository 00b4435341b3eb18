// Several chambers in a model of the runs: derivatives against differences, sets of effects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "calibration/fit/forward.h"
#include "calibration/values/effect_sets.h"
#include "calibration/values/specimens.h"

namespace plenum::calibration {
namespace several_test {

LinePiece Pair(double conductance, double ratio) {
  const model::FlowElement pair{conductance, ratio};
  return {pair, pair, {}};
}

// A junction, from which a finger that swells and one that is all but rigid branch off; the second
// through a tube, with a vessel behind it. The gauge is in the finger `gauge`.
Run RunOf(std::size_t gauge) {
  Run run;
  run.id = "r";
  run.line = {Pair(0.05e-8, 0.3)};
  run.supply = Supply::kRegulated;
  run.source_pressure_pa = 2.6e5;
  run.valve = {{0.0, model::ValveState::kHold},
               {0.1, model::ValveState::kInflate},
               {0.7, model::ValveState::kHold},
               {1.5, model::ValveState::kDeflate}};
  const auto chamber = [](double rest_m3, double ratio) {
    return model::Chamber{.rest_volume_m3 = rest_m3,
                          .expansion_ratio = ratio,
                          .operating_pressure_pa = 2e5,
                          .volume_curve = {}};
  };
  LinePiece tube;
  tube.tube = {.inner_diameter_m = 1.5e-3, .length_m = 0.4};
  run.several.all = {{"", chamber(3e-6, 1.0), 0, {}, 0.0},
                     {"a", chamber(30e-6, 1.8), 0, {Pair(0.03e-8, 0.2)}, 0.0},
                     {"b", chamber(25e-6, 1.05), 0, {Pair(0.02e-8, 0.25), tube}, 0.0},
                     {"c", chamber(10e-6, 1.3), 2, {Pair(0.01e-8, 0.3)}, 500.0}};
  run.several.gauge = gauge;
  run.several.shot = "r";
  run.chamber = run.several.all[gauge].chamber;
  run.specimen = gauge - 1;
  run.initial_pressure_pa = 1.02e5;
  for (int i = 0; i <= 60; ++i) run.t_s.push_back(0.04 * i);
  run.pressure_pa.assign(run.t_s.size(), 1e5);
  return run;
}

Dataset Rig() {
  Dataset dataset;
  for (const std::size_t gauge : {1, 3}) dataset.runs.push_back(RunOf(gauge));
  dataset.specimens = {"a", "b", "c"};
  dataset.several = true;
  return dataset;
}

TEST(SeveralChambers, DerivativesAreThoseOfDifferences) {
  const Dataset dataset = Rig();
  const ForwardModel forward(dataset);
  ModelState state = forward.Declared();
  state.effects = {{&InChamber(*model::FindEffect("leak", "orifice"), 2), {2e-12, 0.3}},
                   {model::FindEffect("creep"), {0.1, 0.5}}};
  using Kind = Parameter::Kind;
  std::vector<Parameter> parameters = {{.declared = Declared::kRestVolume, .specimen = 0},
                                       {.declared = Declared::kRestVolume, .specimen = 2},
                                       {.declared = Declared::kExpansionRatio, .specimen = 1},
                                       {.declared = Declared::kSourcePressure},
                                       {.declared = Declared::kSonicConductance},
                                       {.declared = Declared::kCriticalRatio},
                                       {.declared = Declared::kTubeInnerDiameter},
                                       {.declared = Declared::kAmbientPressure},
                                       {.kind = Kind::kEffect, .effect = 0, .number = 0},
                                       {.kind = Kind::kEffect, .effect = 1, .number = 0},
                                       {.kind = Kind::kInitialPressure, .run = 0},
                                       {.kind = Kind::kInitialPressure, .run = 1}};
  const PredictOptions options{.relative_tolerance = 1e-9};
  for (std::size_t run = 0; run < dataset.runs.size(); ++run) {
    const Prediction at = forward.Predict(run, state, parameters, options);
    ASSERT_EQ(at.status, model::SimulateStatus::kDone) << at.detail;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      ModelState above = state, below = state;
      const double number = NumberOf(state, parameters[j]), step = 1e-4 * number;
      NumberOf(above, parameters[j]) += step, NumberOf(below, parameters[j]) -= step;
      const Reading up = forward.Predict(run, above, {}, options).reading;
      const Reading down = forward.Predict(run, below, {}, options).reading;
      // Of the root mean square: where two chambers come to one pressure the flow between them
      // bends, and beside that instant the derivative may be off by more for a sample or two.
      double largest = 0.0, squares = 0.0;
      for (std::size_t i = 0; i < up.pressure_pa.size(); ++i) {
        const std::vector<double>& slope = at.derivatives[j].pressure_pa;
        const double difference = (up.pressure_pa[i] - down.pressure_pa[i]) / 2e-4;
        const double exact = slope.empty() ? 0.0 : slope[i] * number;
        largest = std::max(largest, std::abs(difference));
        squares += std::pow(exact - difference, 2);
      }
      const double off = std::sqrt(squares / static_cast<double>(up.pressure_pa.size()));
      EXPECT_LE(off, 5e-3 * largest + 0.5) << "run " << run << ", parameter " << j;
      const bool other_start =
          parameters[j].kind == Kind::kInitialPressure && parameters[j].run != run;
      EXPECT_EQ(largest > 20.0, !other_start) << "run " << run << ", parameter " << j;
    }
  }
}

TEST(SeveralChambers, EachMayLeakAndHaveAnotherVolume) {
  const Dataset dataset = Rig();
  std::set<std::string> ids;
  for (const model::EffectSpec* spec : Nameable(dataset)) ids.insert(std::string(spec->id));
  for (const char* id : {"leak[1]", "leak[2]", "leak[3]", "number:rest_volume[1]",
                         "number:rest_volume[3]", "number:expansion_ratio[2]"})
    EXPECT_TRUE(ids.contains(id)) << id;
  for (const char* id : {"leak", "leak[4]", "number:rest_volume"})
    EXPECT_FALSE(ids.contains(id)) << id;
  Freed freed;
  Free(Freeing(Declared::kRestVolume, 1), freed);
  EXPECT_TRUE(freed.Holds(0, 1));
  EXPECT_FALSE(freed.Holds(0, 0));
  EXPECT_EQ(SpecsOf(freed), EffectSet{&Freeing(Declared::kRestVolume, 1)});
  EXPECT_EQ(FreedBy(Freeing(Declared::kExpansionRatio, 2)), Declared::kExpansionRatio);
  EXPECT_EQ(RecordingsOf(dataset, {0, 1}), 1u);
}

}  // namespace several_test
}  // namespace plenum::calibration
