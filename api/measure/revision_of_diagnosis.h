// The model revision that a diagnosis found, to be saved.
#ifndef PLENUM_API_MEASURE_REVISION_OF_DIAGNOSIS_H_
#define PLENUM_API_MEASURE_REVISION_OF_DIAGNOSIS_H_

#include "api/measure/diagnosis_document.h"
#include "api/measure/model_document.h"

namespace plenum::api {

// Effects and factors of `after` at their estimates, with their covariance, of a tie those of its
// first set, and what is tied; where a term was learned, the term with the effects and factors
// fitted beside it, and the errors with it.
SavedModel RevisionOf(const calibration::Diagnosis& diagnosis, const Provenance& provenance);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_REVISION_OF_DIAGNOSIS_H_
