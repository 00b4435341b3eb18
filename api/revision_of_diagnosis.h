// The model revision that a diagnosis found, to be saved.
#ifndef PLENUM_API_REVISION_OF_DIAGNOSIS_H_
#define PLENUM_API_REVISION_OF_DIAGNOSIS_H_

#include "api/diagnosis.h"
#include "api/model_revision.h"

namespace plenum::api {

// Effects and factors at their estimates, and of each its variance from the 95 % interval; what
// varies together is not kept.
SavedModel RevisionOf(const calibration::Diagnosis& diagnosis, const Provenance& provenance);

}  // namespace plenum::api

#endif  // PLENUM_API_REVISION_OF_DIAGNOSIS_H_
