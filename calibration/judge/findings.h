// What a diagnosis tells of a finished search: numbers with their intervals, the sets that were
// compared, the runs as models have them, warnings, the verdict in a sentence.
#ifndef PLENUM_CALIBRATION_JUDGE_FINDINGS_H_
#define PLENUM_CALIBRATION_JUDGE_FINDINGS_H_

#include <string>
#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/search/effect_search.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

std::vector<std::string> IdsOf(const Contender& contender);

// `effects` and `fitted` with their intervals, and the covariance of both.
void AddEstimates(const Bench& bench, const Fit& fit, Diagnosis& diagnosis);

// Errors on unseen runs that are known already, by the fit that they are of.
using HoldoutByFit = std::vector<std::pair<const Fit*, std::optional<double>>>;

// The best sets and the base model. Fewer, and without errors on unseen runs that are not `known`,
// when time is over.
void AddCandidates(const Bench& bench, const SearchResult& search, const HoldoutByFit& known,
                   Diagnosis& diagnosis);

// Every run as measured and as the declared model and two fitted ones have it.
void AddSeries(const Bench& bench, const ModelState& before, const ModelState& after,
               Diagnosis& diagnosis);

// On readings and clocks, and on what the found effects are hard to tell from.
void AddWarnings(const Bench& bench, Diagnosis& diagnosis);

// The verdict for people; `effects` and `tied` must stand.
std::string Sentence(const Bench& bench, const SearchResult& search, const Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_FINDINGS_H_
