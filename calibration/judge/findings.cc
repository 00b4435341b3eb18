#include "calibration/judge/findings.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "calibration/fit/profile.h"
#include "calibration/judge/evidence.h"
#include "calibration/judge/verdict.h"
#include "calibration/noise/phases.h"
#include "calibration/values/parallel.h"
#include "calibration/values/specimens.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kCandidatesShown = 30, kStoppedShown = 2;
constexpr std::string_view kNumber = "number:";
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kFinalists = 5;  // whose held-out error is found by leaving out each run

// "creep + another rest_volume".
std::string Joined(const std::vector<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) {
    text += text.empty() ? "" : " + ";
    text += id.starts_with(kNumber) ? "another " + id.substr(kNumber.size()) : id;
  }
  return text;
}

std::string TitleOf(const model::EffectSpec& spec) {
  return spec.law.empty() ? std::string(spec.id)
                          : std::string(spec.id) + ":" + std::string(spec.law);
}

std::vector<std::string> TitlesOf(const EffectSet& effects) {
  std::vector<std::string> titles;
  titles.reserve(effects.size());
  for (const model::EffectSpec* spec : effects) titles.push_back(TitleOf(*spec));
  return titles;
}

// Places in the list: those that could be fitted first, by BIC.
std::vector<std::size_t> ByBic(const std::vector<Contender>& contenders, double memory) {
  std::vector<double> bic(contenders.size(), kNever);
  for (std::size_t i = 0; i < bic.size(); ++i)
    if (contenders[i].fit.Usable()) bic[i] = BicWith(contenders[i].fit, memory);
  std::vector<std::size_t> order(contenders.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bic[a] < bic[b]; });
  return order;
}

std::ptrdiff_t NumbersIn(const Candidate& candidate) {
  return std::count_if(candidate.effects.begin(), candidate.effects.end(),
                       [](const std::string& title) { return title.starts_with(kNumber); });
}

// As FitsNoBetter (evidence.h).
bool FitsNoBetterThanAPart(const Candidate& set, const std::vector<Candidate>& candidates) {
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& part) {
    return part.effects.size() < set.effects.size() && part.rms_pa <= set.rms_pa &&
           NumbersIn(part) == NumbersIn(set) &&
           std::all_of(part.effects.begin(), part.effects.end(), [&](const std::string& title) {
             return std::count(set.effects.begin(), set.effects.end(), title) > 0;
           });
  });
}

std::string Tenths(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

Candidate CandidateOf(const Bench& bench, const Contender& contender, bool finalist,
                      const HoldoutByFit& known) {
  Candidate candidate;
  candidate.effects = TitlesOf(contender.effects);
  const Fit& fit = contender.fit;
  candidate.bic = fit.bic;
  candidate.converged = fit.status == FitStatus::kConverged;
  candidate.may_be_named = MayBeNamed(contender);
  candidate.starts = contender.starts;
  candidate.found_again = contender.found_again;
  candidate.parameters = static_cast<int>(fit.coordinates.size());
  if (!fit.Usable()) return candidate;
  Squares fitted, held_out;
  for (const std::size_t run : bench.data.runs) fitted.Add(ErrorsOf(bench, run, fit.state));
  candidate.rms_pa = fitted.Rms();
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == &fit; });
  if (found != known.end()) candidate.holdout_rms_pa = found->second;
  if (candidate.holdout_rms_pa || Stopped(bench)) return candidate;
  for (const std::size_t run : bench.held_out) held_out.Add(ErrorsUnseen(bench, run, fit.state));
  if (bench.held_out.empty() && finalist) {
    if (const auto unseen = LeaveOneOut(bench, fit)) candidate.holdout_rms_pa = unseen->rms_pa;
  } else if (held_out.count > 0 && !Stopped(bench)) {
    candidate.holdout_rms_pa = held_out.Rms();
  }
  return candidate;
}

}  // namespace

std::vector<std::string> IdsOf(const Contender& contender) {
  std::vector<std::string> ids;
  for (const model::EffectSpec* spec : contender.effects) ids.emplace_back(spec->id);
  return ids;
}

Estimates EstimatesOf(const Bench& bench, const Fit& fit, IntervalsFrom source) {
  FitOptions options = bench.tight;
  options.cancelled = nullptr;  // one evaluation
  const double memory = MemoryOf(WhitenedOf(bench, fit));
  const Eigen::MatrixXd covariance = Covariance(bench.data, fit, options, memory);
  std::vector<Estimate> intervals = Intervals(fit, covariance);
  if (source == IntervalsFrom::kProfile && !Stopped(bench))
    ProfileIntervals(bench.data, fit, covariance, Inflation(fit, memory), bench.tight, intervals);
  Estimates estimates;
  estimates.measured = MeasuredEstimates(bench.dataset, fit, covariance);
  WidenByRoom(bench.dataset, estimates.measured);
  std::vector<std::size_t> effects, fitted;  // which coordinates
  for (const model::Effect& effect : fit.state.effects)
    estimates.effects.push_back({effect, std::vector<Estimate>(effect.parameters.size())});
  for (std::size_t j = 0; j < intervals.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind == Parameter::Kind::kEffect) {
      estimates.effects[parameter.effect].parameters[parameter.number] = intervals[j];
      effects.push_back(j);
    }
    if (parameter.kind == Parameter::Kind::kDeclared) {
      estimates.fitted.push_back({parameter.declared, intervals[j], {}});
      if (OfEachSpecimen(fit.state, parameter.declared))
        estimates.fitted.back().specimen = parameter.specimen;
      fitted.push_back(j);
    }
  }
  std::vector<std::size_t> shown = effects;
  shown.insert(shown.end(), fitted.begin(), fitted.end());
  const auto slope = [&](std::size_t j) {
    return fit.coordinates[j].Slope(fit.u[static_cast<Eigen::Index>(j)]);
  };
  for (const std::size_t i : shown) {
    std::vector<double>& row = estimates.covariance.emplace_back();
    for (const std::size_t j : shown)
      row.push_back(slope(i) * slope(j) *
                    covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  return estimates;
}

void AddCandidates(const Bench& bench, const SearchResult& search, double memory,
                   const HoldoutByFit& known, Diagnosis& diagnosis) {
  const std::vector<std::size_t> order = ByBic(search.contenders, memory);
  const double best = BicWith(search.contenders[order.front()].fit, memory);
  std::vector<std::optional<Candidate>> candidates(search.contenders.size());
  const int threads = bench.tight.threads;
  ForAll(candidates.size(), threads, [&](std::size_t i) {
    const std::size_t shown = Stopped(bench) ? kStoppedShown : kCandidatesShown;
    if (i >= shown && order[i] != search.base && order[i] != search.chosen) return;
    Bench each = bench;
    each.tight.threads = 1;
    const Contender& contender = search.contenders[order[i]];
    candidates[i] = CandidateOf(each, contender, i < kFinalists, known);
    candidates[i]->bic = BicWith(contender.fit, memory);
    candidates[i]->delta_bic = candidates[i]->bic - best;
  });
  for (std::optional<Candidate>& candidate : candidates)
    if (candidate) diagnosis.candidates.push_back(std::move(*candidate));
}

static void AddRival(const Contender& named, const model::EffectSpec& term, Diagnosis& diagnosis) {
  static constexpr std::pair<std::string_view, const char*> kWords[] = {
      {"learned_leak", "gas that comes or goes in another way"},
      {"learned_conductance", "a line that conducts in another way"},
      {"learned_volume", "a volume that grows in another way"},
      {"learned_supply", "a source that swings"},
      {"learned_valve", "strokes that come late by a time of their own"}};
  std::string what = term.law == "drift"   ? "a sensor that drifts"
                     : term.law == "swing" ? "a sensor that swings"
                                           : "a sensor that is off by its pressure";
  for (const auto& [id, words] : kWords)
    if (term.id == id) what = words;
  diagnosis.warnings.push_back(what + " would do as well as " + Joined(IdsOf(named)) +
                               ", with no fewer numbers: a term that has no name (" +
                               TitleOf(term) + ")");
}

void AddReasons(const SearchResult& search, double memory,
                const std::vector<const Contender*>& named, const std::string& doubt,
                const model::EffectSpec* rival, Diagnosis& diagnosis) {
  double bic = kNever;
  std::vector<std::vector<std::string>> titles;
  for (const Contender* one : named) {
    bic = std::min(bic, BicWith(one->fit, memory));
    titles.push_back(TitlesOf(one->effects));
  }
  const Contender& chosen = search.contenders[search.chosen];
  if (!doubt.empty()) diagnosis.warnings.push_back(Joined(IdsOf(chosen)) + " " + doubt);
  if (rival && IsNamed(diagnosis.verdict)) AddRival(chosen, *rival, diagnosis);
  const EffectSet& first = named.front()->effects;
  for (Candidate& candidate : diagnosis.candidates) {
    const double gain = bic - candidate.bic;
    if (!(gain > 0.0) || std::count(titles.begin(), titles.end(), candidate.effects) > 0) continue;
    const std::size_t more =
        candidate.effects.size() - std::min(candidate.effects.size(), first.size());
    if (!doubt.empty())
      candidate.reason = candidate.effects == TitlesOf(chosen.effects)
                             ? doubt
                             : "no better than the best set, which is not named either";
    else if (!candidate.may_be_named)
      candidate.reason =
          "a declared number in it ended at an end of what was searched, or it acts within a "
          "sample";
    else if (FitsNoBetterThanAPart(candidate, diagnosis.candidates))
      candidate.reason =
          "leaves no less of the readings than a part of it: only declared numbers are nearer";
    else if (gain > kAccept)
      candidate.reason = "is " + Tenths(gain) +
                         " of BIC ahead, but no set of fewer effects on the way to it is worth its "
                         "name";
    else if (more > 0)
      candidate.reason = "gains " + Tenths(gain) + " of BIC by " + std::to_string(more) +
                         (more == 1u ? " more effect" : " more effects") + "; each must gain " +
                         Tenths(kAccept) + " to be named";
    else
      candidate.reason = "has the effects of a set that is named, by another law";
  }
}

void AddSeries(const Bench& bench, Diagnosis& diagnosis) {
  std::size_t samples = 0;
  for (const Run& run : bench.dataset.runs) samples += run.t_s.size();
  const std::size_t stride = (samples + kSeriesSamplesMax - 1) / kSeriesSamplesMax;
  diagnosis.series.resize(bench.dataset.runs.size());
  ForAll(bench.dataset.runs.size(), bench.tight.threads, [&](std::size_t i) {
    const Run& run = bench.dataset.runs[i];
    Series& series = diagnosis.series[i];
    series.run = run.id;
    series.held_out = HeldOut(bench, i);
    const auto chosen = [&](const std::vector<double>& all) {
      std::vector<double> some;
      for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
      return some;
    };
    series.t_s = chosen(run.t_s);
    series.measured_pa = chosen(run.pressure_pa);
    const std::vector<PhaseSpan> phases = PhasesOf(run);
    for (const double t_s : series.t_s) series.phase.push_back(phases[PhaseAt(phases, t_s)].phase);
    const auto predict = [&](const StatedModel& model) {
      std::vector<double> pressure_pa = Shown(bench, OfRun(model, i), i).pressure_pa;
      pressure_pa.resize(run.t_s.size(), std::numeric_limits<double>::quiet_NaN());
      return chosen(pressure_pa);
    };
    series.declared_pa = predict(diagnosis.models.declared);
    series.before_pa = predict(diagnosis.models.before);
    series.after_pa = predict(diagnosis.models.after);
  });
}

// "source_pressure is 13 % less than declared".
static std::string InWords(const WrongNumber& wrong) {
  char text[64];
  if (wrong.factor > 2.0 || wrong.factor < 0.5)
    std::snprintf(text, sizeof text, " is %.2g times what was declared", wrong.factor);
  else
    std::snprintf(text, sizeof text, " is %.2g %% %s than declared",
                  100.0 * std::abs(wrong.factor - 1.0), wrong.factor > 1.0 ? "more" : "less");
  const std::string of = wrong.specimen ? OfSpecimenInWords(*wrong.specimen) : "";
  return std::string(Name(wrong.number)) + of + text;
}

// What the diagnosis names: "The model lacks creep, and rest_volume is 9 % more than declared".
static std::string Named(const Contender& chosen, const Diagnosis& diagnosis) {
  std::vector<std::string> numbers, ids;
  for (const WrongNumber& wrong : diagnosis.numbers) numbers.push_back(InWords(wrong));
  for (const model::EffectSpec* spec : EffectsAlone(chosen.effects)) ids.emplace_back(spec->id);
  std::string text = ids.empty() ? "" : "The model lacks " + Joined(ids);
  if (numbers.empty()) return text;
  text += ids.empty() ? "A declared number is wrong: " : ", and a declared number is wrong: ";
  for (std::size_t k = 0; k < numbers.size(); ++k) text += (k > 0 ? " and " : "") + numbers[k];
  return text;
}

static std::string UnexplainedSentence(const Contender& chosen, const std::string& either,
                                       const std::string& open, const Diagnosis& diagnosis) {
  if (!diagnosis.tied.empty())
    return "The data cannot tell which is missing: " + either + "; and " + open + ".";
  if (!diagnosis.effects.empty() || !diagnosis.numbers.empty())
    return Named(chosen, diagnosis) + ", but " + open + ".";
  const bool withdrawn = std::any_of(diagnosis.stability.begin(), diagnosis.stability.end(),
                                     [](const StabilityChange& change) { return !change.holds; });
  if (withdrawn) return "No explanation holds when the readings are changed a little.";
  return static_cast<char>(std::toupper(static_cast<unsigned char>(open.front()))) +
         open.substr(1) + ".";
}

// What is to be said of runs that no fit saw where they are not predicted better.
static std::string NoBetter(const Diagnosis& diagnosis) {
  const bool named =
      !diagnosis.effects.empty() || !diagnosis.numbers.empty() || !diagnosis.tied.empty();
  const auto better =
      PredictsBetter(diagnosis.before.holdout_rms_pa, diagnosis.after.holdout_rms_pa);
  return named && !better.value_or(true)
             ? " Runs that no fit saw are not predicted better than without it."
             : "";
}

std::string Sentence(const Bench& bench, const SearchResult& search, const std::string& open,
                     const Diagnosis& diagnosis) {
  std::string either;
  for (const auto& ids : diagnosis.tied) either += (either.empty() ? "" : " or ") + Joined(ids);
  const Contender& chosen = search.contenders[search.chosen];
  switch (diagnosis.verdict) {
    case Verdict::kAdequate:
      return "The model is good enough: after its uncertain numbers were fitted, only noise is "
             "left.";
    case Verdict::kExplained:
      return Named(chosen, diagnosis) +
             (diagnosis.residual.tested && PassesTests(diagnosis.residual)
                  ? "; with it, only noise is left."
                  : "; with it, little is left beside the noise.") +
             NoBetter(diagnosis);
    case Verdict::kTie:
      return "The data cannot tell which is missing: " + either +
             (diagnosis.unexplained_fraction > 0.0 ? "; and some structure is left." : ".") +
             NoBetter(diagnosis);
    case Verdict::kUnexplained:
      return UnexplainedSentence(chosen, either, open, diagnosis) + NoBetter(diagnosis);
    case Verdict::kUndecided:
      break;
  }
  return Stopped(bench) ? "Undecided: the search was stopped before its end."
                        : "Undecided: a fit that matters failed.";
}

}  // namespace plenum::calibration
