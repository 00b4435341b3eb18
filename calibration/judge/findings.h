// What a diagnosis tells of a finished search: numbers with their intervals, the sets that were
// compared, the runs as models have them, the verdict in a sentence.
#ifndef PLENUM_CALIBRATION_JUDGE_FINDINGS_H_
#define PLENUM_CALIBRATION_JUDGE_FINDINGS_H_

#include <string>
#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/search/effect_search.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

std::vector<std::string> IdsOf(const Contender& contender);

// The numbers of a fit; their intervals from the profile of the likelihood where there is time and
// that is asked for, else from its curvature.
enum class IntervalsFrom { kProfile, kCurvature };
Estimates EstimatesOf(const Bench& bench, const Fit& fit, IntervalsFrom source);

// Errors on unseen runs that are known already, by the fit that they are of.
using HoldoutByFit = std::vector<std::pair<const Fit*, std::optional<double>>>;

// The best sets and the base model, by BIC of readings that are worth 1/memory of their number: by
// what the choice among them was made. Fewer, and without errors on unseen runs that are not
// `known`, when time is over. Sets with less than the named set's BIC carry the reason; `doubt` is
// that of the chosen set where the base model is what stands. `rival` is a learned term that would
// do as well as what is named, which is then said, or null.
void AddCandidates(const Bench& bench, const SearchResult& search, double memory,
                   const HoldoutByFit& known, Diagnosis& diagnosis);
void AddReasons(const SearchResult& search, double memory,
                const std::vector<const Contender*>& named, const std::string& doubt,
                const model::EffectSpec* rival, Diagnosis& diagnosis);

// Every run as measured and as the models of the diagnosis have it.
void AddSeries(const Bench& bench, Diagnosis& diagnosis);

// The verdict for people; `effects` and `tied` must stand. `open` is what keeps the shown model
// from being the explanation (verdict.h).
std::string Sentence(const Bench& bench, const SearchResult& search, const std::string& open,
                     const Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_FINDINGS_H_
