// A list that came of another one by changes is the list that is read anew: the same parts, the
// same pages of any query, the same finds.
#include "api/catalogue/rows/revision_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "api/catalogue/part_query.h"
#include "api/catalogue/part_table.h"
#include "catalog/fields/fields.h"
#include "tests/catalog/samples.h"

namespace plenum::api {
namespace revision_rows_test {

using catalog::Part;
using State = std::map<std::string, Part>;

PartVector VectorOf(const State& state) {
  auto parts = std::make_shared<std::vector<Part>>();
  for (const auto& [id, part] : state) parts->push_back(part);
  return parts;
}

Part Draw(const std::string& id, std::mt19937& random) {
  const auto families = catalog::Families();
  const auto any = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  Part part = catalog::AnyPart(families[any(families.size())], id, random);
  constexpr const char* kMakers[] = {"Festo", "SMC", "Parker Hannifin", "new maker", "A"};
  constexpr const char* kNumbers[] = {"VQ110-5L", "X 7", "MHE2", "100", "zz-9"};
  part.manufacturer = kMakers[any(5)];
  part.part_number = kNumbers[any(5)] + std::to_string(any(4));
  part.notes = any(2) == 0 ? "fast valve" : "";
  part.series = any(3) == 0 ? kMakers[any(5)] : "";
  if (any(3) == 0) part.orderable = any(2) == 0;
  return part;
}

// Some ids come, some change, some go.
catalog::PartChanges Change(State& state, std::mt19937& random) {
  catalog::PartChanges changes;
  const int count = std::uniform_int_distribution<>(0, 6)(random);
  for (int i = 0; i < count; ++i) {
    const std::string id = "p" + std::to_string(std::uniform_int_distribution<>(0, 60)(random));
    if (changes.contains(id)) continue;
    const bool goes = std::uniform_int_distribution<>(0, 2)(random) == 0;
    state.erase(id);
    changes[id] = goes ? std::nullopt : std::optional(Draw(id, random));
    if (!goes) state[id] = *changes[id];
  }
  return changes;
}

std::string PageOf(const std::multimap<std::string, std::string>& asked, const PartTable& table) {
  const auto query = ParsePartQuery(asked);
  const auto page = RenderPage(std::get<PartQuery>(query), {3, "abc", "", "", ""}, table);
  return std::get<std::string>(page);
}

TEST(PartRows, AListWithChangesIsTheListReadAnew) {
  const std::vector<std::multimap<std::string, std::string>> queries = {
      {{"limit", "1000"}},
      {{"facets", "true"}, {"sort", "-mass_kg"}},
      {{"sort", "part_number"}, {"priced", "true"}},
      {{"sort", "-series"}},
      {{"manufacturer", "new maker"}},
      {{"q", "festo"}},
      {{"q", "vq110 5l"}, {"facets", "true"}},
      {{"q", "fast val"}, {"sort", "-manufacturer"}},
      {{"orderable", "false"}, {"sort", "match"}, {"q", "a"}},
      {{"estimated_share_min", "0.1"}, {"sort", "-estimated_share"}},
      {{"family", "valve"}, {"mass_kg_max", "1"}, {"facets", "true"}}};
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    State state;
    for (int i = 0; i < 5 * trial; ++i)
      state["p" + std::to_string(i)] = Draw("p" + std::to_string(i), random);
    auto table = std::make_unique<PartTable>(VectorOf(state));
    for (int write = 0; write < 8; ++write) {
      table = std::make_unique<PartTable>(*table, Change(state, random));
      const PartVector fresh = VectorOf(state);
      const PartTable anew(fresh);
      ASSERT_EQ(*table->rows().All(), *fresh);
      for (const auto& query : queries) ASSERT_EQ(PageOf(query, *table), PageOf(query, anew));
      for (const Part& part : *fresh) {
        ASSERT_NE(table->rows().Find(part.id), nullptr);
        ASSERT_EQ(*table->rows().Find(part.id), part);
      }
      ASSERT_EQ(table->rows().Find("none"), nullptr);
    }
  }
}

// An older list keeps what it shows, also when the one that it came of is gone.
TEST(PartRows, AListOutlivesTheOneItCameOf) {
  std::mt19937 random(11);
  State state;
  for (const char* id : {"a", "b", "c"}) state[id] = Draw(id, random);
  auto first = std::make_unique<PartTable>(VectorOf(state));
  State changed = state;
  changed["b"].manufacturer = "a maker of whom nobody has heard before";
  const auto second = std::make_unique<PartTable>(
      *first, catalog::PartChanges{{"b", changed["b"]}, {"c", std::nullopt}});
  changed.erase("c");
  const auto third = std::make_unique<PartTable>(*second, catalog::PartChanges{{"b", state["b"]}});
  first.reset();
  EXPECT_EQ(*second->rows().All(), *VectorOf(changed));
  EXPECT_EQ(PageOf({{"manufacturer", changed["b"].manufacturer}, {"limit", "5"}}, *second),
            PageOf({{"manufacturer", changed["b"].manufacturer}, {"limit", "5"}},
                   PartTable(VectorOf(changed))));
  state.erase("c");
  EXPECT_EQ(*third->rows().All(), *VectorOf(state));
}

}  // namespace revision_rows_test
}  // namespace plenum::api
