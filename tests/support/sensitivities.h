// Derivatives of a response by numbers that move alone.
#ifndef PLENUM_TESTS_SUPPORT_SENSITIVITIES_H_
#define PLENUM_TESTS_SUPPORT_SENSITIVITIES_H_

#include <span>
#include <vector>

#include "model/simulate/sensitivity.h"

namespace plenum::model {

// SimulateAlongDirections, each of `parameters` a direction of its own.
inline SensitivityResponse SimulateWithSensitivities(const Rig& rig, const SimulateOptions& options,
                                                     std::span<const double* const> parameters) {
  std::vector<Direction> directions;
  for (const double* number : parameters) directions.push_back({{number, 1.0}});
  return SimulateAlongDirections(rig, options, directions);
}

}  // namespace plenum::model

#endif  // PLENUM_TESTS_SUPPORT_SENSITIVITIES_H_
