#include "calibration/names/tied_sets.h"

#include <utility>

#include "calibration/judge/findings.h"
#include "calibration/names/wrong_numbers.h"

namespace plenum::calibration {

void StateTied(const Bench& bench, const SearchResult& search, double memory,
               const std::vector<const Contender*>& tied, Diagnosis& diagnosis) {
  for (const Contender* contender : tied) {
    const bool first = diagnosis.tied.empty();
    TiedSet& set = diagnosis.tied_sets.emplace_back();
    if (first)
      set.effects = std::exchange(diagnosis.effects, {});
    else if (!Stopped(bench))
      set.effects = EstimatesOf(bench, contender->fit, IntervalsFrom::kCurvature).effects;
    set.numbers = WrongNumbersOf(bench.dataset, *contender, search.contenders, memory);
    diagnosis.tied.push_back(IdsOf(*contender));
  }
}

}  // namespace plenum::calibration
