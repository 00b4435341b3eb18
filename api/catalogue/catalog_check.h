// What a person who tends the catalogue should look at, as JSON.
#ifndef PLENUM_API_CATALOGUE_CATALOG_CHECK_H_
#define PLENUM_API_CATALOGUE_CATALOG_CHECK_H_

#include <vector>

#include "api/json/json.h"
#include "catalog/check/coverage.h"
#include "catalog/check/duplicates.h"
#include "catalog/check/plausibility.h"

namespace plenum::api {

struct CatalogCheck {
  std::vector<catalog::Duplicates> duplicates;
  std::vector<catalog::Outlier> outliers;
  std::vector<catalog::Gap> gaps;
  std::vector<catalog::Coverage> coverage;
};
CatalogCheck CheckParts(const std::vector<catalog::Part>& parts);

// { "duplicates": [{ family, why, ids }],
//   "outliers": [{ id, family, field, value, family_median, robust_z }],
//   "gaps": [{ family, field, blocks, parts, missing: ids }],
//   "families": [{ family, parts, without_price: ids, without_document: ids, values, estimated,
//                  estimated_share }] }.
Json RenderCheck(const CatalogCheck& check);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_CATALOG_CHECK_H_
