// The sets of a tie in a diagnosis.
#ifndef PLENUM_CALIBRATION_NAMES_TIED_SETS_H_
#define PLENUM_CALIBRATION_NAMES_TIED_SETS_H_

#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/judge/evidence.h"
#include "calibration/search/effect_search.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// The sets of a tie with their effects, whose first is that of `after`.
void StateTied(const Bench& bench, const SearchResult& search, double memory,
               const std::vector<const Contender*>& tied, Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_TIED_SETS_H_
