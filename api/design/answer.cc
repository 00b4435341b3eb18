#include "api/design/answer.h"

#include "api/catalogue/catalogue_parts.h"
#include "api/design/designs.h"
#include "api/design/front.h"
#include "api/design/guaranteed.h"
#include "api/design/hints.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/read/selection.h"
#include "api/design/revised_ranking.h"
#include "api/json/json.h"
#include "optimizer/explain/conflict.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/front/pareto.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

namespace {

Json AnswerFront(const DesignRequest& request, const optimizer::SearchOptions& options,
                 const std::vector<catalog::Part>& parts) {
  optimizer::Front front =
      optimizer::ParetoFront(request.problem, request.pareto, options, optimizer::FindConflicts);
  if (!request.robust) {
    Json document = RenderAnswer(request, front.answer, parts);
    AddFront(front, document);
    return document;
  }
  const optimizer::RobustAnswer robust = optimizer::AssessRobustness(
      request.problem, std::move(front.answer), options, request.robust->options,
      MakeDraws(parts, request.problem, request.robust->tolerance,
                static_cast<std::uint64_t>(request.robust->seed)));
  front.answer = robust.answer;
  Json document = RenderAnswer(request, front.answer, parts);
  AddFront(front, document);
  AddRobustness(*request.robust, robust, document);
  return document;
}

}  // namespace

ListAnswer AnswerList(const DesignRequest& request, const optimizer::SearchOptions& options,
                      const std::vector<catalog::Part>& parts) {
  optimizer::RobustAnswer robust;
  if (request.robust)
    robust = optimizer::SearchRobust(request.problem, options, request.robust->options,
                                     MakeDraws(parts, request.problem, request.robust->tolerance,
                                               static_cast<std::uint64_t>(request.robust->seed)));
  else
    robust.answer = optimizer::Search(request.problem, options);
  Json document = RenderAnswer(request, robust.answer, parts);
  if (request.robust) AddRobustness(*request.robust, robust, document);
  if (request.proof && robust.searched)
    document["robust"]["searched"] = RenderSearched(request.problem, *robust.searched, parts);
  if (request.explain)
    AddExplanation(*request.explain, request.problem, robust.answer, options, document);
  return {std::move(robust.answer), std::move(document)};
}

Json AnswerRequest(const DesignRequest& request, optimizer::SearchOptions options,
                   const std::vector<catalog::Part>& parts) {
  options.time_limit_s = request.time_limit_s;
  options.record = request.proof;
  options.select = [&parts](const optimizer::Problem& problem) {
    return AllowedModelParts(parts, problem);
  };
  if (!request.pareto.empty()) return AnswerFront(request, options, parts);
  if (request.model) return AnswerRevised(request, options, parts);
  if (request.guarantee) return AnswerGuaranteed(request, options, parts);
  ListAnswer list = AnswerList(request, options, parts);
  if (!request.robust) AddHints(request, list.answer, options, parts, list.document);
  return std::move(list.document);
}

}  // namespace plenum::api
