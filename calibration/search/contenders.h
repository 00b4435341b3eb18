// Sets of effects with their fits: from every start of an added effect a few steps first, then as
// far as the fit may matter to the choice among the sets.
#ifndef PLENUM_CALIBRATION_SEARCH_CONTENDERS_H_
#define PLENUM_CALIBRATION_SEARCH_CONTENDERS_H_

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/values/effect_sets.h"
#include "calibration/values/parallel.h"

namespace plenum::calibration {

// A set of effects and its best fit.
struct Contender {
  EffectSet effects;
  Fit fit;
  int starts = 0, found_again = 0;  // how many ended at the best fit's χ²
  bool refined = false;             // a further fit from there gains nothing that counts
};

// The same ids, whatever the laws.
bool SameEffects(const Contender& a, const Contender& b);
// Every id of `inner` is in `outer`.
bool Contains(const Contender& outer, const Contender& inner);

// Whether each number that the set frees ended within what was searched (one at an end takes up
// what something else should, and is no cause), and each of its effects is larger than what the
// sampling leaves open (Coordinate::least).
bool MayBeNamed(const Contender& contender);

// Whether one holds the other.
bool IsNested(const Contender& a, const Contender& b);

// Whether a fit cut short may still come to a BIC: where it has come by a good share of the way
// there from the BIC of the set without its last effect.
bool MayComeTo(double goal, const Fit& cut_short, double bic_before);

// The fitted state with only the effects and freed numbers of `rest`.
ModelState StateOf(const Contender& contender, const EffectSet& rest);

struct SearchOptions {
  int threads = UsableCores();
  std::function<bool()> cancelled;                           // may be empty
  std::function<void(double, const std::string&)> progress;  // share done, what is under way
  bool clocks_may_be_off = true;                             // each run's, by a part of a sample
};

inline constexpr double kAnyBic = std::numeric_limits<double>::infinity();

// Two fits whose χ² or BIC are this close are of the same optimum.
inline constexpr double kSameOptimum = 1.0;

class Contenders {
 public:
  // A fit to be made of a set.
  struct Job {
    EffectSet set;
    ModelState start;
    double bic_before = 0.0;  // of the smaller set
    Fit fit = {};
  };

  Contenders(const FitData& fit_data, const SearchOptions& options);

  FitData data;
  std::vector<Contender> list;  // the base model first
  // Of a search before this one, which took the clocks or the readings otherwise.
  std::vector<Contender> earlier;

  const Contender& operator[](std::size_t i) const { return list[i]; }
  const Contender& Base() const { return list.front(); }
  Contender* Find(const EffectSet& set);
  // Those with that many effects that could be fitted and may be named, by BIC; the first of them.
  std::vector<std::size_t> Sorted(int size) const;
  std::optional<std::size_t> Best(int size) const;
  // Variance above the noise over that of the base model.
  double LeftShare(const Contender& contender) const;

  void FitBase();
  // The set of `from` with one more effect, from each of its starts, or from where an earlier
  // search came to; none if it has been fitted.
  void AddJobs(const Contender& from, const model::EffectSpec* added, std::vector<Job>& jobs);
  // Fits all from their starts: a few steps each at first, and to the end what may matter: sets
  // that may come to the best one's BIC or, if that is less, to `goal`. The shares are of the whole
  // work, for the progress.
  void RunJobs(std::vector<Job>& jobs, double from_share, double to_share, const std::string& what,
               std::optional<double> goal = {});

  // Fits each to the last digit.
  void FitTight(const std::vector<Contender*>& contenders) const;

  // Fits a set with an effect that rings again from other lengths of its line (start_scan.h), until
  // none does clearly better, or may come to the BIC `goal`.
  void FitInStep(Contender& contender, double goal = kAnyBic);

  bool Cancelled() const { return options_->cancelled && options_->cancelled(); }
  void Report(double share, const std::string& what) const {
    if (options_->progress) options_->progress(share, what);
  }
  // A few steps of a set; fits that only have to be compared, those that come near the best, and
  // those that decide.
  FitOptions FirstLook(const EffectSet& set) const;
  FitOptions Screening() const;
  FitOptions Further() const;
  FitOptions Tight() const;

 private:
  void Continue(const std::vector<Job*>& jobs,
                const std::function<FitOptions(const Job&)>& options_of, double from_share,
                double to_share, const std::string& what);
  void StartFreed(std::vector<Job*> jobs, double share, const std::string& what);
  std::vector<Job*> Hopeful(std::vector<Job*> jobs, std::optional<double> goal) const;
  void Refine(int size, std::optional<double> goal);
  void FitModels(const FitOptions& options, std::vector<Fit>& fits) const;
  void Take(Job job);
  // Its fit of the set where that did better than without any one of the effects: one that ended
  // idle says nothing of where to start.
  const Contender* Earlier(const EffectSet& set) const;
  struct Starts {
    std::size_t size = 0;  // of the sets
    std::vector<model::Effect> starts;
  };
  // Found beside the first set of a size, which is the best, and used beside all of that size.
  const std::vector<model::Effect>& StartsBeside(const Contender& from,
                                                 const model::EffectSpec* spec);

  const SearchOptions* options_;
  std::vector<Starts> starts_;
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_SEARCH_CONTENDERS_H_
