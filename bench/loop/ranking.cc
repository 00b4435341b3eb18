#include "bench/loop/ranking.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/read/selection.h"

namespace plenum::bench {
namespace {

using api::Json;
using Rows = std::vector<catalog::Part>;

constexpr double kRounding = 1e-9;  // of a margin: answers have 12 digits

[[noreturn]] void Refuse(const api::Errors& errors) {
  throw std::runtime_error(errors[0].pointer + " " + errors[0].detail);
}

// The design as it was bought. A reservoir of the catalogue has its true volume, one that is made
// to measure the volume that was asked for.
Json Bought(Json design) {
  const Json& parts = design.at("parts");
  if (std::none_of(parts.begin(), parts.end(),
                   [](const Json& row) { return row.at("id") == api::kCustomReservoir; }))
    design["settings"].erase("reservoir_volume_ml");
  return design;
}

Json Nominal(Json requirements) {
  requirements.erase("guarantee");
  return requirements;
}

}  // namespace

Json Rank(const Json& requirements, const Rows& rows) {
  auto request = api::ParseRequirements(requirements, rows);
  if (const auto* errors = std::get_if<api::Errors>(&request)) Refuse(*errors);
  const auto& asked = std::get<api::DesignRequest>(request);
  optimizer::SearchOptions options;
  options.time_limit_s = asked.time_limit_s;
  return api::AnswerRequest(asked, options, rows);
}

Json FirstOf(const Json& list) {
  return list.at("designs").empty() ? Json(nullptr) : list.at("designs").front();
}

bool SameParts(const Json& design, const Json& other) {
  const auto parts_of = [](const Json& of) {
    std::map<std::string, double> parts;
    if (of.is_null()) return parts;
    for (const Json& row : of.at("parts"))
      parts[row.at("group").dump() + " " + row.at("id").get<std::string>()] +=
          row.at("quantity").get<double>();
    return parts;
  };
  return parts_of(design) == parts_of(other);
}

Verdict Judge(const Json& requirements, const Json& design, const Rows& truth) {
  const auto parsed = api::RunEvaluation({{"schema", "evaluation/1"},
                                          {"requirements", Nominal(requirements)},
                                          {"design", Bought(design)}},
                                         truth, {});
  if (const auto* errors = std::get_if<api::Errors>(&parsed))
    return {.missed = errors->front().pointer + " " + errors->front().detail};
  const Json& answer = std::get<Json>(parsed);
  if (answer.at("works") != true) return {.missed = "works"};
  Verdict verdict{.meets = true};
  for (const Json& margin : answer.at("margins")) {
    const double relative = margin.at("relative_margin").get<double>();
    if (relative >= -kRounding || relative >= verdict.margin) continue;
    verdict.meets = false;
    verdict.margin = relative;
    verdict.missed = margin.at("requirement").get<std::string>();
  }
  verdict.objective = answer.at("totals").at("mass_kg").get<double>();
  return verdict;
}

std::optional<double> BestOf(const Json& requirements, const Rows& truth) {
  Json nominal = Nominal(requirements);
  nominal["ranking"]["count"] = 1;
  const Json answer = Rank(nominal, truth);
  if (answer.at("status") != "optimal") return {};
  return answer.at("designs").front().at("totals").at("mass_kg").get<double>();
}

}  // namespace plenum::bench
