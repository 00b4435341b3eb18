// Runs of several pieces of the actuator: each piece has its own volume and expansion ratio.
#include "calibration/values/specimens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "calibration/diagnose.h"
#include "calibration/fit/fit.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace specimens_test {

using test::EffectRig;

constexpr auto kVolume = static_cast<std::size_t>(Declared::kRestVolume);
constexpr auto kExpansion = static_cast<std::size_t>(Declared::kExpansionRatio);

struct Piece {
  std::string name;
  double volume = 1.0;  // over what is declared
};

// Of each piece a free run and a blocked one; of those held out a free one alone. Volumes are
// declared to 10 %, the conductance to 1 %.
Dataset BenchOf(const std::vector<Piece>& pieces, const std::vector<Piece>& held_out = {},
                const test::Change& more = {}) {
  Dataset dataset;
  std::uint64_t seed = 700;
  const auto add = [&](const Piece& piece, double source_pa, bool blocked) {
    const std::string id = "r" + std::to_string(dataset.runs.size() + 1);
    Run run = test::DeclaredRun(id, source_pa, blocked);
    const auto change = [&](EffectRig& rig) {
      rig.rest_volume_m3 *= piece.volume;
      if (more) more(rig);
    };
    test::Measure(change, ++seed, test::kBenchNoisePa, run);
    const auto known = std::find(dataset.specimens.begin(), dataset.specimens.end(), piece.name);
    run.specimen = static_cast<std::size_t>(known - dataset.specimens.begin());
    if (known == dataset.specimens.end()) dataset.specimens.push_back(piece.name);
    dataset.runs.push_back(run);
    return id;
  };
  for (const Piece& piece : pieces) {
    add(piece, 3e5, false);
    add(piece, 2.8e5, true);
  }
  for (const Piece& piece : held_out) dataset.holdout.push_back(add(piece, 3.2e5, false));
  dataset.relative_uncertainty[kVolume] = 0.1;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = 0.01;
  return dataset;
}

// The estimates of the rest volume, by the specimen's name.
std::map<std::string, Estimate> VolumesOf(const Diagnosis& diagnosis, const Dataset& dataset) {
  std::map<std::string, Estimate> volumes;
  for (const FittedFactor& fitted : diagnosis.fitted)
    if (fitted.number == Declared::kRestVolume && fitted.specimen)
      volumes[dataset.specimens[*fitted.specimen]] = fitted.factor;
  return volumes;
}

void ExpectFound(const Diagnosis& diagnosis, const Dataset& dataset,
                 const std::vector<Piece>& pieces) {
  const auto volumes = VolumesOf(diagnosis, dataset);
  ASSERT_EQ(volumes.size(), pieces.size());
  for (const Piece& piece : pieces) {
    const Estimate& found = volumes.at(piece.name);
    EXPECT_LE(found.low, piece.volume) << piece.name;
    EXPECT_GE(found.high, piece.volume) << piece.name;
    EXPECT_LT(found.high - found.low, 0.05) << piece.name;
  }
}

TEST(Specimens, OfUnlikeVolumesAreEachFound) {
  const std::vector<Piece> pieces = {{"a", 0.9}, {"b", 1.0}, {"c", 1.1}};
  const Dataset dataset = BenchOf(pieces);
  const Diagnosis diagnosis = Diagnose(dataset, {});
  EXPECT_EQ(diagnosis.verdict, Verdict::kAdequate) << diagnosis.sentence;
  ExpectFound(diagnosis, dataset, pieces);
  EXPECT_LT(diagnosis.after.rms_pa, 1.1 * test::kBenchNoisePa);
}

// Recorded, not demanded: without their names the pieces are one, and structure is left.
TEST(Specimens, WithoutTheirNamesFitWorse) {
  Dataset dataset = BenchOf({{"a", 0.9}, {"b", 1.1}});
  const Diagnosis named = Diagnose(dataset, {});
  for (auto& run : dataset.runs) run.specimen = 0;
  dataset.specimens.clear();
  const Diagnosis one = Diagnose(dataset, {});
  EXPECT_EQ(named.verdict, Verdict::kAdequate) << named.sentence;
  EXPECT_GT(one.before.rms_pa, 2.0 * named.before.rms_pa);
  RecordProperty("verdict_without_names", one.sentence);
}

// Volumes far from what is declared to 1 % are wrong numbers of each piece.
TEST(Specimens, FarFromWhatIsDeclaredAreWrongEach) {
  const std::vector<Piece> pieces = {{"a", 0.8}, {"b", 1.25}};
  Dataset dataset = BenchOf(pieces);
  dataset.relative_uncertainty[kVolume] = 0.01;
  const Diagnosis diagnosis = Diagnose(dataset, {});
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.effects.empty());
  ASSERT_EQ(diagnosis.numbers.size(), 2u) << diagnosis.sentence;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_EQ(diagnosis.numbers[k].specimen, pieces[k].name);
    EXPECT_NEAR(diagnosis.numbers[k].factor, pieces[k].volume, 0.01);
  }
  EXPECT_NE(diagnosis.sentence.find("rest_volume of a is"), std::string::npos)
      << diagnosis.sentence;
}

// Each piece one run alone: a delay of the valve is found, and held out in turn by runs whose own
// volumes they tell themselves.
TEST(Specimens, OfOneRunEachShowAnEffectOfTheRig) {
  Dataset dataset = BenchOf({{"a", 0.92}, {"b", 1.0}, {"c", 1.08}}, {},
                            [](EffectRig& rig) { rig.valve_delay_s = 0.05; });
  std::erase_if(dataset.runs, [](const auto& run) { return run.blocked; });
  const Diagnosis diagnosis = Diagnose(dataset, {});
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects.front().effect.spec->id, "valve_delay");
  ExpectFound(diagnosis, dataset, {{"a", 0.92}, {"b", 1.0}, {"c", 1.08}});
  ASSERT_TRUE(diagnosis.after.holdout_rms_pa.has_value());
  EXPECT_LT(*diagnosis.after.holdout_rms_pa, 2.0 * test::kBenchNoisePa);
}

TEST(Specimens, HeldOutOfAKnownOneHaveItsVolumeAndOfAnotherTheMean) {
  const Dataset dataset = BenchOf({{"a", 0.9}, {"b", 1.06}}, {{"b", 1.06}, {"c", 1.04}});
  const Diagnosis diagnosis = Diagnose(dataset, {});
  EXPECT_EQ(diagnosis.verdict, Verdict::kAdequate) << diagnosis.sentence;
  const auto volumes = VolumesOf(diagnosis, dataset);
  ASSERT_EQ(volumes.size(), 2u);
  const std::vector<Factors>& by_run = diagnosis.models.after.run_factor;
  const double mean = 0.5 * (volumes.at("a").value + volumes.at("b").value);
  EXPECT_NEAR(by_run[0][kVolume], volumes.at("a").value, 1e-12);
  EXPECT_NEAR(by_run[4][kVolume], volumes.at("b").value, 1e-12);
  EXPECT_NEAR(by_run[5][kVolume], mean, 1e-12);
  EXPECT_NEAR(diagnosis.models.after.state.factor[kVolume], mean, 1e-12);
  const std::string told =
      "r6 is of c, of which no fit saw a run: it has the mean rest_volume of the other specimens";
  EXPECT_EQ(std::count(diagnosis.warnings.begin(), diagnosis.warnings.end(), told), 1);
  const auto rms = [&](const std::string& id) {
    for (const auto& [run, rms_pa] : diagnosis.after.run_rms_pa)
      if (run == id) return rms_pa;
    return 0.0;
  };
  EXPECT_LT(rms("r5"), 1.5 * test::kBenchNoisePa);
  EXPECT_GT(rms("r6"), 3.0 * test::kBenchNoisePa);
}

TEST(Specimens, RenamedAndInAnotherOrderAreTheSame) {
  const std::vector<Piece> pieces = {{"a", 0.9}, {"b", 1.1}};
  const Dataset dataset = BenchOf(pieces);
  Dataset turned = dataset;
  turned.specimens = {"piece 2", "piece 1"};
  for (auto& run : turned.runs) run.specimen = 1 - run.specimen;
  std::reverse(turned.runs.begin(), turned.runs.end());
  const Diagnosis one = Diagnose(dataset, {}), other = Diagnose(turned, {});
  EXPECT_EQ(one.verdict, other.verdict);
  EXPECT_NEAR(one.after.rms_pa, other.after.rms_pa, 1e-4 * one.after.rms_pa);
  const auto volumes = VolumesOf(one, dataset), again = VolumesOf(other, turned);
  for (const auto& [name, renamed] : {std::pair{"a", "piece 1"}, std::pair{"b", "piece 2"}}) {
    const Estimate &before = volumes.at(name), &after = again.at(renamed);
    EXPECT_NEAR(before.value, after.value, 1e-4);
    EXPECT_NEAR(before.low, after.low, 1e-4);
    EXPECT_NEAR(before.high, after.high, 1e-4);
  }
}

TEST(Specimens, OneNamedEverywhereIsNone) {
  Dataset dataset = BenchOf({{"a", 1.06}});
  const Diagnosis named = Diagnose(dataset, {});
  dataset.specimens.clear();
  const Diagnosis unnamed = Diagnose(dataset, {});
  EXPECT_EQ(named.sentence, unnamed.sentence);
  EXPECT_EQ(named.after.rms_pa, unnamed.after.rms_pa);
  EXPECT_EQ(named.covariance, unnamed.covariance);
  ASSERT_EQ(named.fitted.size(), unnamed.fitted.size());
  for (std::size_t k = 0; k < named.fitted.size(); ++k) {
    EXPECT_EQ(named.fitted[k].factor.value, unnamed.fitted[k].factor.value);
    EXPECT_EQ(named.fitted[k].factor.high, unnamed.fitted[k].factor.high);
    EXPECT_FALSE(named.fitted[k].specimen.has_value());
  }
}

// An exact number is that of all, and is wrong for all; of an uncertain one each piece has its own.
TEST(Specimens, ShareANumberThatIsExact) {
  Dataset dataset = BenchOf({{"a", 1.0}, {"b", 1.0}});
  dataset.relative_uncertainty[kVolume] = 0.0;
  const ForwardModel forward(dataset);
  const std::vector<std::size_t> runs = {0, 1, 2, 3};
  Freed freed{};
  freed[kVolume] = true;
  const auto of_volume = [&](const std::vector<Coordinate>& coordinates) {
    return std::count_if(coordinates.begin(), coordinates.end(), [](const Coordinate& one) {
      return one.parameter.kind == Parameter::Kind::kDeclared &&
             one.parameter.declared == Declared::kRestVolume;
    });
  };
  EXPECT_EQ(of_volume(BaseCoordinates(forward, runs, false)), 0);
  EXPECT_EQ(of_volume(BaseCoordinates(forward, runs, false, freed)), 1);
  ModelState state = forward.Declared();
  SetFactor(Declared::kRestVolume, 1.2, state);
  EXPECT_EQ(FactorsOf(dataset.runs[0], state), FactorsOf(dataset.runs[2], state));
  dataset.relative_uncertainty[kVolume] = kUnknown;
  EXPECT_EQ(of_volume(BaseCoordinates(ForwardModel(dataset), runs, false)), 2);
}

// Derivatives to the numbers of one piece against differences, and none in runs of another; also of
// an actuator with a table of volumes.
TEST(Specimens, HaveDerivativesInTheirOwnRunsAlone) {
  Dataset dataset = BenchOf({{"a", 1.0}, {"b", 1.0}});
  dataset.relative_uncertainty[kExpansion] = 0.1;
  for (const bool table : {false, true}) {
    if (table)
      for (auto& run : dataset.runs)
        run.chamber.volume_curve =
            model::MonotoneCurve({1e5, 1.5e5, 2e5, 3e5}, {50e-6, 70e-6, 90e-6, 110e-6});
    const ForwardModel forward(dataset);
    ModelState state = forward.Declared();
    state.specimen_factor[kVolume] = {0.9, 1.1};
    const std::vector<Parameter> parameters = {{.declared = Declared::kRestVolume, .specimen = 0},
                                               {.declared = Declared::kRestVolume, .specimen = 1}};
    const PredictOptions options{.relative_tolerance = 1e-8};
    const Prediction at = forward.Predict(2, state, parameters, options);
    ModelState moved = state;
    NumberOf(moved, parameters[1]) += 1e-4;
    const Prediction there = forward.Predict(2, moved, {}, options);
    ASSERT_EQ(at.status, model::SimulateStatus::kDone) << at.detail;
    EXPECT_TRUE(at.derivatives[0].pressure_pa.empty());
    for (const std::size_t i : {20u, 50u, 100u, 150u}) {
      const double slope = (there.reading.pressure_pa[i] - at.reading.pressure_pa[i]) / 1e-4;
      EXPECT_NEAR(at.derivatives[1].pressure_pa[i], slope, 1e-2 * std::abs(slope) + 20.0) << i;
    }
  }
}

TEST(Specimens, ScatterAsTheyDifferAndNotLessThanDeclared) {
  const Dataset dataset = BenchOf({{"a", 1.0}, {"b", 1.0}});
  ModelState state = ForwardModel(dataset).Declared();
  state.specimen_factor[kVolume] = {0.8, 1.2};
  const std::vector<std::size_t> all = {0, 1, 2, 3}, of_a = {0, 1};
  EXPECT_NEAR(ScatterOf(dataset, all, state, Declared::kRestVolume),
              0.4 / std::sqrt(2.0) * std::sqrt(1.5), 1e-12);
  EXPECT_EQ(ScatterOf(dataset, of_a, state, Declared::kRestVolume), 0.1);
  EXPECT_EQ(MeanFactor(dataset, of_a, state, Declared::kRestVolume), 0.8);
  EXPECT_EQ(UntoldNumbers(dataset, of_a, 2), std::vector{Declared::kRestVolume});
  EXPECT_TRUE(UntoldNumbers(dataset, all, 2).empty());
  TakeMeans(dataset, of_a, state);
  EXPECT_EQ(state.specimen_factor[kVolume], (std::vector{0.8, 0.8}));
}

}  // namespace specimens_test
}  // namespace plenum::calibration
