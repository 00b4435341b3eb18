#include "api/design/evaluation.h"

#include "api/design/design_document.h"
#include "api/design/read/combination.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/version.h"
#include "api/measure/model_document.h"
#include "optimizer/problem/problem.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {

Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models) {
  Errors errors;
  RemarkRecorder recorder;
  Reader reader(request, "", errors);
  reader.Schema("evaluation/1");
  const Json* requirements = reader.Raw("requirements");
  if (requirements == nullptr)
    reader.Fail("requirements", "is required: a document requirements/1");
  if (!errors.empty()) return errors;
  auto parsed = ParseRequirements(*requirements, parts, models);
  if (auto* wrong = std::get_if<Errors>(&parsed)) {
    for (Error& error : *wrong) error.pointer.insert(0, "/requirements");
    return *wrong;
  }
  const optimizer::Problem& problem = std::get<DesignRequest>(parsed).problem;
  Remarks remarks = std::get<DesignRequest>(parsed).remarks;
  remarks.PutUnder("/requirements");
  TellAmbient(problem.ambient);
  optimizer::Design given = ReadGivenDesign(reader.Object("design"), problem);
  reader.Finish();
  if (errors.empty()) CheckCombination(given, problem, parts, "/design", errors);
  if (!errors.empty()) return errors;
  given = WithReservoirVolume(std::move(given), problem);
  const auto [source, design] =
      optimizer::EvaluateAtSettings(optimizer::WithPartsOf(problem, given), given);
  Json answer = AnswerDocument("evaluation_answer/1");
  answer["works"] = design.has_value();
  const auto gauge = [&](double pa) { return Number(KpaGaugeFromPa(pa, problem.ambient)); };
  answer["source_pressure_range_kpa_gauge"] =
      source.empty() ? Json(nullptr) : Json{gauge(source.low_pa), gauge(source.high_pa)};
  if (design) answer.update(RenderFigures(*design, problem));
  remarks.Append(recorder.Take());
  remarks.AddTo(answer);
  return answer;
}

}  // namespace plenum::api
