// A diagnosis with something in every field, over simulated runs of the contract's bench: creep in
// truth, base model before.
#ifndef PLENUM_TESTS_SUPPORT_SAMPLE_DIAGNOSIS_H_
#define PLENUM_TESTS_SUPPORT_SAMPLE_DIAGNOSIS_H_

#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::test {

struct SampleDiagnosis {
  calibration::Dataset dataset;
  calibration::Diagnosis diagnosis;
};

// Three runs, "r1" and "r2" fitted and "r3" held out, of `samples` readings each.
SampleDiagnosis MakeSampleDiagnosis(int samples = 1601);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_SAMPLE_DIAGNOSIS_H_
