#include "api/design/savings/part_tests.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "api/protocol/protocols.h"

namespace plenum::api {

std::vector<PartTest> TestsOf(const std::vector<const optimizer::Design*>& designs,
                              const std::vector<catalog::Part>& rows, const Tolerance& tolerance) {
  std::map<std::string, const catalog::Part*> by_id;
  for (const catalog::Part& row : rows) by_id[row.id] = &row;
  std::vector<PartTest> tests;
  std::set<std::string> seen;
  for (const optimizer::Design* design : designs)
    for (const optimizer::Choice& choice : design->parts) {
      const auto row = by_id.find(choice.id);
      if (row == by_id.end() || !seen.insert(choice.id).second) continue;
      for (const Protocol& protocol : Protocols()) {
        if (protocol.family != row->second->family) continue;
        PartTest test{row->second, std::string(protocol.name), {}};
        for (const std::string_view number : protocol.numbers) {
          const double width = HalfWidth(*row->second, number, tolerance);
          if (width > 0.0) test.numbers.emplace_back(number);
          test.width = std::max(test.width, width);
        }
        if (!test.numbers.empty()) tests.push_back(std::move(test));
      }
    }
  std::stable_sort(tests.begin(), tests.end(),
                   [](const PartTest& a, const PartTest& b) { return a.width > b.width; });
  return tests;
}

Settled SettledBy(std::vector<const PartTest*> tests) {
  return [tests = std::move(tests)](const catalog::Part& row, std::string_view field) {
    return std::any_of(tests.begin(), tests.end(), [&](const PartTest* test) {
      return test->part->id == row.id &&
             std::find(test->numbers.begin(), test->numbers.end(), field) != test->numbers.end();
    });
  };
}

Json RenderTest(const PartTest& test) {
  return {{"part", test.part->id},
          {"family", test.part->family},
          {"protocol", test.protocol},
          {"numbers", test.numbers}};
}

}  // namespace plenum::api
