#include "catalog/fields/half_width.h"

#include <algorithm>

namespace plenum::catalog {

double Tolerance::Of(Provenance provenance) const {
  switch (provenance) {
    case Provenance::kDatasheet:
      return datasheet;
    case Provenance::kThirdParty:
      return third_party;
    case Provenance::kDerived:
      return derived;
    case Provenance::kEstimated:
      return estimated;
    case Provenance::kMeasured:
      return measured;
  }
  return estimated;
}

double Tolerance::Of(Provenance provenance, const std::optional<double>& uncertainty) const {
  constexpr double kWidest = 0.95;
  return uncertainty ? std::min(2.0 * *uncertainty, kWidest) : Of(provenance);
}

}  // namespace plenum::catalog
