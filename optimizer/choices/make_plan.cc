#include "optimizer/choices/make_plan.h"

#include "optimizer/choices/planter.h"

namespace plenum::optimizer {

std::unique_ptr<Plan> MakePlan(const Problem& problem, Configuration configuration,
                               bool name_left_out, const std::function<bool()>& stop) {
  return Planter(problem, configuration, name_left_out, stop).Plant();
}

}  // namespace plenum::optimizer
