#include "calibration/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "calibration/parallel.h"
#include "model/effects/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kGain = 10.0;         // of a finer term over a coarser one, and of any over none
constexpr std::size_t kFinalists = 3;  // families that compete on runs left out
constexpr std::size_t kFolds = 4;      // runs left out, at most
// Fits are compared, and only the answer is polished.
constexpr int kIterations = 10, kPolish = 25;
constexpr double kFunctionTolerance = 1e-4, kPolishTolerance = 1e-6;
constexpr double kNoiseShare = 1e-2;
constexpr std::size_t kStepsMax = 5'000;  // of a run: a term on its way may be stiff
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
  };
  return kFamilies;
}

// n·ln((χ² + χ²_prior)/n) + k·ln n. A model that lacks something has a χ² far above n; the priors
// then weigh in the selection what they weigh in its fit.
double Score(const Fit& fit) {
  const double n = static_cast<double>(fit.rows);
  const auto free = std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                                  [](const Coordinate& coordinate) { return !coordinate.prior; });
  return n * std::log((fit.chi2_data + fit.chi2_prior) / n) +
         static_cast<double>(free) * std::log(n);
}

bool Holds(const ModelState& state, std::string_view id) {
  return std::any_of(state.effects.begin(), state.effects.end(),
                     [&](const model::Effect& effect) { return effect.spec->id == id; });
}

// Terms from which a fit starts. Most do nothing yet; one that has a place is tried at several.
std::vector<model::Effect> Starts(const model::EffectSpec& spec, const TypicalSizes& sizes) {
  if (spec.law == "opening") {
    const double rate_per_s = 0.1 / sizes.duration_s;
    return {{&spec, {rate_per_s, 0.3, 0.05}},
            {&spec, {rate_per_s, 0.55, 0.05}},
            {&spec, {rate_per_s, 0.8, 0.05}}};
  }
  if (spec.law == "bend") {
    return {{&spec, {0.02, 0.3, 0.05}}, {&spec, {0.02, 0.5, 0.05}}, {&spec, {0.02, 0.7, 0.05}}};
  }
  if (spec.law == "store") {
    return {{&spec, {0.2 * sizes.volume_m3, 0.03 * sizes.conductance_m3_per_s_pa, 0.3}}};
  }
  if (spec.law == "drift") return {{&spec, {0.0, 0.2 * sizes.duration_s, 0.0}}};
  return {{&spec, std::vector<double>(spec.parameters.size(), 0.0)}};
}

// The best fit of the term on `runs`, with everything else as `base` has it to start from.
Fit FitTerm(const FitData& data, const std::vector<std::size_t>& runs, const ModelState& base,
            const std::vector<model::Effect>& starts, const FitOptions& options) {
  FitData on_runs = data;
  on_runs.runs = runs;
  Fit best;
  double least = kNone;
  for (const model::Effect& start : starts) {
    ModelState state = base;
    state.effects.push_back(start);
    Fit fit = FitModel(on_runs, state, options);
    if (!fit.Usable() || !(Score(fit) < least)) continue;
    least = Score(fit);
    best = std::move(fit);
  }
  return best;
}

struct Attempt {
  const Family* family = nullptr;
  Fit fit;
  double score = kNone;
  double left_out = kNone;  // whitened squares of the runs left out
};

Attempt FitFamily(const FitData& data, const Family& family, const ModelState& base,
                  const FitOptions& options) {
  Attempt attempt{&family, {}};
  for (const char* law : family.laws) {
    const model::EffectSpec* spec = model::FindEffect(family.id, law);
    Fit fit = FitTerm(data, data.runs, base, Starts(*spec, data.sizes), options);
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

// The state with the run's own initial pressure and clock, where they are unknown: nothing learned
// from other runs can tell them.
ModelState Aligned(const FitData& data, const ModelState& state, std::size_t run,
                   FitOptions options) {
  FitData alone = data;
  alone.runs = {run};
  options.nuisance_only = true;
  options.own_pairs = HasOwnPairs(data, run);
  const Fit aligned = FitModel(alone, state, options);
  return aligned.Usable() ? aligned.state : state;
}

// Each of at most kFolds runs left out in turn; `fit_on` fits the others.
template <class FitOn>
double LeftOut(const FitData& data, const FitOn& fit_on, const FitOptions& options) {
  const std::size_t folds = std::min(kFolds, data.runs.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < folds; ++k) {
    std::vector<std::size_t> others = data.runs;
    const std::size_t at = k * data.runs.size() / folds;
    const std::size_t left_out = others[at];
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    const Fit fit = fit_on(others);
    if (!fit.Usable()) return kNone;
    ModelState state = fit.state;
    const ModelState declared = data.forward->Declared();
    state.initial_pressure_pa[left_out] = declared.initial_pressure_pa[left_out];
    state.initial_temperature_k[left_out] = declared.initial_temperature_k[left_out];
    state.clock_s[left_out] = declared.clock_s[left_out];
    sum += SquaresOf(data, Aligned(data, state, left_out, options), {left_out}, options);
  }
  return sum;
}

double LeftOutWithout(const FitData& data, const ModelState& base, const FitOptions& options) {
  return LeftOut(
      data,
      [&](const std::vector<std::size_t>& runs) {
        FitData others = data;
        others.runs = runs;
        return FitModel(others, base, options);
      },
      options);
}

// Candidates by BIC, the finalists among them judged on runs left out.
const Attempt* Choose(const FitData& data, const Fit& established, std::vector<Attempt>& attempts,
                      const FitOptions& options) {
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& a, const Attempt& b) { return a.score < b.score; });
  const auto gains = [&](const Attempt& attempt) {
    return attempt.score < Score(established) - kGain;
  };
  if (attempts.empty() || !gains(attempts.front())) return nullptr;
  if (data.runs.size() < 2) return &attempts.front();
  const Attempt* best = nullptr;
  double least = LeftOutWithout(data, established.state, options);
  for (std::size_t k = 0; k < std::min(kFinalists, attempts.size()); ++k) {
    Attempt& attempt = attempts[k];
    if (!gains(attempt)) break;
    const std::vector<model::Effect> start = {attempt.fit.state.effects.back()};
    attempt.left_out = LeftOut(
        data,
        [&](const std::vector<std::size_t>& runs) {
          return FitTerm(data, runs, established.state, start, options);
        },
        options);
    if (attempt.left_out < least) least = attempt.left_out, best = &attempt;
  }
  return best;
}

FittedEffect LearnedOf(const FitData& data, const Fit& fit, const FitOptions& options) {
  FittedEffect learned{fit.state.effects.back(), {}};
  const std::vector<Estimate> estimates = Intervals(fit, Covariance(data, fit, options));
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind == Parameter::Kind::kEffect &&
        parameter.effect + 1 == fit.state.effects.size()) {
      learned.parameters.push_back(estimates[j]);
    }
  }
  return learned;
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
  FitOptions quick = options;
  quick.iterations_max = std::min(options.iterations_max, kIterations);
  quick.function_tolerance = std::max(options.function_tolerance, kFunctionTolerance);
  quick.noise_share = std::max(options.noise_share, kNoiseShare);
  quick.steps_max = std::min(options.steps_max, kStepsMax);
  quick.threads = 1;
  std::vector<Attempt> attempts(Families().size());
  ForAll(attempts.size(), options.threads, [&](std::size_t i) {
    if (!Holds(established.state, Families()[i].id))
      attempts[i] = FitFamily(data, Families()[i], established.state, quick);
  });
  std::erase_if(attempts, [](const Attempt& attempt) { return !attempt.fit.Usable(); });
  if (options.cancelled && options.cancelled()) return learned;
  quick.threads = options.threads;
  const Attempt* best = Choose(data, established, attempts, quick);
  if (!best || (options.cancelled && options.cancelled())) return learned;
  FitOptions polish = quick;
  polish.iterations_max = kPolish;
  polish.function_tolerance = kPolishTolerance;
  const Fit polished = FitModel(data, best->fit.state, polish);
  learned.fit = polished.Usable() && Score(polished) < best->score ? polished : best->fit;
  discrepancy.equation = learned.fit.state.effects.back().spec->place;
  discrepancy.features = best->family->features;
  discrepancy.learned = LearnedOf(data, learned.fit, options);
  discrepancy.rms_after_pa = PressureRms(data, learned.fit.state, data.runs, options);
  if (!holdout.empty()) {
    discrepancy.holdout_after_pa = UnseenRms(data, learned.fit.state, holdout, options);
  }
  return learned;
}

}  // namespace plenum::calibration
