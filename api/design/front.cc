#include "api/design/front.h"

#include <cmath>

namespace plenum::api {
namespace {

Json RenderUnexplored(const optimizer::Front& front, const optimizer::Unexplored& region) {
  Json limits = Json::object();
  for (std::size_t i = 0; i < front.amounts.size(); ++i)
    if (std::isfinite(region.limits[i]))
      limits[std::string(optimizer::Name(front.amounts[i])) + "_max"] = Number(region.limits[i]);
  return {{"limits", limits},
          {std::string(optimizer::Name(region.least_of)) + "_min", Number(region.least)}};
}

}  // namespace

void AddFront(const optimizer::Front& front, Json& document) {
  Json points = Json::array();
  for (std::size_t i = 0; i < front.answer.designs.size(); ++i) {
    Json objectives = Json::object();
    for (const optimizer::Amount amount : front.amounts)
      objectives[optimizer::Name(amount)] =
          Number(optimizer::Of(amount, front.answer.designs[i].totals));
    points.push_back({{"objectives", objectives}, {"rank", static_cast<int>(i) + 1}});
  }
  document["front"] = std::move(points);
  Json unexplored = Json::array();
  for (const optimizer::Unexplored& region : front.unexplored)
    unexplored.push_back(RenderUnexplored(front, region));
  document["front_proof"] = {{"complete", front.answer.proof.complete},
                             {"resolution", Number(front.resolution)},
                             {"searches", front.searches},
                             {"proved", front.proved},
                             {"unexplored", std::move(unexplored)}};
}

}  // namespace plenum::api
