#include "api/design/sweep/sweep_answer.h"

#include <utility>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/sweep/sweep_table.h"
#include "api/json/problem_document.h"

namespace plenum::api {
namespace {

SweptAnswer Answer(const SweptRequest& swept, const std::vector<catalog::Part>& parts,
                   const optimizer::SearchOptions& options) {
  std::vector<catalog::ModelRevision> models;
  if (swept.model) models.push_back(*swept.model);
  const auto request = ParseRequirements(swept.requirements, parts, models);
  if (const auto* errors = std::get_if<Errors>(&request))
    return {"failed", nullptr, Lines(*errors), ""};
  const Json answer = AnswerRequest(std::get<DesignRequest>(request), options, parts);
  return {options.cancelled() ? "cancelled" : "done", SweepRow(answer), "", ""};
}

}  // namespace

Json AnswerSweep(const SweepRequest& sweep, const std::vector<catalog::Part>& parts,
                 const std::function<bool()>& cancelled, const TellSweep& tell) {
  std::vector<SweptAnswer> answers;
  answers.reserve(sweep.requests.size());
  for (const SweptRequest& swept : sweep.requests) {
    const std::size_t place = answers.size();
    if (cancelled()) {
      answers.push_back({"cancelled", nullptr, "", ""});
      continue;
    }
    tell(place, nullptr);
    optimizer::SearchOptions options;
    options.cancelled = cancelled;
    options.progress = [&](const optimizer::Progress& progress) { tell(place, &progress); };
    answers.push_back(Answer(swept, parts, options));
  }
  return RenderSweepTable(sweep.plan, answers);
}

}  // namespace plenum::api
