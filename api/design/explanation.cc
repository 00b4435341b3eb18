#include "api/design/explanation.h"

#include <chrono>

namespace plenum::api {

std::optional<ExplainRequest> ReadExplain(Reader& request) {
  auto reader = request.OptionalObject("explain");
  if (!reader) return std::nullopt;
  ExplainRequest explain;
  explain.prices = reader->Bool("prices", explain.prices);
  explain.ranks = reader->Integer("ranks", 0, 20, explain.ranks);
  explain.time_limit_s = reader->Number("time_limit_s", {0.01, 3600}, explain.time_limit_s);
  reader->Finish();
  return explain;
}

Json RenderPrice(const optimizer::Price& price, double objective) {
  const bool known = price.objective.has_value();
  return {{"requirement", price.requirement},
          {"required", Number(price.required)},
          {"loosened", Number(price.loosened)},
          {"status", optimizer::Name(price.status)},
          {"objective", known ? Number(*price.objective) : Json(nullptr)},
          {"lower_bound", known ? Number(price.lower_bound) : Json(nullptr)},
          {"saving", known ? Number(objective - *price.objective) : Json(nullptr)},
          {"saving_share",
           known && objective > 0.0 ? Number(1.0 - *price.objective / objective) : Json(nullptr)}};
}

Json RenderFlip(const optimizer::Flip& flip) {
  Json parts = Json::array();
  for (const optimizer::PartFlip& part : flip.parts)
    parts.push_back({{"family", optimizer::Name(part.family)},
                     {"id", part.id},
                     {"reduction_share", Number(part.share)},
                     {"confirmed", part.confirmed}});
  Json requirements = Json::array();
  for (const optimizer::RequirementFlip& requirement : flip.requirements)
    requirements.push_back({{"requirement", requirement.requirement},
                            {"required", Number(requirement.required)},
                            {"tightened", Number(requirement.tightened)},
                            {"confirmed", requirement.confirmed}});
  return {{"objective_gap", Number(flip.objective_gap)},
          {"parts", std::move(parts)},
          {"requirements", std::move(requirements)},
          {"complete", flip.complete}};
}

void AddExplanation(const ExplainRequest& request, const optimizer::Problem& problem,
                    const optimizer::Answer& answer, optimizer::SearchOptions options,
                    Json& document) {
  if (answer.designs.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  options.time_limit_s = request.time_limit_s;
  if (request.prices) {
    if (request.ranks > 1) options.time_limit_s *= 0.5;
    Json prices = Json::array();
    for (const optimizer::Price& price : optimizer::FindPrices(problem, options))
      prices.push_back(RenderPrice(price, answer.designs.front().objective));
    document["prices"] = std::move(prices);
  }
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
  options.time_limit_s = request.time_limit_s - used.count();
  for (const optimizer::Flip& flip :
       optimizer::FindFlips(problem, answer.designs, request.ranks, options))
    document["designs"][static_cast<std::size_t>(flip.rank) - 1]["to_be_first"] = RenderFlip(flip);
}

}  // namespace plenum::api
