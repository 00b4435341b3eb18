#include "api/design/given/evaluation.h"

#include <chrono>
#include <optional>

#include "api/design/design_document.h"
#include "api/design/given/why_not_first.h"
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
  std::optional<optimizer::Design> beside;
  if (const std::optional<Reader> other = reader.OptionalObject("beside"))
    beside = ReadGivenDesign(*other, problem);
  optimizer::Design given = ReadGivenDesign(reader.Object("design"), problem);
  reader.Finish();
  const auto complete = [&](optimizer::Design& design, const char* pointer) {
    AddOutsidePower(problem, design);
    if (errors.empty()) CheckCombination(design, problem, parts, pointer, errors);
    if (errors.empty()) design = WithReservoirVolume(std::move(design), problem);
  };
  complete(given, "/design");
  if (beside) complete(*beside, "/beside");
  if (!errors.empty()) return errors;
  const auto out_of_time = After(seconds_max);
  const auto [source, unknown, design] =
      optimizer::EvaluateAtSettings(optimizer::WithPartsOf(problem, given), given, out_of_time);
  Json answer = AnswerDocument("evaluation_answer/1");
  answer["works"] = unknown ? Json() : Json(design.has_value());
  if (unknown) answer["detail"] = WhyUnknown(out_of_time(), seconds_max);
  const auto gauge = [&](double pa) { return Number(optimizer::KpaGauge(problem, pa)); };
  answer["source_pressure_range_kpa_gauge"] =
      source.empty() ? Json(nullptr) : Json{gauge(source.low_pa), gauge(source.high_pa)};
  if (design) answer.update(RenderFigures(*design, problem));
  if (beside) {
    const optimizer::AtSettings first = optimizer::EvaluateAtSettings(
        optimizer::WithPartsOf(problem, *beside), *beside, out_of_time);
    if (!first.design && !first.unknown)
      return Errors{{"/beside", "does not work at its settings with these requirements and parts"}};
    answer["why_not_first"] =
        first.design ? WhyNotFirst(problem, parts, {given, design, *first.design}, out_of_time)
                     : Json(nullptr);
  }
  remarks.Append(recorder.Take());
  remarks.AddTo(answer);
  return answer;
}

}  // namespace plenum::api
