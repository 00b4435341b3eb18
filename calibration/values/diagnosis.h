// What a diagnosis found, as a value: the errors before and after, the effects, the candidates, the
// verdict and what would decide between ties.
#ifndef PLENUM_CALIBRATION_VALUES_DIAGNOSIS_H_
#define PLENUM_CALIBRATION_VALUES_DIAGNOSIS_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"
#include "model/effects/effect.h"

namespace plenum::calibration {

// kAdequate: within the noise after the base fit. kExplained: one set of effects accounts for the
// residual. kTie: several sets, none containing another, do equally well. kUnexplained: structure
// remains that no known effect accounts for. kUndecided: a fit that matters did not converge or the
// time ran out; never passed off as one of the others.
enum class Verdict { kAdequate, kExplained, kTie, kUnexplained, kUndecided };

struct Estimate {
  double value = 0.0;
  double low = 0.0, high = 0.0;  // 95 %
  bool identified = true;        // false: the data do not fix it beyond what was declared
};

struct ErrorReport {
  double rms_pa = 0.0, peak_pa = 0.0;                      // of all fitted runs
  double rms_share = 0.0;                                  // of the operating gauge pressure
  std::optional<double> holdout_rms_pa;                    // of the runs held out
  std::vector<std::pair<std::string, double>> run_rms_pa;  // every run
};

struct FittedEffect {
  model::Effect effect;
  std::vector<Estimate> parameters;  // in the order of the effect's spec
};

// A number that the runs measure, in SI.
struct MeasuredEstimate {
  std::size_t number = 0;  // of Dataset::measured
  double declared = 0.0;
  double value = 0.0, low = 0.0, high = 0.0;  // 95 %
  double deviation = 0.0;                     // one standard deviation
  bool at_bound = false;                      // ended where the search ends: not fixed
};

// A factor on a declared number.
struct FittedFactor {
  Declared number = Declared::kRestVolume;
  Estimate factor;
  std::optional<std::size_t> specimen = {};  // of a number that each specimen has
};

// The numbers of one fit with their intervals.
struct Estimates {
  std::vector<FittedEffect> effects;
  std::vector<FittedFactor> fitted;
  // Of the effects' parameters, in their order, then of the fitted factors; SI. From the curvature
  // of χ² at the optimum (calibration/fit/fit.h).
  std::vector<std::vector<double>> covariance;
  std::vector<MeasuredEstimate> measured;
};

// A declared number that is found wrong, of all runs or of one specimen: `factor` times the
// declared one.
struct WrongNumber {
  Declared number = Declared::kRestVolume;
  double factor = 1.0;
  std::optional<double> deviation_sigma;  // of the declared uncertainty, kExactUncertainty of none
  std::vector<std::string> instead_of;    // effects that would be named were all numbers right
  std::optional<std::string> specimen = {};  // name of a piece that has the number for itself
};

// What the candidates fitted again to changed readings say of the names (names/stability.h).
struct StabilityChange {
  std::string change;
  std::optional<double> delta_bic;  // by which the best other set is behind; none without another
  bool holds = true;
};

// A slip of the pen that would account for more than any missing physics.
struct SuspectedSlip {
  std::string what;    // one sentence
  std::string assume;  // the name under which it is settled (learn/slip_kinds.h)
};

struct Candidate {
  // Ids; "leak:porous" where an id has several laws, "number:source_pressure" for a declared
  // number.
  std::vector<std::string> effects;
  double bic = 0.0, delta_bic = 0.0;
  double rms_pa = 0.0;
  std::optional<double> holdout_rms_pa;
  int parameters = 0;
  bool converged = false;
  int starts = 1, found_again = 1;  // multi-start: how many ended in the same optimum
  std::string reason;        // why it is not named though its BIC is less than that of what is
  bool may_be_named = true;  // search/contenders.h
};

enum class Phase { kRest, kRise, kHold, kFall };

struct PhaseResidual {
  std::string run;
  Phase phase = Phase::kRest;
  int cycle = 0;  // counts the run's inflations, from 0
  double start_s = 0.0, end_s = 0.0;
  int samples = 0;
  double mean_pa = 0.0, rms_pa = 0.0, trend_pa_per_s = 0.0;
};

// Of measured − model after the best fit. Statistics with their limits, so that the judgement can
// be checked.
struct ResidualReport {
  bool tested = false;  // for white and independent_of_inputs: there was time for it
  bool white = false;
  bool independent_of_inputs = false;
  double portmanteau = 0.0, portmanteau_limit = 0.0;
  double cross = 0.0, cross_limit = 0.0;
  double lack_of_fit = 0.0, lack_of_fit_limit = 0.0;  // variance over that of the noise
  double underread = 1.0;  // variance of the noise, with the memory that the residual shows, over
                           // that which the readings' differences show
  std::vector<PhaseResidual> phases;
};

// A run that would tell tied sets apart.
struct Experiment {
  Run run;  // schedule, source pressure, blocked, sample times; no readings
  std::vector<std::string> measure;     // channels beside the pressure, named as in the contract
  double expected_difference_pa = 0.0;  // RMS between the tied sets' predictions, least pair
  double expected_delta_bic = 0.0;      // by which the run would part the least parted pair
  std::string why;                      // one sentence
};

// Structure that no listed effect accounts for, learned as a term inside one equation.
struct Discrepancy {
  model::EffectPlace equation = model::EffectPlace::kChamber;
  std::vector<std::string> features;    // of what it is a function, e.g. "pressure"
  std::optional<FittedEffect> learned;  // the term as an effect of its own
  Estimates beside;                     // as fitted with the term, which is the last of the effects
  double rms_before_pa = 0.0, rms_after_pa = 0.0;
  std::optional<double> holdout_before_pa, holdout_after_pa;
  struct Place {              // where the residual lives, by share of its energy
    std::string axis, where;  // "phase" "hold"; "pressure" "60 to 80 kPa"; "cycle" "first"
    double share = 0.0;
  };
  std::vector<Place> places;
};

// Of one run, for plots; gauge pressures are − ambient. Of data sets with more than
// kSeriesSamplesMax samples evenly chosen ones.
inline constexpr std::size_t kSeriesSamplesMax = 20'000;
struct Series {
  std::string run;
  bool held_out = false;
  std::vector<Phase> phase;
  std::vector<double> t_s, measured_pa, declared_pa, before_pa, after_pa;
};

// Models that a diagnosis compares; `learned` is `after` fitted anew beside a learned term.
struct StatedModels {
  StatedModel declared, before, after;
  std::optional<StatedModel> learned;
  std::vector<StatedRun> runs;  // how their errors were got, by run
};

// One of the sets of a tie, as it was fitted.
struct TiedSet {
  std::vector<FittedEffect> effects;  // none where time ran out
  std::vector<WrongNumber> numbers;
};

// What is named beside the effects, or might be, and whether all names hold.
struct Names {
  std::vector<TiedSet> tied_sets;  // of Diagnosis::tied, the first as in `after`
  std::vector<WrongNumber> numbers;
  std::vector<StabilityChange> stability;  // of what is, or would have been, named
  std::vector<SuspectedSlip> slips;        // not settled: no effect is named before they are
};

// `effects`, `fitted` and `covariance` are those of `after`; of a tie the effects are those of the
// first of `tied_sets`.
struct Diagnosis : Estimates, Names {
  Verdict verdict = Verdict::kUndecided;
  std::string sentence;  // the verdict for a person
  double noise_pa = 0.0;
  ErrorReport declared, before, after;
  std::optional<ErrorReport> learned;
  StatedModels models;  // whose errors those are; without runs where nothing could be fitted
  std::vector<Candidate> candidates;  // by BIC
  std::vector<std::vector<std::string>> tied;
  std::optional<Experiment> next_experiment;  // none where no run would tell tied sets apart
  std::string no_experiment;                  // why there is none for a tie
  ResidualReport residual;
  std::optional<Discrepancy> discrepancy;
  double unexplained_fraction = 0.0;  // of the residual's variance above the noise, 0 to 1
  std::vector<std::string> warnings;  // outliers, clipped readings, what the data do not identify
  std::vector<Series> series;
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_DIAGNOSIS_H_
