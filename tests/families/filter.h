// A family that plenum does not have: filters, one for all lines of a source. Its table of fields
// and all that is its own stand in filter.cc, which also adds one line to each list of families.
#ifndef PLENUM_TESTS_FAMILIES_FILTER_H_
#define PLENUM_TESTS_FAMILIES_FILTER_H_

#include <array>
#include <string>
#include <vector>

#include "catalog/fields/part.h"
#include "optimizer/choices/corner.h"
#include "optimizer/choices/plant/part_numbers.h"

namespace plenum::test {

// One beyond the last of plenum's.
inline constexpr auto kFilter =
    static_cast<optimizer::Family>(static_cast<int>(optimizer::Family::kVacuumReservoir) + 1);

struct Filter {
  model::PartBasics basics;
  std::string thread;
  model::FlowElement flow;  // all lines cross it
  double pressure_max_pa = 0.0;
};

// Those of the catalogue; a family of plenum has a list in model::Parts.
std::vector<Filter>& Filters();
Filter ToFilter(const catalog::Part& row, const model::Ambient& ambient);

struct FilterCorner {
  optimizer::Amounts amounts;
  double objective = 0.0;
  optimizer::Kinds threads = 0;
  model::FlowElement flow;
  double pressure_max_pa = 0.0;
};

void Widen(FilterCorner& a, const FilterCorner& b);
std::array<double, 3> SplitKeys(const FilterCorner& c);
optimizer::Kinds MatingClass(const FilterCorner& c);
void SetNumbers(const optimizer::PartNumbers& numbers, FilterCorner& corner);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_FAMILIES_FILTER_H_
