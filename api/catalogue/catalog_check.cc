#include "api/catalogue/catalog_check.h"

namespace plenum::api {

CatalogCheck CheckParts(const std::vector<catalog::Part>& parts) {
  return {catalog::FindDuplicates(parts), catalog::FindOutliers(parts), catalog::FindGaps(parts),
          catalog::CoverageOf(parts)};
}

Json RenderCheck(const CatalogCheck& check) {
  Json json = {{"duplicates", Json::array()},
               {"outliers", Json::array()},
               {"gaps", Json::array()},
               {"families", Json::array()}};
  for (const auto& duplicates : check.duplicates)
    json["duplicates"].push_back(
        {{"family", duplicates.family}, {"why", duplicates.why}, {"ids", duplicates.ids}});
  for (const auto& outlier : check.outliers)
    json["outliers"].push_back({{"id", outlier.id},
                                {"family", outlier.family},
                                {"field", outlier.field},
                                {"value", Number(outlier.value)},
                                {"family_median", Number(outlier.median)},
                                {"robust_z", Number(outlier.robust_z)}});
  for (const auto& gap : check.gaps)
    json["gaps"].push_back({{"family", gap.family},
                            {"field", gap.field},
                            {"blocks", gap.blocks},
                            {"parts", gap.parts},
                            {"missing", gap.ids}});
  for (const auto& family : check.coverage) {
    const double share =
        family.values > 0 ? static_cast<double>(family.estimated) / family.values : 0.0;
    json["families"].push_back({{"family", family.family},
                                {"parts", family.parts},
                                {"without_price", family.without_price},
                                {"without_document", family.without_document},
                                {"values", family.values},
                                {"estimated", family.estimated},
                                {"estimated_share", Number(share)}});
  }
  return json;
}

}  // namespace plenum::api
