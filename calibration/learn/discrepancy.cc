#include "calibration/learn/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calibration/fit/tones.h"
#include "calibration/learn/term_bounds.h"
#include "calibration/values/effect_sets.h"
#include "calibration/values/parallel.h"
#include "calibration/values/thresholds.h"
#include "model/effects/learned/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kGain = 10.0;         // of a finer term over a coarser one, and of any over none
constexpr std::size_t kTones = 3;      // frequencies from which a swinging term starts
constexpr std::size_t kFinalists = 3;  // families that compete on runs left out
constexpr std::size_t kFolds = 4;      // runs left out, at most
// Fits are compared, and only the answer is polished.
constexpr int kIterations = 40, kPolish = 50;
constexpr double kFunctionTolerance = 1e-4, kPolishTolerance = 1e-6;
constexpr double kNoiseShare = 1e-2;
constexpr std::size_t kStepsMax = 5'000;  // of a run: a term on its way may be stiff
// A rival's finer laws are tried where the coarser one leaves at most this share of what the set
// gains.
constexpr double kHopeful = 0.5;
constexpr double kNone = std::numeric_limits<double>::infinity();

// One kind of term: laws from coarse to fine.
struct Family {
  const char* id;
  std::vector<const char*> laws;
  std::vector<std::string> features;
};

const std::vector<Family>& Families() {
  static const std::vector<Family> kFamilies = {
      {"learned_leak", {"pressure_3", "pressure_5", "pressure_9"}, {"pressure"}},
      {"learned_leak", {"opening"}, {"pressure"}},
      {"learned_leak", {"store"}, {"pressure", "memory"}},
      {"learned_conductance", {"pressure_3", "pressure_5", "pressure_9"}, {"pressure"}},
      {"learned_conductance", {"expansion_3", "expansion_5", "expansion_9"}, {"expansion"}},
      {"learned_volume", {"pressure_3", "pressure_5", "pressure_9"}, {"pressure"}},
      {"learned_volume", {"bend"}, {"pressure"}},
      {"learned_volume", {"memory_1", "memory_3"}, {"pressure", "highest pressure so far"}},
      {"learned_sensor", {"pressure_3", "pressure_5"}, {"pressure"}},
      {"learned_sensor", {"drift"}, {"time"}},
      {"learned_sensor", {"swing"}, {"time"}},
      {"learned_supply", {"swing"}, {"time"}},
      {"learned_valve", {"late"}, {"stroke"}},
  };
  return kFamilies;
}

std::ptrdiff_t FreeNumbers(const Fit& fit) {
  return std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                       [](const Coordinate& coordinate) { return !coordinate.prior; });
}

// n·ln((χ² + χ²_prior)/n) + k·ln n. A model that lacks something has a χ² far above n; the priors
// then weigh in the selection what they weigh in its fit.
double Score(const Fit& fit) {
  const double n = static_cast<double>(fit.rows);
  return n * std::log((fit.chi2_data + fit.chi2_prior) / n) +
         static_cast<double>(FreeNumbers(fit)) * std::log(n);
}

bool Holds(const ModelState& state, std::string_view id) {
  return std::any_of(state.effects.begin(), state.effects.end(),
                     [&](const model::Effect& effect) { return effect.spec->id == id; });
}

ModelState With(ModelState state, const model::EffectSpec& spec, std::vector<double> parameters) {
  state.effects.push_back({&spec, std::move(parameters)});
  return state;
}

// With the term swinging at the strongest frequencies of the residual that is established.
std::vector<ModelState> SwingingStarts(const FitData& data, const model::EffectSpec& spec,
                                       const ModelState& base, const ModelState& established,
                                       const FitOptions& options) {
  const bool supply = spec.place == model::EffectPlace::kSupply;
  const bool fed = std::any_of(data.runs.begin(), data.runs.end(), [&](std::size_t run) {
    const Supply kind = data.forward->dataset().runs[run].supply;
    return kind == Supply::kRegulated || kind == Supply::kCompressor;
  });
  if (supply && !fed) return {};
  std::vector<ModelState> starts;
  const Swinging what = supply ? Swinging::kSupply : Swinging::kSensor;
  for (const Tone& tone : TonesOf(data, established, what, kTones, options)) {
    const double amplitude = std::min(tone.amplitude, 0.5 * spec.parameters[0].high);
    starts.push_back(With(base, spec, {amplitude, tone.frequency_hz, 0.0}));
    starts.back().phase_rad = tone.phase_rad;
  }
  return starts;
}

// The base with the term as a fit starts from it. Most terms do nothing yet; one that has a place
// is tried at several.
std::vector<ModelState> Starts(const FitData& data, const model::EffectSpec& spec,
                               const ModelState& base, const ModelState& established,
                               const FitOptions& options) {
  const TypicalSizes& sizes = data.sizes;
  if (!HasPlace(spec, data.forward->dataset().runs)) return {};
  if (spec.law == "swing") return SwingingStarts(data, spec, base, established, options);
  if (spec.law == "opening") {
    const double rate_per_s = 0.1 / sizes.duration_s;
    return {With(base, spec, {rate_per_s, 0.3, 0.05}), With(base, spec, {rate_per_s, 0.55, 0.05}),
            With(base, spec, {rate_per_s, 0.8, 0.05})};
  }
  if (spec.law == "bend")
    return {With(base, spec, {0.02, 0.3, 0.05}), With(base, spec, {0.02, 0.5, 0.05}),
            With(base, spec, {0.02, 0.7, 0.05})};
  if (spec.law == "store")
    return {With(base, spec, {0.2 * sizes.volume_m3, 0.03 * sizes.conductance_m3_per_s_pa, 0.3})};
  if (spec.law == "drift") return {With(base, spec, {0.0, 0.2 * sizes.duration_s, 0.0})};
  return {With(base, spec, std::vector<double>(spec.parameters.size(), 0.0))};
}

// The best fit of the term on `runs`.
Fit FitTerm(const FitData& data, const std::vector<std::size_t>& runs,
            const std::vector<ModelState>& starts, const FitOptions& options) {
  FitData on_runs = data;
  on_runs.runs = runs;
  Fit best;
  double least = kNone;
  for (const ModelState& start : starts) {
    Fit fit = FitModel(on_runs, start, options);
    if (!fit.Usable() || !(Score(fit) < least)) continue;
    least = Score(fit);
    best = std::move(fit);
  }
  return best;
}

// How well the runs left out are predicted. The score is Σ n·ln(χ²/n) over them, n their readings,
// no χ² below n: a run that alone shows what the term describes is off by much without it, and does
// not outweigh all others.
struct Unseen {
  double score = kNone;
  double rms_pa = std::numeric_limits<double>::quiet_NaN();
};

struct Attempt {
  const Family* family = nullptr;
  Fit fit;
  double score = kNone;
  Unseen left_out = {};
};

// The coarser law's curve on the knots of the finer one; none where its own are not among them.
std::optional<ModelState> OnFinerKnots(const Fit& coarser, const model::EffectSpec& finer) {
  ModelState state = coarser.state;
  std::vector<double>& values = state.effects.back().parameters;
  while (values.size() > 2u && values.size() < finer.parameters.size()) {
    std::vector<double> both = {values.front()};
    for (std::size_t k = 1; k < values.size(); ++k)
      both.insert(both.end(), {0.5 * (values[k - 1] + values[k]), values[k]});
    values = std::move(both);
  }
  if (values.size() != finer.parameters.size()) return {};
  state.effects.back().spec = &finer;
  return state;
}

// From the base, and where that leaves stretched numbers to their priors but keeps one that has
// none, from that as declared, too: it may have been fitted in place of the term.
std::vector<ModelState> StartsBeside(const FitData& data, const model::EffectSpec& spec,
                                     const ModelState& base, const ModelState& established,
                                     const FitOptions& options) {
  std::vector<ModelState> starts = Starts(data, spec, base, established, options);
  ModelState declared = base;
  const ModelState nominal = data.forward->Declared();
  declared.factor = nominal.factor, declared.specimen_factor = nominal.specimen_factor;
  if (SameFactors(base, established) || SameFactors(base, declared)) return starts;
  for (ModelState& start : Starts(data, spec, declared, established, options))
    starts.push_back(std::move(start));
  return starts;
}

// A finer law is tried where the coarser one has come below `hopeful`.
Attempt FitFamily(const FitData& data, const Family& family, const ModelState& base,
                  const ModelState& established, const FitOptions& options, double hopeful) {
  Attempt attempt{&family, {}};
  for (const char* law : family.laws) {
    if (attempt.fit.Usable() && !(attempt.score < hopeful)) break;
    const model::EffectSpec* spec = model::FindEffect(family.id, law);
    std::optional<ModelState> finer;
    if (attempt.fit.Usable()) finer = OnFinerKnots(attempt.fit, *spec);
    const std::vector<ModelState> starts =
        finer ? std::vector{*finer} : StartsBeside(data, *spec, base, established, options);
    Fit fit = FitTerm(data, data.runs, starts, options);
    if (!fit.Usable() || !(Score(fit) < attempt.score - (attempt.fit.Usable() ? kGain : 0.0))) {
      continue;
    }
    attempt.score = Score(fit);
    attempt.fit = std::move(fit);
  }
  return attempt;
}

// Σ e² of whitened residuals over the runs; infinite where a run fails.
double SquaresOf(const FitData& data, const ModelState& state, const std::vector<std::size_t>& runs,
                 const FitOptions& options) {
  double sum = 0.0;
  for (const std::size_t run : runs) {
    const Reading reading = Predicted(data, state, run, options);
    if (reading.pressure_pa.empty()) return kNone;
    std::vector<double> rows((*data.observed)[run].rows());
    Residuals(data.forward->dataset().runs[run], (*data.observed)[run], reading, rows);
    for (const double e : rows) sum += e * e;
  }
  return sum;
}

// How many numbers the term leaves to a run. Its own readings tell them, at ln n each as in the
// BIC.
double OwnNumbers(const FitData& data, const Fit& fit, std::size_t run) {
  return static_cast<double>(
      RunCoordinates(*data.forward, {run}, fit.state.effects, data.sizes).size());
}

// What one of at most kFolds runs, left out, makes of the score; `fit_on` fits the others.
struct Fold {
  double score = kNone, squares_pa2 = kNone, samples = 0.0;
};

std::size_t Folds(const FitData& data) { return std::min(kFolds, data.runs.size()); }

template <class FitOn>
Fold LeftOut(const FitData& data, std::size_t k, const FitOn& fit_on, const FitOptions& options) {
  FitData others = data;
  const std::size_t at = k * data.runs.size() / Folds(data);
  const std::size_t left_out = others.runs[at];
  others.runs.erase(others.runs.begin() + static_cast<std::ptrdiff_t>(at));
  const Fit fit = fit_on(others);
  if (!fit.Usable()) return {};
  ModelState state = fit.state;
  CopyRun(data.forward->Declared(), left_out, state);
  state = Aligned(data, state, left_out, options);
  const double squares = SquaresOf(data, state, {left_out}, options);
  const auto n = static_cast<double>((*data.observed)[left_out].rows());
  return {n * std::log(std::max(squares / n, 1.0)) + OwnNumbers(data, fit, left_out) * std::log(n),
          n * std::pow(PressureRms(data, state, {left_out}, options), 2), n};
}

Unseen Together(std::span<const Fold> folds) {
  Fold sum{0.0, 0.0, 0.0};
  for (const Fold& fold : folds) {
    if (!std::isfinite(fold.score)) return {};
    sum.score += fold.score, sum.squares_pa2 += fold.squares_pa2, sum.samples += fold.samples;
  }
  return {sum.score, std::sqrt(sum.squares_pa2 / sum.samples)};
}

void Polish(const FitData& data, const FitOptions& quick, Attempt& attempt) {
  FitOptions options = quick;
  options.iterations_max = kPolish;
  options.function_tolerance = kPolishTolerance;
  Fit fit = FitModel(data, attempt.fit.state, options);
  if (!fit.Usable() || !(Score(fit) < attempt.score)) return;
  attempt.score = Score(fit);
  attempt.fit = std::move(fit);
}

// How the model without a term and each finalist predict runs that are left out, in this order.
std::vector<Unseen> JudgeUnseen(const FitData& data, const ModelState& base,
                                std::span<const Attempt> finalists, const FitOptions& options) {
  const std::size_t folds = Folds(data);
  std::vector<Fold> found((1 + finalists.size()) * folds);
  ForAll(found.size(), options.threads, [&](std::size_t i) {
    FitOptions each = options;
    each.threads = ThreadsWithin(i, found.size(), options.threads);
    ModelState start = base;
    if (i >= folds) {
      const ModelState& with_term = finalists[i / folds - 1].fit.state;
      start.effects.push_back(with_term.effects.back());
      start.phase_rad = with_term.phase_rad;
      start.late_s = with_term.late_s;
    }
    found[i] = LeftOut(
        data, i % folds, [&](const FitData& others) { return FitModel(others, start, each); },
        each);
  });
  std::vector<Unseen> unseen;
  for (std::size_t i = 0; i < found.size(); i += folds)
    unseen.push_back(Together(std::span(found).subspan(i, folds)));
  return unseen;
}

// Candidates by BIC, the finalists whose numbers were found judged on runs left out, as the model
// `without`.
const Attempt* Choose(const FitData& data, const Fit& established, const ModelState& base,
                      std::vector<Attempt>& attempts, const FitOptions& options, Unseen& without) {
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& a, const Attempt& b) { return a.score < b.score; });
  const auto first_without_gain = std::find_if(
      attempts.begin(), attempts.end(),
      [&](const Attempt& attempt) { return !(attempt.score < Score(established) - kGain); });
  attempts.erase(first_without_gain, attempts.end());
  attempts.resize(std::min(data.runs.size() < 2 ? 1 : kFinalists, attempts.size()));
  ForAll(attempts.size(), options.threads, [&](std::size_t k) {
    FitOptions each = options;
    each.threads = ThreadsWithin(k, attempts.size(), options.threads);
    Polish(data, each, attempts[k]);
  });
  std::erase_if(attempts,
                [&](const Attempt& attempt) { return !IsFound(data, attempt.fit, options); });
  if (attempts.empty()) return nullptr;
  if (data.runs.size() < 2) return &attempts.front();
  const std::vector<Unseen> unseen = JudgeUnseen(data, base, attempts, options);
  without = unseen[0];
  const Attempt* best = nullptr;
  double least = without.score;
  for (std::size_t k = 0; k < attempts.size(); ++k) {
    attempts[k].left_out = unseen[k + 1];
    // Of those that predict alike the first, which fits better.
    if (unseen[k + 1].score < least - (best ? kGain : 0.0))
      least = unseen[k + 1].score, best = &attempts[k];
  }
  return best;
}

FitOptions Quick(FitOptions options) {
  options.iterations_max = std::min(options.iterations_max, kIterations);
  options.function_tolerance = std::max(options.function_tolerance, kFunctionTolerance);
  options.noise_share = std::max(options.noise_share, kNoiseShare);
  options.steps_max = std::min(options.steps_max, kStepsMax);
  return options;
}

// Of each family that is not there yet, those that could be fitted; a family goes on to finer laws
// below `hopeful`.
std::vector<Attempt> FitFamilies(const FitData& data, const ModelState& base,
                                 const ModelState& established, const FitOptions& options,
                                 double hopeful = kNone) {
  std::vector<Attempt> attempts(Families().size());
  ForAll(attempts.size(), options.threads, [&](std::size_t i) {
    FitOptions each = options;
    each.threads = ThreadsWithin(i, attempts.size(), options.threads);
    if (!Holds(established, Families()[i].id))
      attempts[i] = FitFamily(data, Families()[i], base, established, each, hopeful);
  });
  std::erase_if(attempts, [](const Attempt& attempt) { return !attempt.fit.Usable(); });
  return attempts;
}

}  // namespace

double PressureRms(const FitData& data, const ModelState& state,
                   const std::vector<std::size_t>& runs, const FitOptions& options) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::size_t run : runs) {
    const Reading reading = Predicted(data, state, run, options);
    if (reading.pressure_pa.empty()) return std::numeric_limits<double>::quiet_NaN();
    for (const double r :
         PressureResidual(data.forward->dataset().runs[run], (*data.observed)[run], reading)) {
      if (!std::isnan(r)) squares += r * r, ++count;
    }
  }
  return std::sqrt(squares / static_cast<double>(count));
}

double UnseenRms(const FitData& data, const ModelState& state, const std::vector<std::size_t>& runs,
                 const FitOptions& options) {
  ModelState aligned = state;
  for (const std::size_t run : runs) aligned = Aligned(data, aligned, run, options);
  return PressureRms(data, aligned, runs, options);
}

Rival RivalOf(const FitData& data, const Fit& base, const Fit& set, const FitOptions& options) {
  const FitOptions quick = Quick(options);
  // Its ratios that no reading narrows cost nothing, and count as none (fit.h).
  const double each = std::log(static_cast<double>(set.rows)), cost = Penalty(set, 1.0);
  const double of_set = Score(set) - each * static_cast<double>(FreeNumbers(set)) + cost;
  const double hopeful = of_set + kHopeful * std::max(0.0, Score(base) - of_set);
  auto attempts = FitFamilies(data, Unstretched(data, base), base.state, quick, hopeful);
  Rival rival;
  double least = kAccept;
  for (Attempt& attempt : attempts) {
    if (attempt.score < hopeful) Polish(data, quick, attempt);
    const model::Effect& term = attempt.fit.state.effects.back();
    const double apart = IsWithin(attempt.fit) ? attempt.score - of_set : kNone;
    const bool holds_set = OfOnePlace(set.state.effects, term);
    const bool fewer = each * (static_cast<double>(FreeNumbers(attempt.fit)) + 0.5) < cost;
    const bool simpler = !holds_set && (fewer || set.state.effects.size() > 2u);
    if (apart < (simpler ? kAccept : -kAccept)) return {.instead = true};
    if (apart < least && !holds_set) least = apart, rival.as_good = term.spec;
  }
  return rival;
}

LearnedModel LearnDiscrepancy(const FitData& data, const Fit& established,
                              const std::vector<std::size_t>& holdout, const FitOptions& options) {
  LearnedModel learned{{}, established};
  Discrepancy& discrepancy = learned.discrepancy;
  discrepancy.places = PlacesOf(data, established.state, options);
  discrepancy.rms_before_pa = PressureRms(data, established.state, data.runs, options);
  discrepancy.rms_after_pa = discrepancy.rms_before_pa;
  if (!holdout.empty()) {
    discrepancy.holdout_before_pa = UnseenRms(data, established.state, holdout, options);
    discrepancy.holdout_after_pa = discrepancy.holdout_before_pa;
  }
  FitOptions quick = Quick(options);
  const ModelState base = Unstretched(data, established);
  std::vector<Attempt> attempts = FitFamilies(data, base, established.state, quick);
  if (options.cancelled && options.cancelled()) return learned;
  Unseen without;
  const Attempt* best = Choose(data, established, base, attempts, quick, without);
  if (holdout.empty() && std::isfinite(without.rms_pa))
    discrepancy.holdout_before_pa = discrepancy.holdout_after_pa = without.rms_pa;
  if (!best || (options.cancelled && options.cancelled())) return learned;
  learned.fit = best->fit;
  discrepancy.equation = learned.fit.state.effects.back().spec->place;
  discrepancy.features = best->family->features;
  discrepancy.learned = LearnedOf(data, learned.fit, options);
  discrepancy.rms_after_pa = PressureRms(data, learned.fit.state, data.runs, options);
  if (!holdout.empty())
    discrepancy.holdout_after_pa = UnseenRms(data, learned.fit.state, holdout, options);
  else if (discrepancy.holdout_before_pa)
    discrepancy.holdout_after_pa = best->left_out.rms_pa;
  return learned;
}

}  // namespace plenum::calibration
