#include "api/design/read/stock_volume.h"

#include <algorithm>

#include "api/design/read/selection.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {

using optimizer::Family;

bool IsMadeToMeasure(const optimizer::Choice& choice) {
  return choice.id == kCustomReservoir && optimizer::SpecOf(choice.family).made_to_measure;
}

const model::Reservoir& StockOf(const optimizer::Problem& problem,
                                const optimizer::Choice& choice) {
  const std::vector<model::Reservoir>& parts =
      choice.family == Family::kTank ? problem.parts.tanks : problem.parts.reservoirs;
  return *std::find_if(parts.begin(), parts.end(),
                       [&](const model::Reservoir& part) { return part.basics.id == choice.id; });
}

optimizer::Design WithReservoirVolume(optimizer::Design design, const optimizer::Problem& problem) {
  for (const optimizer::Choice& choice : design.parts)
    if ((choice.family == Family::kReservoir || choice.family == Family::kTank) &&
        !IsMadeToMeasure(choice))
      design.settings.reservoir_volume_m3 = choice.quantity * StockOf(problem, choice).volume_m3;
  return design;
}

}  // namespace plenum::api
