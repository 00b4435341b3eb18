// Why a given design is not the first of a ranked list: what it misses, which of its parts costs
// how much, and what an exchange of one part would do.
#ifndef PLENUM_API_DESIGN_GIVEN_WHY_NOT_FIRST_H_
#define PLENUM_API_DESIGN_GIVEN_WHY_NOT_FIRST_H_

#include <functional>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

struct Compared {
  const optimizer::Design& given;
  const std::optional<optimizer::Design>& as_given;  // at its settings, where it works there
  const optimizer::Design& first;                    // of the list, evaluated today
};

// The field `why_not_first` of an evaluation. The given design counts with the settings that suit
// its parts best, where any meet the requirements; the shares of the parts in the difference of the
// objectives, and of the energy, add up to it.
Json WhyNotFirst(const optimizer::Problem& problem, const std::vector<catalog::Part>& catalogue,
                 const Compared& compared, const std::function<bool()>& stop);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_WHY_NOT_FIRST_H_
