#include "api/design/robustness.h"

#include <algorithm>
#include <cmath>

namespace plenum::api {
namespace {

// 95 % interval of a probability of which `met` of `draws` trials were seen (Wilson 1927).
Json WilsonInterval(int met, int draws) {
  if (draws == 0) return Json::array({0.0, 1.0});
  constexpr double kZ = 1.959964;
  const double n = draws, share = met / n, z2 = kZ * kZ / n;
  const double centre = (share + z2 / 2.0) / (1.0 + z2);
  const double half = kZ * std::sqrt((share * (1.0 - share) + z2 / 4.0) / n) / (1.0 + z2);
  return Json::array({Number(std::max(0.0, centre - half)), Number(std::min(1.0, centre + half))});
}

Json Share(int count, int draws) {
  return draws == 0 ? Json(nullptr) : Number(static_cast<double>(count) / draws);
}

}  // namespace

std::optional<RobustRequest> ReadRobust(Reader& request, std::optional<double> probability_min) {
  auto reader = request.OptionalObject("robust");
  if (!reader && !probability_min) return std::nullopt;
  RobustRequest robust;
  robust.options.probability_min = probability_min;
  if (!reader) return robust;
  robust.options.draws = reader->Integer("draws", 1, 100'000, robust.options.draws);
  robust.options.time_limit_s =
      reader->Number("time_limit_s", {0.01, 3600}, robust.options.time_limit_s);
  robust.seed = reader->Integer("seed", 0, 1'000'000'000, robust.seed);
  robust.tolerance = ReadTolerance(*reader);
  reader->Finish();
  return robust;
}

void AddRobustness(const RobustRequest& request, const optimizer::RobustAnswer& result,
                   Json& document) {
  Json& designs = document.at("designs");
  for (std::size_t i = 0; i < result.robustness.size(); ++i) {
    const optimizer::Robustness& robustness = result.robustness[i];
    designs[i]["robustness"] = {{"probability", Share(robustness.met, result.draws)},
                                {"probability_ci95", WilsonInterval(robustness.met, result.draws)},
                                {"share_rank_1", Share(robustness.first, result.draws)}};
  }
  document["robust"] = {
      {"draws", result.draws},
      {"draws_asked", request.options.draws},
      {"seed", request.seed},
      {"tolerance", RenderTolerance(request.tolerance)},
      {"probability_min",
       request.options.probability_min ? Json(*request.options.probability_min) : Json(nullptr)},
      {"left_out", result.below}};
}

}  // namespace plenum::api
