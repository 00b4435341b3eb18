// A diagnosis as the contract has it: diagnosis/1, in kPa, dm³/(s·bar), ml and litres per minute.
#ifndef PLENUM_API_MEASURE_DIAGNOSIS_DOCUMENT_H_
#define PLENUM_API_MEASURE_DIAGNOSIS_DOCUMENT_H_

#include <cstdint>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

// What an answer was made from, so that it can be made again.
struct Provenance {
  struct File {
    std::string name;
    std::string sha256;
  };
  std::vector<File> files;
  std::uint64_t seed = 0;  // of whatever was drawn at random
};

// The document with every field of the contract, and beside them: "declared", "sentence",
// "warnings", "series", "provenance", "noise" … Numbers that are not finite become null. A fitted
// number is the declared one of the first run that has it, times its factor; pressures among them
// are gauge. Sets of effects are lists of ids; where an id has several laws, "laws" tells which.
Json RenderDiagnosis(const calibration::Diagnosis& diagnosis, const calibration::Dataset& dataset,
                     const Provenance& provenance = {});

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_DIAGNOSIS_DOCUMENT_H_
