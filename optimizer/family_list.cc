// The registry alone, so that a program can be linked with one that has a further family.
#include "optimizer/families.h"

namespace plenum::optimizer {

std::span<const FamilySpec> Families() {
  static const std::vector<FamilySpec> families = OwnFamilies();
  return families;
}

}  // namespace plenum::optimizer
