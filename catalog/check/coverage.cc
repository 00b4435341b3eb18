#include "catalog/check/coverage.h"

#include <algorithm>
#include <numeric>

#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace {

void Add(const Part& part, Coverage& coverage) {
  const std::array<int, 5> values = CountValues(part);
  ++coverage.parts;
  coverage.values += std::accumulate(values.begin(), values.end(), 0);
  coverage.estimated += values[static_cast<std::size_t>(Provenance::kEstimated)];
  if (!HasPrice(part)) coverage.without_price.push_back(part.id);
  if (part.documents.empty()) coverage.without_document.push_back(part.id);
}

}  // namespace

std::array<int, 5> CountValues(const Part& part) {
  std::array<int, 5> values{};
  const auto count = [&](Provenance provenance) { ++values[static_cast<std::size_t>(provenance)]; };
  for (const auto& [field, number] : part.numbers) count(number.provenance);
  for (const auto& [field, text] : part.texts) count(text.provenance);
  if (part.curve) count(part.curve->free_air_provenance), count(part.curve->current_provenance);
  return values;
}

bool HasPrice(const Part& part) {
  return std::any_of(part.numbers.begin(), part.numbers.end(),
                     [](const auto& one) { return one.first.starts_with("price_eur"); });
}

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
