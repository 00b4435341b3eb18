// Parts for a person.
#ifndef PLENUM_SERVER_TEXT_CATALOG_H_
#define PLENUM_SERVER_TEXT_CATALOG_H_

#include <string>
#include <vector>

#include "api/services.h"

namespace plenum::server {

// One line a part.
std::string PartsText(const std::vector<catalog::Part>& parts);
// One part with every number, where it comes from, and its curve.
std::string PartText(const catalog::Part& part);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_TEXT_CATALOG_H_
