#include "api/design/revised_ranking.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include "api/json/units.h"
#include "api/measure/model_document.h"
#include "api/simulate/effects.h"
#include "optimizer/evaluate/relaxation.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {
namespace {

constexpr double kNominalShare = 0.3;  // of the time limit

using PartsKey = std::vector<std::pair<std::string, double>>;

PartsKey KeyOf(const optimizer::Design& design) {
  PartsKey key;
  for (const optimizer::Choice& part : design.parts) key.emplace_back(part.id, part.quantity);
  return key;
}

std::map<PartsKey, int> RanksOf(const std::vector<optimizer::Design>& designs) {
  std::map<PartsKey, int> ranks;
  for (std::size_t i = 0; i < designs.size(); ++i)
    ranks.emplace(KeyOf(designs[i]), static_cast<int>(i) + 1);
  return ranks;
}

Json PartIds(const optimizer::Design& design) {
  Json ids = Json::array();
  for (const optimizer::Choice& part : design.parts) ids.push_back(part.id);
  return ids;
}

// What the design misses most under the problem's effects, at its own settings; null where that is
// not known.
Json WhyDropped(const optimizer::Problem& problem, const optimizer::Problem& relaxed,
                const optimizer::Design& design, const std::function<bool()>& stop) {
  const auto margins = optimizer::MarginsOf(problem, relaxed, design, stop);
  if (stop && stop()) return nullptr;
  if (!margins) return "a stroke is never completed";
  const auto worst = std::min_element(
      margins->begin(), margins->end(),
      [](const auto& a, const auto& b) { return a.relative_margin < b.relative_margin; });
  if (worst == margins->end() || worst->relative_margin >= 0.0) return nullptr;
  return {{"requirement", worst->requirement},
          {"required", Number(worst->required)},
          {"achieved", Number(worst->achieved)}};
}

Json Compare(const optimizer::Problem& problem, const std::vector<optimizer::Design>& revised,
             const optimizer::Answer& nominal, const std::function<bool()>& stop) {
  const std::map<PartsKey, int> nominal_ranks = RanksOf(nominal.designs);
  const std::map<PartsKey, int> ranks = RanksOf(revised);
  Json designs = Json::array();
  for (std::size_t i = 0; i < revised.size(); ++i) {
    const auto found = nominal_ranks.find(KeyOf(revised[i]));
    Json row = {{"rank", i + 1}, {"nominal_rank", nullptr}, {"nominal", nullptr}};
    if (found != nominal_ranks.end()) {
      const optimizer::Design& same = nominal.designs[found->second - 1];
      row["nominal_rank"] = found->second;
      row["nominal"] = {
          {"objective", Number(same.objective)},
          {"source_pressure_kpa_gauge",
           Number(KpaGaugeFromPa(same.settings.source_pressure_pa, problem.ambient))}};
    }
    designs.push_back(std::move(row));
  }
  const optimizer::Problem relaxed = optimizer::Relaxed(problem);
  Json dropped = Json::array();
  for (std::size_t i = 0; i < nominal.designs.size(); ++i) {
    const optimizer::Design& design = nominal.designs[i];
    if (ranks.contains(KeyOf(design))) continue;
    dropped.push_back({{"nominal_rank", i + 1},
                       {"objective", Number(design.objective)},
                       {"parts", PartIds(design)},
                       {"why", WhyDropped(problem, relaxed, design, stop)}});
  }
  return {{"status", optimizer::Name(nominal.status)},
          {"designs", std::move(designs)},
          {"dropped", std::move(dropped)}};
}

}  // namespace

Json AnswerRevised(const DesignRequest& request, const optimizer::SearchOptions& options,
                   const std::vector<catalog::Part>& parts) {
  const auto start = std::chrono::steady_clock::now();
  optimizer::SearchOptions nominal_options = options;
  nominal_options.progress = nullptr;
  nominal_options.time_limit_s *= kNominalShare;
  const optimizer::Answer nominal =
      optimizer::Search(optimizer::WithoutEffects(request.problem), nominal_options);
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;

  optimizer::SearchOptions rest = options;
  rest.time_limit_s = std::max(0.0, options.time_limit_s - used.count());
  if (options.progress)
    rest.progress = [&](optimizer::Progress progress) {
      progress.seconds += used.count();
      progress.lower_bound = 0.0;  // a revised search is proved at its end only
      options.progress(progress);
    };
  ListAnswer list = AnswerList(request, rest, parts);
  Json model = RenderModelRevision(*request.model, false);
  model["effects"] = RenderEffects(request.problem.groups.front().effects);
  model["proved"] = optimizer::RelaxationIsProved(request.problem);
  list.document["model"] = std::move(model);
  list.document["against_nominal"] =
      Compare(request.problem, list.answer.designs, nominal, options.cancelled);
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  list.document["seconds"] = Number(all.count());
  return std::move(list.document);
}

}  // namespace plenum::api
