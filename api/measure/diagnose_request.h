// A diagnosis from documents to answer, for the command line and the service.
#ifndef PLENUM_API_MEASURE_DIAGNOSE_REQUEST_H_
#define PLENUM_API_MEASURE_DIAGNOSE_REQUEST_H_

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/measure/diagnosis_document.h"
#include "api/measure/measurement.h"
#include "api/measure/model_document.h"
#include "api/measure/time_limit.h"

namespace plenum::api {

struct DiagnosisRequest {
  calibration::Dataset dataset;
  Json measurement;                 // the document that the data set was read from
  std::optional<SavedModel> model;  // predicts the runs; none: they are diagnosed
  Provenance provenance;
  Remarks remarks;  // of the measurement
  double time_limit_s = kDiagnosisTimeS;
};

struct DiagnosisProgress {
  std::function<bool()> cancelled;                           // may be empty
  std::function<void(double, const std::string&)> progress;  // share done, what is under way
};

struct DiagnosisAnswer {
  Json answer;                         // diagnosis/1
  std::optional<SavedModel> revision;  // to be saved; none of what is undecided
};
// Of runs with several bottles that measure a part (fitted/bottles.h) the answer is that of the
// bottle with the most runs, with "bottles" for what the others say.
DiagnosisAnswer RunDiagnosis(const DiagnosisRequest& request, const DiagnosisProgress& progress);

// A file by name and the hash of its text.
Provenance::File FileOf(const std::string& name, std::string_view text);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_DIAGNOSE_REQUEST_H_
