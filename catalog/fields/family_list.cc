#include "catalog/fields/fields.h"

namespace plenum::catalog {

std::span<const Family> Families() {
  static const std::vector<Family> families = OwnFamilies();
  return families;
}

}  // namespace plenum::catalog
