// Which effects does the base model lack? Fits of the base model, of every single effect with every
// law, and of sets grown forwards from the best and checked backwards.
//
// Selection is by BIC: a larger set must be better by kAccept than the best smaller one
// (thresholds.h). Pairs are all effects added to each of the best kSeeds singles, then each member
// of the best set exchanged for every other effect, so that a set that does as well a step away is
// seen too; triples are all effects added to the best pairs. Fits start from the optimum of the
// smaller set and from every start of the added effect (coordinates.h); where that optimum
// stretches the declared numbers beyond their uncertainties, which makes long valleys, from those
// as declared.
#ifndef PLENUM_CALIBRATION_EFFECT_SEARCH_H_
#define PLENUM_CALIBRATION_EFFECT_SEARCH_H_

#include <algorithm>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "calibration/fit.h"

namespace plenum::calibration {

// A set of effects and its best fit.
struct Contender {
  std::vector<const model::EffectSpec*> effects;  // in the order of the registry
  Fit fit;
  int starts = 0, found_again = 0;  // how many ended at the best fit's χ²
  bool refined = false;             // a further fit from there gains nothing that counts
};

struct SearchOptions {
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::function<bool()> cancelled;                           // may be empty
  std::function<void(double, const std::string&)> progress;  // share done, what is under way
};

struct SearchResult {
  FitData data;                       // clocks as decided
  std::vector<Contender> contenders;  // by BIC; the base model is among them
  std::size_t chosen = 0;             // index of the chosen set
  std::size_t base = 0;               // index of the base model
  bool complete = false;              // nothing was cut short
};

// `enough` says whether a fit leaves nothing to explain; the search grows sets until it does.
SearchResult SearchEffects(const FitData& data, const SearchOptions& options,
                           const std::function<bool(const Fit&)>& enough);

// The same ids, whatever the laws.
bool SameEffects(const Contender& a, const Contender& b);
// Every id of `inner` is in `outer`.
bool Contains(const Contender& outer, const Contender& inner);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_EFFECT_SEARCH_H_
