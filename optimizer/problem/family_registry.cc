#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {

std::span<const FamilySpec> Families() {
  static const std::vector<FamilySpec> families = OwnFamilies();
  return families;
}

}  // namespace plenum::optimizer
