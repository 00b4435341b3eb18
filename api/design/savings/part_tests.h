// The tests of the parts of designs that would settle anything.
#ifndef PLENUM_API_DESIGN_SAVINGS_PART_TESTS_H_
#define PLENUM_API_DESIGN_SAVINGS_PART_TESTS_H_

#include <string>
#include <vector>

#include "api/design/read/worst_parts.h"
#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// A test of one part, with the numbers that it would settle.
struct PartTest {
  const catalog::Part* part;
  std::string protocol;
  std::vector<std::string> numbers;
  double width = 0.0;  // half-width of the least certain of them
};

// The least certain first; `rows` must outlive them.
std::vector<PartTest> TestsOf(const std::vector<const optimizer::Design*>& designs,
                              const std::vector<catalog::Part>& rows, const Tolerance& tolerance);

// The numbers of these tests; what they point to must outlive it.
Settled SettledBy(std::vector<const PartTest*> tests);

// { "part", "family", "protocol", "numbers" }
Json RenderTest(const PartTest& test);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_SAVINGS_PART_TESTS_H_
