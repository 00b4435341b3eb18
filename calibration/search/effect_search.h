// Which effects does the base model lack? Fits of the base model, of every single effect with every
// law, and of sets grown forwards from the best and checked backwards.
//
// Selection is by BIC: a larger set must be better by kAccept than the best smaller one
// (thresholds.h). Pairs are all effects added to each of the best kSeeds singles, then each member
// of the best set exchanged for every other effect, so that a set that does as well a step away is
// seen too; triples are all effects added to the best pairs. Where a set leaves nothing, sets of
// one effect more but no more numbers are still tried. Fits start from the optimum of the smaller
// set and from every start of the added effect (coordinates.h); where that optimum stretches the
// declared numbers beyond their uncertainties, which makes long valleys, from those as declared. A
// set in which an earlier search of the same runs, with the clocks or the readings taken otherwise,
// found all effects at work starts from there. Where nothing that the earlier search found leaves
// nothing, its leading sets are fitted first; if none of them does now, all is not tried again.
#ifndef PLENUM_CALIBRATION_SEARCH_EFFECT_SEARCH_H_
#define PLENUM_CALIBRATION_SEARCH_EFFECT_SEARCH_H_

#include <functional>
#include <vector>

#include "calibration/search/contenders.h"

namespace plenum::calibration {

struct SearchResult {
  FitData data;                       // clocks as decided
  std::vector<Contender> contenders;  // by BIC; the base model is among them
  std::size_t chosen = 0;             // index of the chosen set
  std::size_t base = 0;               // index of the base model
  bool complete = false;              // nothing was cut short
  bool enough = false;                // the chosen set leaves nothing to explain
};

// `enough` says whether a fit leaves nothing to explain; the search grows sets until it does.
// `earlier`: a search of the same runs with readings taken otherwise, or one without contenders.
SearchResult SearchEffects(const FitData& data, const SearchOptions& options,
                           const std::function<bool(const Fit&)>& enough,
                           const SearchResult& earlier = {});

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_SEARCH_EFFECT_SEARCH_H_
