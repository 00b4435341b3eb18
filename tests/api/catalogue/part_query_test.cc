#include "api/catalogue/part_query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "catalog/fields/fields.h"
#include "tests/api/support.h"
#include "tests/catalog/samples.h"

namespace plenum::api {
namespace part_query_test {

using testing::ElementsAre;
using testing::HasSubstr;

using Query = std::multimap<std::string, std::string>;

// Reservoirs of mass i kg and volume 100·(i mod 3) mL, of two makers; every fourth has a price.
std::vector<catalog::Part> Shelf() {
  std::vector<catalog::Part> parts;
  for (int i = 1; i <= 9; ++i) {
    catalog::Part part = catalog::Reservoir("r" + std::to_string(i));
    part.manufacturer = i % 2 == 0 ? "Even" : "Odd";
    part.numbers["mass_kg"].value = i;
    part.numbers["internal_volume_ml"].value = 100 * (1 + i % 3);
    if (i % 4 == 0) part.numbers["price_eur"] = {10.0 * i, {}, ""};
    if (i % 4 == 0) part.texts["port"] = {i == 4 ? "1/4" : "1/8", {}, ""};
    parts.push_back(part);
  }
  return parts;
}

std::vector<std::string> Ids(const Query& query, const std::vector<catalog::Part>& parts) {
  const auto parsed = ParsePartQuery(query);
  for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
  std::vector<std::string> ids;
  if (const auto* value = std::get_if<PartQuery>(&parsed))
    for (const catalog::Part* part : Select(*value, PartTable(parts))) ids.push_back(part->id);
  return ids;
}

TEST(PartQuery, FiltersByRangesAndTexts) {
  const auto shelf = Shelf();
  EXPECT_THAT(Ids({{"mass_kg_min", "3"}, {"mass_kg_max", "5"}}, shelf),
              ElementsAre("r3", "r4", "r5"));
  EXPECT_THAT(Ids({{"mass_kg", "7"}}, shelf), ElementsAre("r7"));
  EXPECT_THAT(Ids({{"mass_kg_max", "4"}, {"manufacturer", "Even"}}, shelf),
              ElementsAre("r2", "r4"));
  EXPECT_THAT(Ids({{"price_eur_min", "0"}}, shelf), ElementsAre("r4", "r8"));  // missing: no match
  EXPECT_THAT(Ids({{"port", "1/8"}, {"family", "reservoir"}}, shelf), ElementsAre("r8"));
  EXPECT_THAT(Ids({{"pressure_max_kpa_gauge_max", "499"}}, shelf), ElementsAre());
  EXPECT_THAT(Ids({{"family", "valve"}}, shelf), ElementsAre());
}

TEST(PartQuery, FiltersAndCountsBySeriesAndOrderable) {
  auto shelf = Shelf();
  shelf[0].series = shelf[3].series = "Even E";
  shelf[1].orderable = true;
  shelf[2].orderable = shelf[3].orderable = false;
  EXPECT_THAT(Ids({{"series", "Even E"}}, shelf), ElementsAre(shelf[0].id, shelf[3].id));
  EXPECT_THAT(Ids({{"series", ""}}, shelf), ElementsAre());  // a part without one does not match
  EXPECT_THAT(Ids({{"orderable", "true"}}, shelf), ElementsAre(shelf[1].id));
  EXPECT_THAT(Ids({{"orderable", "false"}}, shelf), ElementsAre(shelf[2].id, shelf[3].id));
  const auto query = std::get<PartQuery>(ParsePartQuery({{"facets", "true"}}));
  const auto page = RenderPage(query, {5, "abc", "", "", ""}, PartTable(shelf));
  const Json texts = Json::parse(std::get<std::string>(page))["facets"]["texts"];
  EXPECT_EQ(texts["series"], Parse(R"({"Even E": 2})"));
  EXPECT_EQ(texts["orderable"], Parse(R"({"false": 2, "true": 1})"));
  EXPECT_THAT(DetailAt(ErrorsOf(ParsePartQuery({{"orderable", "maybe"}})), "/orderable"),
              HasSubstr("true or false"));
}

TEST(PartQuery, SortsBothWaysWithMissingValuesLast) {
  const auto shelf = Shelf();
  EXPECT_THAT(Ids({{"sort", "-mass_kg"}, {"mass_kg_max", "3"}}, shelf),
              ElementsAre("r3", "r2", "r1"));
  EXPECT_THAT(Ids({{"sort", "price_eur"}}, shelf),
              ElementsAre("r4", "r8", "r1", "r2", "r3", "r5", "r6", "r7", "r9"));
  EXPECT_THAT(Ids({{"sort", "-price_eur"}}, shelf),
              ElementsAre("r8", "r4", "r1", "r2", "r3", "r5", "r6", "r7", "r9"));
  EXPECT_THAT(Ids({{"sort", "-id"}, {"mass_kg_min", "8"}}, shelf), ElementsAre("r9", "r8"));
  EXPECT_THAT(Ids({{"sort", "manufacturer"}, {"mass_kg_max", "4"}}, shelf),
              ElementsAre("r2", "r4", "r1", "r3"));
  EXPECT_THAT(Ids({{"sort", "port"}, {"mass_kg_min", "4"}, {"mass_kg_max", "8"}}, shelf),
              ElementsAre("r4", "r8", "r5", "r6", "r7"));
}

// Against a plain filter and sort written here, over random parts of all families.
TEST(PartQuery, EveryNumberFieldOfEveryFamilyFiltersAndSorts) {
  std::mt19937 random(53);
  for (const catalog::Family& family : catalog::Families()) {
    std::vector<catalog::Part> parts;
    for (int i = 100; i < 140; ++i)
      parts.push_back(catalog::AnyPart(family, "p" + std::to_string(i), random));
    for (const catalog::NumberField& field : family.numbers) {
      const std::string name(field.name);
      const double low = field.min + 0.2 * (field.max - field.min);
      const double high = field.min + 0.9 * (field.max - field.min);
      std::vector<std::pair<double, std::string>> expected;
      for (const catalog::Part& part : parts)
        if (const auto found = part.numbers.find(name); found != part.numbers.end())
          if (found->second.value >= low && found->second.value <= high)
            expected.emplace_back(-found->second.value, part.id);
      std::sort(expected.begin(), expected.end());
      std::vector<std::string> ids;
      for (const auto& [value, id] : expected) ids.push_back(id);
      char low_text[40], high_text[40];
      std::snprintf(low_text, sizeof low_text, "%.17g", low);
      std::snprintf(high_text, sizeof high_text, "%.17g", high);
      EXPECT_EQ(Ids({{"family", std::string(family.name)},
                     {name + "_min", low_text},
                     {name + "_max", high_text},
                     {"sort", "-" + name}},
                    parts),
                ids)
          << family.name << " " << name;
    }
  }
}

Json PageOf(const Parsed<std::string>& page) { return Json::parse(std::get<std::string>(page)); }

TEST(PartQuery, FacetsCountWhatMatchesOnAllPages) {
  const auto shelf = Shelf();
  const auto query = std::get<PartQuery>(
      ParsePartQuery({{"facets", "true"}, {"mass_kg_min", "4"}, {"limit", "1"}}));
  const Json page = PageOf(RenderPage(query, {5, "abc", "", "", ""}, PartTable(shelf)));
  EXPECT_EQ(page["parts"].size(), 1u);
  EXPECT_EQ(page["total"], 6);
  EXPECT_EQ(page["facets"]["texts"]["manufacturer"], Parse(R"({"Even": 3, "Odd": 3})"));
  EXPECT_EQ(page["facets"]["texts"]["port"], Parse(R"({"1/4": 1, "1/8": 1})"));
  EXPECT_EQ(page["facets"]["numbers"]["price_eur"],
            Parse(R"({"count": 2, "min": 40.0, "max": 80.0, "ranges": [
                        {"count": 1, "min": 40.0, "max": 40.0},
                        {"count": 1, "min": 80.0, "max": 80.0}]})"));
  const Json& mass = page["facets"]["numbers"]["mass_kg"];
  EXPECT_EQ(mass["count"], 6);
  EXPECT_EQ(mass["min"], 4.0);
  EXPECT_EQ(mass["max"], 9.0);
  EXPECT_EQ(page["catalogue_revision"], Parse(R"({"number": 5, "hash": "abc"})"));
}

TEST(PartQuery, PagesCoverTheListOnceInEveryOrder) {
  const auto shelf = Shelf();
  for (const char* sort :
       {"id", "-id", "match", "-price_eur", "internal_volume_ml", "-manufacturer"}) {
    const auto all = Ids({{"sort", sort}}, shelf);
    std::vector<std::string> paged;
    Query query = {{"sort", sort}, {"limit", "2"}};
    for (int pages = 0; pages < 10; ++pages) {
      const auto page = RenderPage(std::get<PartQuery>(ParsePartQuery(query)), {7, "", "", "", ""},
                                   PartTable(shelf));
      const Json json = PageOf(page);
      for (const Json& part : json["parts"]) paged.push_back(part["id"]);
      if (json["next_cursor"].is_null()) break;
      query.erase("cursor");
      query.emplace("cursor", json["next_cursor"]);
      EXPECT_EQ(std::get<PartQuery>(ParsePartQuery(query)).cursor->revision, 7);
    }
    EXPECT_EQ(paged, all) << sort;
  }
  const auto foreign =
      RenderPage(std::get<PartQuery>(ParsePartQuery({{"cursor", "7.r1"}, {"mass_kg_min", "2"}})),
                 {7, "", "", "", ""}, PartTable(shelf));
  EXPECT_THAT(DetailAt(ErrorsOf(foreign), "/cursor"), HasSubstr("another query"));
}

TEST(PartQuery, SearchesAndShowsTheBestMatchesFirst) {
  auto shelf = Shelf();
  shelf[0].notes = "fits the Even tank";
  shelf[4].aliases = {"even so"};
  EXPECT_THAT(Ids({{"q", "even"}}, shelf), ElementsAre("r2", "r4", "r5", "r6", "r8", "r1"));
  EXPECT_THAT(Ids({{"q", "even"}, {"sort", "id"}, {"mass_kg_max", "5"}}, shelf),
              ElementsAre("r1", "r2", "r4", "r5"));
  EXPECT_THAT(Ids({{"q", "tank EVEN"}}, shelf), ElementsAre("r1"));
  EXPECT_EQ(Ids({{"q", ""}}, shelf), Ids({}, shelf));
  EXPECT_EQ(Ids({{"q", "\"*"}}, shelf), Ids({}, shelf));
  // Page by page, in the order of the search.
  std::vector<std::string> paged;
  Query query = {{"q", "even"}, {"limit", "2"}};
  for (Json next = ""; !next.is_null();) {
    query.erase("cursor");
    query.emplace("cursor", next.get<std::string>());
    const Json page = PageOf(RenderPage(std::get<PartQuery>(ParsePartQuery(query)),
                                        {7, "", "", "", ""}, PartTable(shelf)));
    EXPECT_EQ(page["total"], 6);
    for (const Json& part : page["parts"]) paged.push_back(part["id"]);
    next = page["next_cursor"];
  }
  EXPECT_THAT(paged, ElementsAre("r2", "r4", "r5", "r6", "r8", "r1"));
}

TEST(PartQuery, FiltersByPriceDocumentAndProvenance) {
  auto shelf = Shelf();  // r4 and r8 have a price
  shelf[2].documents = {{"https://maker.example", ""}};
  shelf[5].numbers["mass_kg"].provenance = catalog::Provenance::kEstimated;
  EXPECT_THAT(Ids({{"priced", "true"}}, shelf), ElementsAre("r4", "r8"));
  EXPECT_EQ(Ids({{"priced", "false"}}, shelf).size(), 7u);
  EXPECT_THAT(Ids({{"documented", "true"}}, shelf), ElementsAre("r3"));
  EXPECT_THAT(Ids({{"estimated_share_min", "0.01"}}, shelf), ElementsAre("r6"));
  EXPECT_THAT(Ids({{"estimated_share", "0.25"}}, shelf), ElementsAre("r6"));
  EXPECT_THAT(Ids({{"sort", "-estimated_share"}, {"mass_kg_min", "5"}}, shelf),
              ElementsAre("r6", "r5", "r7", "r8", "r9"));
}

TEST(PartQuery, ChecksColumns) {
  EXPECT_TRUE(CheckColumns({"id", "mass_kg", "documents", "priced", "port"}, "reservoir").empty());
  EXPECT_THAT(DetailAt(CheckColumns({"mas_kg"}, std::nullopt), "/columns"), HasSubstr("mass_kg"));
  EXPECT_FALSE(CheckColumns({"coil_power_w"}, "reservoir").empty());
  const Errors two = CheckColumns({"mass", "q"}, std::nullopt);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_THAT(two[0].detail, HasSubstr("nearest known: mass_kg"));
  EXPECT_THAT(two[1].detail, HasSubstr("fields are id, documents"));
}

TEST(PartQuery, NamesEveryParameterThatIsWrong) {
  const struct {
    Query query;
    const char* pointer;
    const char* detail;
  } cases[] = {
      {{{"mas_kg_max", "1"}}, "/mas_kg_max", "nearest known: mass_kg_max"},
      {{{"mass_kg_max", "heavy"}}, "/mass_kg_max", "finite number, not \"heavy\""},
      {{{"mass_kg_max", ""}}, "/mass_kg_max", "finite number"},
      {{{"mass_kg_min", "inf"}}, "/mass_kg_min", "finite number"},
      {{{"mass_kg_min", "nan"}}, "/mass_kg_min", "finite number"},
      {{{"mass_kg_min", "1e999"}}, "/mass_kg_min", "finite number"},
      {{{"mass_kg_min", "2"}, {"mass_kg_max", "1"}}, "/mass_kg_min", "at most mass_kg_max, 1"},
      {{{"mass_kg_min", "2"}, {"mass_kg_min", "1"}}, "/mass_kg_min", "more than once"},
      {{{"family", "wheels"}}, "/family", "valve"},
      {{{"family", "valve"}, {"capacity_ah_min", "1"}}, "/capacity_ah_min", "nearest known"},
      {{{"sort", "mass"}}, "/sort", "nearest known: "},
      {{{"sort", ""}}, "/sort", "must be a field"},
      {{{"limit", "0"}}, "/limit", "≥ 1"},
      {{{"cursor", "r1"}}, "/cursor", "next_cursor"},
      {{{"cursor", "-1.r1"}}, "/cursor", "next_cursor"},
      {{{"revision", "x"}}, "/revision", "number of a revision"},
      {{{"revision", "3"}, {"cursor", "4.r1"}}, "/revision", "that of the cursor, 4"},
      {{{"facets", "yes"}}, "/facets", "true or false"},
      {{{"priced", "yes"}}, "/priced", "true or false"},
      {{{"q", std::string(501, 'a')}}, "/q", "at most 500 bytes, not 501"},
  };
  for (const auto& [query, pointer, detail] : cases)
    EXPECT_THAT(DetailAt(ErrorsOf(ParsePartQuery(query)), pointer), HasSubstr(detail)) << pointer;
}

TEST(PartQuery, MutatedQueriesAreReadOrRefused) {
  std::mt19937 random(20240613);
  const auto shelf = Shelf();
  const char* const names[] = {"family", "mass_kg_min", "mass_kg_max", "port",         "limit",
                               "sort",   "cursor",      "facets",      "revision",     "origin",
                               "",       "_min",        "duty_max",    "duty_max_max", "q"};
  const char* const values[] = {"reservoir",
                                "1",
                                "-1",
                                "1e3",
                                "0.5",
                                "true",
                                "-mass_kg",
                                "7.r3",
                                "7.none",
                                "\xFF",
                                "",
                                "nan",
                                "99999999999999999999",
                                ".",
                                "user"};
  const auto mutated = [&](std::string text) {
    if (random() % 4 != 0) return text;
    const std::size_t at = text.empty() ? 0 : random() % text.size();
    if (random() % 2 == 0) return text.insert(at, 1, static_cast<char>(random()));
    return text.erase(at, 1 + random() % 3);
  };
  int answered = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    Query query;
    for (std::size_t n = random() % 4; n > 0; --n)
      query.emplace(mutated(names[random() % std::size(names)]),
                    mutated(values[random() % std::size(values)]));
    const auto parsed = ParsePartQuery(query);
    if (const auto* errors = std::get_if<Errors>(&parsed)) {
      ++refused;
      for (const Error& error : *errors) {
        ASSERT_FALSE(error.detail.empty());
        ASSERT_EQ(error.pointer.front(), '/');
      }
      continue;
    }
    const auto page =
        RenderPage(std::get<PartQuery>(parsed), {7, "", "", "", ""}, PartTable(shelf));
    if (std::holds_alternative<std::string>(page)) {
      ++answered;
      const Json json = PageOf(page);
      ASSERT_LE(json["parts"].size(), json["total"].get<std::size_t>());
    }
  }
  EXPECT_GT(answered, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace part_query_test
}  // namespace plenum::api
