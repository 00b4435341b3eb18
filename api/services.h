// What the command line and the HTTP service both call: a JSON request in, a JSON answer or a list
// of errors out. No HTTP, no files but the catalogue.
#ifndef PLENUM_API_SERVICES_H_
#define PLENUM_API_SERVICES_H_

#include <optional>
#include <string>
#include <vector>

#include "api/design/explanation.h"
#include "api/design/robustness.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "api/measure/model_document.h"
#include "catalog/fields/csv.h"
#include "catalog/fields/plausibility.h"
#include "catalog/store/backup.h"
#include "catalog/store/content_hash.h"
#include "catalog/store/job_store.h"
#include "catalog/store/store.h"
#include "optimizer/front/pareto.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// ── requirements/1 → designs/1 ──
struct DesignRequest {
  optimizer::Problem problem;
  double time_limit_s = 30.0;
  bool proof = false;  // the answer holds the record of the search
  std::string name;
  std::vector<optimizer::Amount> pareto;  // amounts of a front; empty: one objective
  std::optional<RobustRequest> robust;
  std::optional<ExplainRequest> explain;        // with one objective only
  std::optional<catalog::ModelRevision> model;  // that ranks instead of the nominal one
  Json request;  // as it was given; the answer echoes it, so that a saved answer can be checked
};
// Parses and validates requirements against the catalogue: every error at once. `parts` have passed
// catalog::Validate; `models` are the newest of each name that "model" may ask for.
Parsed<DesignRequest> ParseRequirements(const Json& request,
                                        const std::vector<catalog::Part>& parts,
                                        const std::vector<catalog::ModelRevision>& models = {});
// Searches and renders what the request asks for; `options` say how to stop and to report progress,
// the time limit is the request's. `parts` are the rows the problem was made of.
Json AnswerRequest(const DesignRequest& request, optimizer::SearchOptions options,
                   const std::vector<catalog::Part>& parts);
// The answer as JSON. `parts` are the rows the problem was made of: makers, provenance.
Json RenderAnswer(const DesignRequest& request, const optimizer::Answer& answer,
                  const std::vector<catalog::Part>& parts);
// What a list that asks for a probability was chosen from: { count, status, lower_bound, gap,
// designs: [{ rank, listed } or a design that is not listed] }.
Json RenderSearched(const optimizer::Problem& problem, const optimizer::Searched& searched,
                    const std::vector<catalog::Part>& parts);
// Settings, totals, performance and margins of a design.
Json RenderFigures(const optimizer::Design& design, const optimizer::Problem& problem);

// ── evaluation/1 → evaluation_answer/1 ──
// How a combination of parts (combination.h) does at given settings, whatever it meets: no search.
// `works` is false, without figures, where the parts do not stand the source pressure (its range is
// given, null where there is none) or where a stroke takes longer than half of the period.
Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models);

// ── simulation/1 → response/1, map/1 → map_answer/1 ──
// At most 200,000 samples and so much work; what stops early says so in `status` and `detail`.
Parsed<Json> RunSimulation(const Json& request, const std::vector<catalog::Part>& parts,
                           double seconds_max = kSimulationSecondsMax);
// At most 100,000 grid points, 2,000 with a compressor; an error if they take more than 60 s.
Parsed<Json> RunMap(const Json& request);

// ── parts ──
// { "families": [{ "name", "numbers": [{ "name", "min", "max", "required", "meaning" }], "texts":
// [{ "name", "allowed": texts, none for any, "required", "meaning" }], "has_curve" }] }.
Json RenderFamilies();
Json RenderPart(const catalog::Part& part);
// `request` is what RenderPart gives, or a part of a user's own; what the server sets (origin) is
// accepted and ignored.
Parsed<catalog::Part> ParsePart(const Json& request);
// { number, hash }: `catalogue_revision` of an answer, which names the parts it was computed from.
Json RenderRevisionName(const catalog::Revision& revision);
// { number, hash, at, who, what }.
Json RenderRevision(const catalog::Revision& revision);
// { id, before, after }, each a part or null.
Json RenderChange(const catalog::Change& change);
// { "outliers": [{ id, family, field, value, family_median, robust_z }],
// "gaps": [{ family, field, blocks, parts, missing: ids }] }.
Json RenderPlausibility(const std::vector<catalog::Outlier>& outliers,
                        const std::vector<catalog::Gap>& gaps);

}  // namespace plenum::api

#endif  // PLENUM_API_SERVICES_H_
