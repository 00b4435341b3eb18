#include "catalog/check/coverage.h"

#include <algorithm>

#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace {

void Add(const Part& part, Coverage& coverage) {
  const auto count = [&](Provenance provenance) {
    ++coverage.values;
    coverage.estimated += provenance == Provenance::kEstimated;
  };
  ++coverage.parts;
  for (const auto& [field, number] : part.numbers) count(number.provenance);
  for (const auto& [field, text] : part.texts) count(text.provenance);
  if (part.curve) count(part.curve->free_air_provenance), count(part.curve->current_provenance);
  const bool has_price = std::any_of(part.numbers.begin(), part.numbers.end(), [](const auto& one) {
    return one.first.starts_with("price_eur");
  });
  if (!has_price) coverage.without_price.push_back(part.id);
  if (part.documents.empty()) coverage.without_document.push_back(part.id);
}

}  // namespace

std::vector<Coverage> CoverageOf(const std::vector<Part>& parts) {
  std::vector<Coverage> all;
  for (const Family& family : Families()) {
    Coverage coverage;
    coverage.family = family.name;
    for (const Part& part : parts)
      if (part.family == family.name) Add(part, coverage);
    if (coverage.parts > 0) all.push_back(std::move(coverage));
  }
  return all;
}

}  // namespace plenum::catalog
