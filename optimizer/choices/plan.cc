#include "optimizer/choices/plan.h"

#include <algorithm>

#include "model/physics/storage.h"

namespace plenum::optimizer {

bool Plan::empty() const {
  return std::any_of(slots.begin(), slots.end(),
                     [](const Slot& slot) { return slot.nodes->empty(); });
}

double GasLeft(const Problem& problem, Configuration configuration, double inlet_pa) {
  const double compressibility =
      configuration == Configuration::kCylinder ? model::CompressibilityOfAir(inlet_pa) : 1.0;
  return model::StandardVolume(inlet_pa / compressibility, problem.ambient.temperature_k);
}

}  // namespace plenum::optimizer
