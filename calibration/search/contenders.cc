#include "calibration/search/contenders.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "calibration/fit/start_scan.h"
#include "calibration/values/parallel.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kFinalSteps = 30'000;
// Fits that only have to be compared end where χ² falls by less than this share, at most after so
// many steps; those near the best are then taken further.
constexpr double kScreening = 1e-4;
constexpr int kScreeningIterations = 12;
// After so many steps only those go on that explain at least this share of what the best one does
// beyond the smaller set, the very best, and single effects that do worse than the base model,
// which they can all but be: their steps so far say nothing of them, and they are given more.
constexpr int kFirstLook = 5;
constexpr double kRoughly = 3.0;   // and so much less, what does not ring
constexpr double kLoosely = 1e-4;  // of the operating pressure, at the most
constexpr double kHopeful = 0.5;
constexpr std::size_t kAlwaysOn = 6;
constexpr double kNear = 20.0;       // of BIC
constexpr double kNearShare = 0.02;  // of what the best set gains over the base model
constexpr std::size_t kLeadingLengths = 3;
constexpr double kNever = std::numeric_limits<double>::infinity();

bool IsLost(const Contenders::Job& job) {
  return job.set.size() == 1u && job.fit.status == FitStatus::kIterationsSpent &&
         job.fit.bic > job.bic_before + kNear;
}

// Whether a fit that is near its end may come to a better optimum than the one known.
bool MayBeat(const Fit& known, const Fit& fit) {
  const double room = fit.status == FitStatus::kIterationsSpent ? kNear : -kSameOptimum;
  return fit.bic < known.bic + room;
}

}  // namespace

bool Contains(const Contender& outer, const Contender& inner) {
  return std::all_of(
      inner.effects.begin(), inner.effects.end(),
      [&](const model::EffectSpec* spec) { return HoldsId(outer.effects, spec->id); });
}

bool SameEffects(const Contender& a, const Contender& b) {
  return a.effects.size() == b.effects.size() && Contains(a, b);
}

bool MayBeNamed(const Contender& contender) {
  const Fit& fit = contender.fit;
  for (Eigen::Index j = 0; j < fit.u.size(); ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    const Parameter& of = coordinate.parameter;
    const bool freed = of.kind == Parameter::Kind::kDeclared &&
                       fit.state.freed.Holds(static_cast<std::size_t>(of.declared), of.specimen);
    const double u = fit.u[j];
    const double number = coordinate.Number(u);
    if ((freed && coordinate.AtEnd(u)) || number < coordinate.least || number > coordinate.most)
      return false;
  }
  return true;
}

bool IsNested(const Contender& a, const Contender& b) { return Contains(a, b) || Contains(b, a); }

bool MayComeTo(double goal, const Fit& cut_short, double bic_before) {
  return cut_short.bic < goal + kNear + kHopeful * std::max(0.0, bic_before - goal);
}

ModelState StateOf(const Contender& contender, const EffectSet& rest) {
  ModelState state = contender.fit.state;
  const auto holds = [&](const model::EffectSpec* spec) {
    return std::find(rest.begin(), rest.end(), spec) != rest.end();
  };
  std::erase_if(state.effects, [&](const model::Effect& effect) { return !holds(effect.spec); });
  const EffectSet freed = SpecsOf(std::exchange(state.freed, {}));
  for (const model::EffectSpec* spec : freed) {
    if (holds(spec)) Free(*spec, state.freed);
    if (holds(spec)) continue;
    const Declared number = *FreedBy(*spec);
    const std::optional<std::size_t> chamber = ChamberFreedBy(*spec);
    if (!chamber) SetFactor(number, 1.0, state);
    if (chamber) NumberOf(state, {.declared = number, .specimen = *chamber}) = 1.0;
  }
  return state;
}

Contenders::Contenders(const FitData& fit_data, const SearchOptions& options)
    : data(fit_data), options_(&options) {}

FitOptions Contenders::Screening() const {
  FitOptions options;
  options.cancelled = options_->cancelled;
  options.function_tolerance = kScreening;
  options.iterations_max = kScreeningIterations;
  return options;
}

// Integrates only as exactly as the best smaller set fits, since much is yet to be explained.
FitOptions Contenders::FirstLook(const EffectSet& set) const {
  FitOptions options = Screening();
  options.iterations_max = kFirstLook;
  const std::optional<std::size_t> smaller = Best(static_cast<int>(set.size()) - 1);
  if (!smaller) return options;
  const Fit& fit = list[*smaller].fit;
  options.noise_share *= std::sqrt(std::max(1.0, fit.chi2_data / static_cast<double>(fit.rows)));
  if (!AnyRings(set)) options.noise_share *= kRoughly;
  options.tolerance_loosest = kLoosely;
  return options;
}

FitOptions Contenders::Further() const {
  FitOptions options = Screening();
  options.function_tolerance = 0.1 * kScreening;
  options.iterations_max = 3 * kScreeningIterations;
  return options;
}

FitOptions Contenders::Tight() const {
  FitOptions options = Screening();
  options.noise_share = 1e-3;
  options.steps_max = kFinalSteps;
  options.function_tolerance = 1e-9;
  options.iterations_max = 100;
  options.threads = options_->threads;
  return options;
}

Contender* Contenders::Find(const EffectSet& set) {
  for (Contender& contender : list)
    if (contender.effects == set) return &contender;
  return nullptr;
}

std::vector<std::size_t> Contenders::Sorted(int size) const {
  std::vector<std::size_t> sorted;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].effects.size() == static_cast<std::size_t>(size) && list[i].fit.Usable() &&
        MayBeNamed(list[i]))
      sorted.push_back(i);
  std::stable_sort(sorted.begin(), sorted.end(), [this](std::size_t a, std::size_t b) {
    return list[a].fit.bic < list[b].fit.bic;
  });
  return sorted;
}

std::optional<std::size_t> Contenders::Best(int size) const {
  const std::vector<std::size_t> sorted = Sorted(size);
  if (sorted.empty()) return {};
  return sorted.front();
}

double Contenders::LeftShare(const Contender& contender) const {
  const auto above = [](const Fit& fit) {
    return std::max(0.0, fit.chi2_data / static_cast<double>(fit.rows) - 1.0);
  };
  return above(contender.fit) / std::max(above(Base().fit), 1e-300);
}

void Contenders::FitBase() {
  Report(0.02, "base model");
  Contender base;
  FitOptions options = Screening();
  options.threads = options_->threads;
  base.fit = FitModel(data, data.forward->Declared(), options);
  base.starts = base.found_again = 1;
  starts_.clear();
  list.push_back(std::move(base));
}

void Contenders::AddJobs(const Contender& from, const model::EffectSpec* added,
                         std::vector<Job>& jobs) {
  if (HoldsId(from.effects, added->id)) return;
  const EffectSet set = With(from.effects, added);
  const auto planned = [&](const Job& job) { return job.set == set; };
  if (Find(set) || std::any_of(jobs.begin(), jobs.end(), planned)) return;
  if (const Contender* known = Earlier(set)) {
    Job job{set, known->fit.state, from.fit.bic};
    job.start.clock_s = from.fit.state.clock_s;
    jobs.push_back(std::move(job));
    return;
  }
  const ModelState beside = Unstretched(data, from.fit);
  if (FreedBy(*added)) {
    jobs.push_back({set, beside, from.fit.bic});
    Free(*added, jobs.back().start.freed);
    return;
  }
  for (const model::Effect& start : StartsBeside(from, added)) {
    Job job{set, beside, from.fit.bic};
    job.start.effects.push_back(start);
    std::sort(job.start.effects.begin(), job.start.effects.end(),
              [](const auto& a, const auto& b) { return Precedes(a.spec, b.spec); });
    jobs.push_back(std::move(job));
  }
}

const Contender* Contenders::Earlier(const EffectSet& set) const {
  const auto known = std::find_if(earlier.begin(), earlier.end(), [&](const Contender& contender) {
    return contender.effects == set;
  });
  if (known == earlier.end() || !known->fit.Usable()) return nullptr;
  const bool idle = std::any_of(earlier.begin(), earlier.end(), [&](const Contender& part) {
    return part.effects.size() + 1 == set.size() && Contains(*known, part) && part.fit.Usable() &&
           part.fit.bic <= known->fit.bic;
  });
  return idle ? nullptr : &*known;
}

const std::vector<model::Effect>& Contenders::StartsBeside(const Contender& from,
                                                           const model::EffectSpec* spec) {
  for (const Starts& known : starts_)
    if (known.size == from.effects.size() && known.starts.front().spec == spec) return known.starts;
  FitOptions options = FirstLook(With(from.effects, spec));
  options.threads = options_->threads;
  starts_.push_back({from.effects.size(), ScannedStarts(data, from.fit, *spec, options)});
  return starts_.back().starts;
}

void Contenders::RunJobs(std::vector<Job>& jobs, double from_share, double to_share,
                         const std::string& what, std::optional<double> goal) {
  if (jobs.empty()) return;
  std::vector<Job*> all;
  all.reserve(jobs.size());
  for (Job& job : jobs) all.push_back(&job);
  const double middle = 0.5 * (from_share + to_share);
  const std::size_t size = jobs.front().set.size();
  StartFreed(all, from_share, what);
  Continue(
      all, [&](const Job& job) { return FirstLook(job.set); }, from_share, middle, what);
  FitOptions rest = Screening();
  rest.iterations_max -= kFirstLook;
  Continue(
      Hopeful(all, goal), [&](const Job&) { return rest; }, middle, to_share, what);
  std::erase_if(all, [](const Job* job) { return !IsLost(*job); });
  Continue(
      all, [&](const Job&) { return Screening(); }, to_share, to_share, what);
  for (Job& job : jobs) Take(std::move(job));
  Refine(static_cast<int>(size), goal);
}

// Numbers of which the readings fix a product alone share what is to be explained along a bent
// valley, in which fits crawl: a freed number takes it up first, while those with a prior stay.
void Contenders::StartFreed(std::vector<Job*> jobs, double share, const std::string& what) {
  std::erase_if(jobs, [](const Job* job) { return EffectsAlone(job->set) == job->set; });
  Continue(
      jobs,
      [&](const Job& job) {
        FitOptions options = FirstLook(job.set);
        options.declared_stay = true;
        return options;
      },
      share, share, what);
}

void Contenders::Continue(const std::vector<Job*>& jobs,
                          const std::function<FitOptions(const Job&)>& options_of,
                          double from_share, double to_share, const std::string& what) {
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  ForAll(jobs.size(), options_->threads, [&](std::size_t i) {
    if (Cancelled()) return;
    FitOptions each = options_of(*jobs[i]);
    each.threads = ThreadsWithin(i, jobs.size(), options_->threads);
    Fit fit = FitModel(data, jobs[i]->start, each);
    if (fit.Usable()) jobs[i]->start = fit.state;
    if (fit.Usable() || !jobs[i]->fit.Usable()) jobs[i]->fit = std::move(fit);
    const double share = static_cast<double>(++done) / static_cast<double>(jobs.size());
    const std::lock_guard lock(reporting);
    Report(from_share + share * (to_share - from_share), what);
  });
}

// Those that have not converged but may still matter.
std::vector<Contenders::Job*> Contenders::Hopeful(std::vector<Job*> jobs,
                                                  std::optional<double> goal) const {
  std::erase_if(jobs, [](const Job* job) { return !job->fit.Usable(); });
  if (jobs.empty()) return jobs;
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job* a, const Job* b) { return a->fit.bic < b->fit.bic; });
  const double best = std::min(jobs.front()->fit.bic, goal.value_or(kNever));
  const double before = jobs.front()->bic_before;
  std::vector<Job*> hopeful;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const bool may_matter =
        (k < kAlwaysOn && !goal) || IsLost(*jobs[k]) || MayComeTo(best, jobs[k]->fit, before);
    if (may_matter && jobs[k]->fit.status == FitStatus::kIterationsSpent)
      hopeful.push_back(jobs[k]);
  }
  return hopeful;
}

// Takes the fits of sets of a size further that come near the best one, or are among the best and
// have not ended.
void Contenders::Refine(int size, std::optional<double> goal) {
  const std::vector<std::size_t> sorted = Sorted(size);
  if (sorted.empty()) return;
  const double best = std::min(list[sorted.front()].fit.bic, goal.value_or(kNever));
  const double gain = std::max(0.0, Base().fit.bic - best);
  const double reach = goal ? kNear : std::max(kNear, kNearShare * gain);
  std::vector<Contender*> near;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    Contender& contender = list[sorted[k]];
    const bool unfinished =
        k < kAlwaysOn && !goal && contender.fit.status == FitStatus::kIterationsSpent;
    const bool close = contender.fit.bic < best + reach;
    if (!contender.refined && (unfinished || close)) near.push_back(&contender);
  }
  ForAll(near.size(), options_->threads, [&](std::size_t i) {
    FitOptions each = Further();
    each.threads = ThreadsWithin(i, near.size(), options_->threads);
    Fit fit = FitModel(data, near[i]->fit.state, each);
    near[i]->refined = fit.status != FitStatus::kIterationsSpent;
    if (fit.Usable() && fit.bic < near[i]->fit.bic) near[i]->fit = std::move(fit);
    Narrow(data, Further(), near[i]->fit);
  });
}

void Contenders::FitTight(const std::vector<Contender*>& contenders) const {
  ForAll(contenders.size(), options_->threads, [&](std::size_t i) {
    FitOptions each = Tight();
    each.threads = ThreadsWithin(i, contenders.size(), options_->threads);
    Fit fit = FitModel(data, contenders[i]->fit.state, each);
    Narrow(data, each, fit);
    if (fit.Usable() && fit.bic < contenders[i]->fit.bic + kSameOptimum)
      contenders[i]->fit = std::move(fit);
  });
}

// The lengths at which the line may ring in step race: some steps of each, more of those that lead,
// and the best one to the last digit if it is another optimum. Where that is clearly better there
// may be more.
void Contenders::FitInStep(Contender& contender, double goal) {
  FitOptions scan = Screening();
  scan.threads = options_->threads;
  for (bool again = true; again && !Cancelled();) {
    std::vector<Fit> fits;
    for (ModelState& start : ScannedAgain(data, contender.fit, scan))
      fits.emplace_back().state = std::move(start);
    const auto race = [&](const FitOptions& options, std::size_t left) {
      FitModels(options, fits);
      fits.resize(std::min(fits.size(), left));
      return !fits.empty() && fits.front().Usable();
    };
    if (!race(Screening(), kLeadingLengths)) return;
    const bool hopeful = MayComeTo(goal, fits.front(), contender.fit.bic);
    if (hopeful && !race(Further(), 1)) return;
    if (hopeful && MayBeat(contender.fit, fits.front()) && !race(Tight(), 1)) return;
    Narrow(data, Tight(), fits.front());
    const double gain = contender.fit.bic - fits.front().bic;
    if (gain > kSameOptimum) contender.fit = std::move(fits.front());
    again = hopeful && gain > kAccept;
  }
}

// Goes on with each; the best comes first.
void Contenders::FitModels(const FitOptions& options, std::vector<Fit>& fits) const {
  ForAll(fits.size(), options_->threads, [&](std::size_t i) {
    FitOptions each = options;
    each.threads = ThreadsWithin(i, fits.size(), options_->threads);
    fits[i] = FitModel(data, fits[i].state, each);
  });
  std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    return a.Usable() != b.Usable() ? a.Usable() : a.bic < b.bic;
  });
}

void Contenders::Take(Job job) {
  Contender* contender = Find(job.set);
  if (!contender) {
    list.push_back({.effects = job.set, .fit = {}});
    contender = &list.back();
  }
  ++contender->starts;
  if (!job.fit.Usable()) {
    if (contender->starts == 1) contender->fit = std::move(job.fit);
    return;
  }
  const auto chi2 = [](const Fit& fit) { return fit.chi2_data + fit.chi2_prior; };
  if (!contender->fit.Usable() || chi2(job.fit) < chi2(contender->fit) - kSameOptimum) {
    contender->fit = std::move(job.fit);
    contender->refined = false;
    contender->found_again = 1;
  } else if (chi2(job.fit) < chi2(contender->fit) + kSameOptimum) {
    ++contender->found_again;
    if (chi2(job.fit) < chi2(contender->fit)) contender->fit = std::move(job.fit);
  }
}

}  // namespace plenum::calibration
