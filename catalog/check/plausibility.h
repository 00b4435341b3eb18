// What is allowed, but looks wrong or will be missed: for a person who tends the catalogue.
#ifndef PLENUM_CATALOG_CHECK_PLAUSIBILITY_H_
#define PLENUM_CATALOG_CHECK_PLAUSIBILITY_H_

#include <string>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// A number far from those of its family, which no other maker has.
struct Outlier {
  std::string id, family, field;
  double value = 0.0;
  double median = 0.0;    // of the family
  double robust_z = 0.0;  // signed
  bool operator==(const Outlier&) const = default;
};

// Numbers with |z| > 3.5 on the logarithm, by family, field and id:
//
//   z = (ln x − M) / max(1.4826 · median |ln x_i − M|, ln 1.5),   M = median ln x_i
//
// (Iglewicz and Hoaglin, How to Detect and Handle Outliers, 1993; 1.4826 makes the median deviation
// a standard deviation where the logarithms are normal). The floor keeps fields in which most parts
// agree from calling every other value wrong: less than a factor 4.1 off the median never counts.
// A number that a part of another maker has, too, to within a factor 1.5, does not count either:
// makers seldom make the same slip, but a family may hold parts of several kinds. Numbers ≤ 0 and
// fields with fewer than eight numbers in the family are not judged. `mass_kg / body_volume_ml`,
// the density, is judged as a field too: it shows grams taken for kilograms.
std::vector<Outlier> FindOutliers(const std::vector<Part>& parts);

// A field without which a part does not take part in some ranking.
struct Gap {
  std::string family, field;
  std::string blocks;            // what it is needed for
  std::vector<std::string> ids;  // parts that lack it
  int parts = 0;                 // of the family
  bool operator==(const Gap&) const = default;
};

// Required fields are Validate's concern; of the others only prices keep a part out of a ranking,
// of those that limit or minimise the cost.
std::vector<Gap> FindGaps(const std::vector<Part>& parts);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_CHECK_PLAUSIBILITY_H_
