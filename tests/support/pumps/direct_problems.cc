#include "tests/support/pumps/direct_problems.h"

#include "tests/support/small_catalogue.h"

namespace plenum::test {

optimizer::Problem DirectPumpProblem(std::uint64_t seed, double severity, int groups) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = {optimizer::Configuration::kDirectPump};
  draw.severity = severity;
  draw.groups = groups;
  draw.simultaneous = groups == 1;
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 0, 0, 0, 4, 3, 0}
                          : CatalogueSize{2, 2, 3, 0, 0, 0, 3, 2, 0};
  optimizer::Problem problem = RandomProblem(draw);
  problem.frequency_hz *= 0.5;
  return problem;
}

optimizer::Problem WithFeed(optimizer::Problem problem, optimizer::PumpFeed feed) {
  problem.pump_feed = feed;
  for (optimizer::ActuatorGroup& group : problem.groups)
    group.fed_past_valve = feed == optimizer::PumpFeed::kPerActuator;
  return problem;
}

}  // namespace plenum::test
