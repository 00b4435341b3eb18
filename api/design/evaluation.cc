#include "api/design/evaluation.h"

#include <chrono>

#include "api/design/design_document.h"
#include "api/design/read/combination.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/power.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "api/measure/model_document.h"
#include "optimizer/problem/problem.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

std::function<bool()> After(double seconds) {
  using Clock = std::chrono::steady_clock;
  return [start = Clock::now(), limit = std::chrono::duration<double>(seconds)] {
    return Clock::now() - start > limit;
  };
}

std::string WhyUnknown(bool out_of_time, double seconds_max) {
  return (out_of_time ? "out of time after " + Decimal(seconds_max) + " s"
                      : std::string("the simulator found no cycle that repeats")) +
         ": it is not known whether every stroke ends within half of the period";
}

}  // namespace

Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models, double seconds_max) {
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
    PutUnder("/requirements", *wrong);
    return *wrong;
  }
  const optimizer::Problem& problem = std::get<DesignRequest>(parsed).problem;
  Remarks remarks = std::get<DesignRequest>(parsed).remarks;
  remarks.PutUnder("/requirements");
  TellAmbient(problem.ambient);
  optimizer::Design given = ReadGivenDesign(reader.Object("design"), problem);
  reader.Finish();
  AddOutsidePower(problem, given);
  if (errors.empty()) CheckCombination(given, problem, parts, "/design", errors);
  if (!errors.empty()) return errors;
  given = WithReservoirVolume(std::move(given), problem);
  const auto out_of_time = After(seconds_max);
  const auto [source, unknown, design] =
      optimizer::EvaluateAtSettings(optimizer::WithPartsOf(problem, given), given, out_of_time);
  Json answer = AnswerDocument("evaluation_answer/1");
  answer["works"] = unknown ? Json() : Json(design.has_value());
  if (unknown) answer["detail"] = WhyUnknown(out_of_time(), seconds_max);
  const auto gauge = [&](double pa) { return Number(KpaGaugeFromPa(pa, problem.ambient)); };
  answer["source_pressure_range_kpa_gauge"] =
      source.empty() ? Json(nullptr) : Json{gauge(source.low_pa), gauge(source.high_pa)};
  if (design) answer.update(RenderFigures(*design, problem));
  remarks.Append(recorder.Take());
  remarks.AddTo(answer);
  return answer;
}

}  // namespace plenum::api
