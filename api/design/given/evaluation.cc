#include "api/design/given/evaluation.h"

#include <algorithm>
#include <optional>
#include <string>

#include "api/design/design_document.h"
#include "api/design/given/given_request.h"
#include "api/design/given/why_not_first.h"
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

std::string WhyUnknown(bool out_of_time, double seconds_max) {
  return (out_of_time ? "out of time after " + Decimal(seconds_max) + " s"
                      : std::string("the simulator found no cycle that repeats")) +
         ": it is not known whether every stroke ends within half of the period";
}

// Of a design that does not work: what it does not.
std::string WhyNot(const optimizer::Problem& problem, const optimizer::Window& source,
                   const optimizer::Design& given) {
  if (source.empty()) return "these parts stand no source pressure together";
  const auto gauge = [&](double pa) { return optimizer::KpaGauge(problem, pa); };
  const auto [least, most] = std::minmax({gauge(source.low_pa), gauge(source.high_pa)});
  const double set = gauge(given.settings.source_pressure_pa);
  const bool is_setting = !optimizer::IsDirect(given.configuration);
  if (is_setting && given.settings.group_pressure_pa.empty() && (set < least || set > most))
    return "the source pressure of " + Significant(set, 4) + " kPa gauge is " +
           (set < least ? "below" : "above") + " the range that works, " + Significant(least, 4) +
           " to " + Significant(most, 4) + " kPa gauge";
  if (!given.settings.group_pressure_pa.empty())
    return "a group's pressure is one that its parts do not stand, or a stroke never ends";
  return "a stroke never ends within half of the period";
}

}  // namespace

Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models, double seconds_max) {
  auto read = ReadGivenRequest(request, parts, models);
  if (auto* errors = std::get_if<Errors>(&read)) return *errors;
  const auto& [asked, given, beside, remarks] = std::get<GivenRequest>(read);
  const optimizer::Problem& problem = asked.problem;
  const auto out_of_time = After(seconds_max);
  const auto [source, unknown, design] =
      optimizer::EvaluateAtSettings(optimizer::WithPartsOf(problem, given), given, out_of_time);
  Json answer = AnswerDocument("evaluation_answer/1");
  answer["works"] = unknown ? Json() : Json(design.has_value());
  if (unknown)
    answer["detail"] = WhyUnknown(out_of_time(), seconds_max);
  else if (!design)
    answer["detail"] = WhyNot(problem, source, given);
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
  remarks.AddTo(answer);
  return answer;
}

}  // namespace plenum::api
