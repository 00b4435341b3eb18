// One design as JSON.
#ifndef PLENUM_API_DESIGN_DESIGN_DOCUMENT_H_
#define PLENUM_API_DESIGN_DESIGN_DOCUMENT_H_

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

using Rows = std::map<std::string, const catalog::Part*>;  // by id
Rows RowsOf(const std::vector<catalog::Part>& parts);

inline Json OrNull(const std::optional<double>& value) {
  return value ? Number(*value) : Json(nullptr);
}

// What of a design rests on estimates.
struct Quality {
  double mass_estimated_kg = 0.0;
  std::set<std::string> estimated;  // "family.field"
  bool flow_estimated = false;
  std::set<std::string> not_orderable;  // ids of classes of parts and the like
};

Quality QualityOf(const optimizer::Design& design, const optimizer::Problem& problem,
                  const Rows& rows);

// Settings, totals, performance and margins of a design.
Json RenderFigures(const optimizer::Design& design, const optimizer::Problem& problem);

// What `verify` reads of a design.
Json RenderClaim(const optimizer::Design& design, int rank, const optimizer::Problem& problem,
                 const Rows& rows);

// All of it.
Json RenderDesign(const optimizer::Design& design, int rank, const Quality& quality,
                  const optimizer::Problem& problem, const Rows& rows);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_DESIGN_DOCUMENT_H_
