#include "api/measure/diagnose_request.h"

#include <chrono>
#include <utility>
#include <vector>

#include "api/measure/fitted/bottles.h"
#include "api/measure/inputs_document.h"
#include "api/measure/revision_of_diagnosis.h"
#include "api/measure/valve/row_instants.h"
#include "calibration/diagnose.h"
#include "catalog/store/content_hash.h"

namespace plenum::api {

namespace {

// The warnings of a diagnosis are sentences.
void AddRemarks(Remarks remarks, Json& answer) {
  for (const Json& warning : remarks.warnings)
    answer["warnings"].push_back(warning["pointer"].get<std::string>() + " " +
                                 warning["detail"].get<std::string>());
  remarks.warnings = Json::array();
  remarks.AddTo(answer);
}

// With instants known to a row where that leaves only noise and exact ones do not; the request says
// so then.
calibration::Diagnosis DiagnoseAlsoByRows(DiagnosisRequest& request,
                                          calibration::DiagnoseOptions options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  calibration::Diagnosis exact = calibration::Diagnose(request.dataset, options);
  const std::chrono::duration<double> taken = Clock::now() - start;
  options.time_limit_s -= taken.count();
  if (!AsksForRows(exact) || !AreOfRows(request.measurement, request.dataset) ||
      options.time_limit_s <= 0.0 || (options.cancelled && options.cancelled()))
    return exact;
  DiagnosisRequest by_rows = request;
  SayOfRows(by_rows.measurement, by_rows.dataset);
  if (options.progress)
    options.progress = [tell = options.progress](double, const std::string& what) {
      tell(0.99, what + ", with the valve's instants known to a reading");
    };
  calibration::Diagnosis of_rows = calibration::Diagnose(by_rows.dataset, options);
  if (!IsBetterOfRows(exact, of_rows)) return exact;
  of_rows.warnings.push_back(
      "the valve's commands stand at times of readings and were taken to be known to one reading: "
      "with exact instants less is explained. Say \"uncertainty_s\": 0 of a command that is exact");
  request = std::move(by_rows);
  return of_rows;
}

DiagnosisAnswer DiagnoseRuns(DiagnosisRequest request, const DiagnosisProgress& progress) {
  calibration::DiagnoseOptions options;
  options.cancelled = progress.cancelled;
  options.progress = progress.progress;
  options.time_limit_s = request.time_limit_s;
  const calibration::Diagnosis diagnosis =
      request.model
          ? calibration::Predict(request.dataset, {request.model->effects, request.model->factors},
                                 options)
          : DiagnoseAlsoByRows(request, options);
  DiagnosisAnswer answer;
  answer.answer = RenderDiagnosis(diagnosis, request.dataset, request.provenance);
  AddRemarks(request.remarks, answer.answer);
  answer.answer["measurement"] = InputsOf(request.measurement);
  // A saved model is one of a single actuator.
  if (!request.model && !request.dataset.several &&
      diagnosis.verdict != calibration::Verdict::kUndecided)
    answer.revision = RevisionOf(diagnosis, request.provenance);
  answer.answer["revision"] = answer.revision ? RenderModel(*answer.revision) : Json(nullptr);
  return answer;
}

// The request of the runs of one bottle.
DiagnosisRequest OfBottle(DiagnosisRequest request, const BottleRuns& bottle) {
  request.dataset = OnlyRuns(std::move(request.dataset), bottle.runs);
  request.measurement = OnlyRuns(std::move(request.measurement), bottle.runs);
  return request;
}

}  // namespace

DiagnosisAnswer RunDiagnosis(const DiagnosisRequest& request, const DiagnosisProgress& progress) {
  const std::vector<BottleRuns> bottles = RunsByBottle(request.dataset);
  if (bottles.size() < 2u || request.model) return DiagnoseRuns(request, progress);
  DiagnosisAnswer answer = DiagnoseRuns(OfBottle(request, bottles.front()), progress);
  Json& checks = answer.answer["bottles"] = Json::array();
  for (std::size_t k = 1; k < bottles.size(); ++k) {
    const Json other = DiagnoseRuns(OfBottle(request, bottles[k]), progress).answer;
    checks.push_back(CompareBottles(answer.answer, bottles.front(), other, bottles[k],
                                    request.dataset, answer.answer["measured_refused"]));
  }
  return answer;
}

Provenance::File FileOf(const std::string& name, std::string_view text) {
  return {name, catalog::Sha256(text)};
}

}  // namespace plenum::api
