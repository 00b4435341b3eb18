// `plenum catalog` beyond reading and writing single parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace catalog_command_test {

using api::Json;
using testing::HasSubstr;
using testing::StartsWith;

Json Document(const std::string& text) {
  auto parsed = api::ParseJson(text);
  return std::holds_alternative<Json>(parsed) ? std::get<Json>(parsed) : Json();
}

// An import changes all of its parts at once; the next one changes them again.
TEST(CatalogCommand, ARefusedUndoNamesTwentyParts) {
  const Workbench bench;
  constexpr const char *kBefore = ",0.00317,", *kAfter = ",0.00417,";
  for (int i = 0; i < 25; ++i) {
    Json fitting = NewFitting("f" + std::to_string(i));
    fitting["part_number"] = "F" + std::to_string(i);
    fitting["mass_kg"] = 0.00317;
    ASSERT_EQ(bench.Run("catalog add -", fitting.dump()).status, 0);
  }
  std::istringstream exported(bench.Run("catalog export fitting").out);
  std::string line, first, second;
  for (std::getline(exported, line), first = second = line + "\n"; std::getline(exported, line);) {
    const std::size_t at = line.find(kBefore);
    if (at == std::string::npos) continue;
    first += line + "\n";
    second += line.replace(at, std::string(kBefore).size(), kAfter) + "\n";
  }
  bench.Write("first.csv", first);
  bench.Write("second.csv", second);
  ASSERT_EQ(bench.Run("catalog import fitting second.csv").status, 0);
  const std::string revision =
      Document(bench.Run("catalog history --json").out)["revisions"][0]["number"].dump();
  ASSERT_EQ(bench.Run("catalog import fitting first.csv").status, 0);
  const auto refused = bench.Run("catalog undo " + revision);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("and 5 more"));
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 21);
}

TEST(CatalogCommand, KeepsTheFilesOfDocuments) {
  const Workbench bench;
  ASSERT_EQ(bench.Run("catalog add -", NewFitting("f").dump()).status, 0);
  std::string bytes(300'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 3);
  bench.Write("sheet.pdf", bytes);
  const std::string hash = catalog::Sha256(bytes);
  const auto refused =
      bench.Run("catalog document add f sheet.pdf --sha256 " + std::string(64, '0'));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("must be that of the file, " + hash));
  ASSERT_EQ(bench.Run("catalog document add f sheet.pdf").status, 0);
  const Json listed = Document(bench.Run("catalog document list f --json").out)["documents"][0];
  EXPECT_EQ(listed["link"], "sheet.pdf");
  EXPECT_EQ(listed["file"]["media_type"], "application/pdf");
  EXPECT_THAT(bench.Run("catalog document list f").out, HasSubstr(hash.substr(0, 12)));
  EXPECT_EQ(bench.Run("catalog document get f " + hash.substr(0, 9) + " --out -").out, bytes);
  EXPECT_THAT(bench.Run("catalog document get f " + hash).err, HasSubstr("is there already"));
  EXPECT_EQ(bench.Run("catalog document get f ab --out x.pdf").status, 2);
  EXPECT_EQ(bench.Run("catalog document get none ab --out x.pdf").status, 2);
  ASSERT_EQ(bench.Run("catalog copy catalog.db copied.db").status, 0);
  ASSERT_EQ(
      bench.Run("catalog document get f " + hash + " --out again.pdf --catalog copied.db").status,
      0);
  EXPECT_TRUE(ReadAll(bench.Path("again.pdf")) == bytes);
  ASSERT_EQ(bench.Run("catalog document remove f " + hash).status, 0);
  EXPECT_THAT(bench.Run("catalog document list f").out, HasSubstr("has no documents"));
  bench.Write("huge.pdf", std::string((20 << 20) + 1, 'x'));
  const auto large = bench.Run("catalog document add f huge.pdf");
  EXPECT_EQ(large.status, 2);
  EXPECT_THAT(large.err, HasSubstr("must have 1 to 20971520 bytes, has 20971521"));
}

TEST(CatalogCommand, ShowsHistoryAndTakesChangesBack) {
  const Workbench bench;
  ASSERT_EQ(bench.Run("catalog add -", NewFitting("f").dump()).status, 0);
  const Json writes = Document(bench.Run("catalog history --json").out)["revisions"];
  EXPECT_EQ(writes[0]["what"], "add f");
  EXPECT_NE(writes[0]["who"], "");
  const std::string added = writes[0]["number"].dump();
  ASSERT_EQ(bench.Run("catalog remove f").status, 0);
  EXPECT_EQ(bench.Run("catalog show f").status, 2);
  EXPECT_EQ(Document(bench.Run("catalog show f --json --revision " + added).out)["mass_kg"], 0.003);
  EXPECT_THAT(bench.Run("catalog show f --revision 999").err, HasSubstr("no revision 999"));
  EXPECT_THAT(bench.Run("catalog history f").out, HasSubstr("the part was removed"));
  EXPECT_EQ(Document(bench.Run("catalog history f --json").out)["history"].size(), 2u);
  EXPECT_EQ(bench.Run("catalog history never").status, 2);

  const auto too_early = bench.Run("catalog undo " + added);
  EXPECT_EQ(too_early.status, 2);
  EXPECT_THAT(too_early.err, HasSubstr("f was changed since"));
  const std::string removed = std::to_string(std::stoi(added) + 1);
  EXPECT_THAT(bench.Run("catalog undo " + removed).out, StartsWith("undone as revision"));
  EXPECT_EQ(bench.Run("catalog show f").status, 0);
  EXPECT_EQ(bench.Run("catalog undo 999").status, 2);
  const Json then = Document(bench.Run("catalog list fitting --json --revision " + added).out);
  EXPECT_EQ(then["catalogue_revision"]["hash"], writes[0]["hash"]);
}

TEST(CatalogCommand, FindsPartsByWordsAndShowsChosenColumns) {
  const Workbench bench;
  Json part = NewFitting("odd-one");
  part["notes"] = "Sits beside the oddment's door";
  part["documents"] = {{{"link", "https://maker.example/odd.pdf"}}};
  ASSERT_EQ(bench.Run("catalog add -", part.dump()).status, 0);
  const auto ids = [&](const std::string& options) {
    std::vector<std::string> all;
    const Json list = Document(bench.Run("catalog list --json " + options).out);
    for (const Json& found : list["parts"]) all.push_back(found["id"]);
    return all;
  };
  EXPECT_THAT(ids("--search 'door oddment'"), testing::ElementsAre("odd-one"));
  EXPECT_THAT(ids("fitting --search 'ODD.PDF \"maker'"), testing::ElementsAre("odd-one"));
  EXPECT_THAT(ids("valve --search oddment"), testing::ElementsAre());
  EXPECT_THAT(ids("--search oddment --where priced=true"), testing::ElementsAre());
  const auto shown =
      bench.Run("catalog list --search oddment --columns mass_kg --columns documents");
  EXPECT_THAT(shown.out, HasSubstr("https://maker.example/odd.pdf"));
  EXPECT_THAT(shown.out, HasSubstr("0.00300"));
  EXPECT_THAT(shown.out, testing::Not(HasSubstr("manufacturer")));
  EXPECT_THAT(bench.Run("catalog list --columns mass_kgg").err,
              HasSubstr("nearest known: mass_kg"));
  EXPECT_THAT(bench.Run("catalog list --where q=x").err, HasSubstr("q is not a field"));
  EXPECT_EQ(bench.Run("catalog list --search " + std::string(501, 'a')).status, 2);
  const auto facets = bench.Run("catalog list fitting --search oddment --facets");
  EXPECT_THAT(facets.out, HasSubstr("estimated_share"));
  const Json document =
      Document(bench.Run("catalog list fitting --search oddment --facets --json").out);
  EXPECT_EQ(document["facets"]["texts"]["family"]["fitting"], 1);
}

TEST(CatalogCommand, SaysWhatItUnderstoodOfAnAddedPart) {
  const Workbench bench;
  Json part = NewFitting("printed");
  part["mass_kg"] = "3 g";
  part["sonic_conductance_dm3_per_s_bar"] = "Cv 0.05";
  const auto added = bench.Run("catalog add -", part.dump());
  EXPECT_EQ(added.status, 0) << added.err;
  EXPECT_THAT(added.out, StartsWith("added printed\n"));
  EXPECT_THAT(added.out, HasSubstr("\"3 g\" = 0.003 kg"));
  EXPECT_THAT(added.out, HasSubstr("sonic_conductance_dm3_per_s_bar = "));
  EXPECT_EQ(bench.Run("catalog add -", NewFitting("plain").dump()).out, "added plain\n");
}

TEST(CatalogCommand, ComparesPartsSideBySide) {
  const Workbench bench;
  Json heavy = NewFitting("heavy");
  heavy["mass_kg"] = 0.05;
  heavy["provenance"]["mass_kg"] = {{"kind", "estimated"}, {"source", "guess"}};
  ASSERT_EQ(bench.Run("catalog add -", NewFitting("light").dump()).status, 0);
  ASSERT_EQ(bench.Run("catalog add -", heavy.dump()).status, 0);
  const auto text = bench.Run("catalog compare light heavy");
  EXPECT_THAT(text.out, testing::ContainsRegex("≠  mass_kg +0.00300 +~0.0500\n"));
  const Json document = Document(bench.Run("catalog compare light heavy --json").out);
  EXPECT_EQ(document["parts"][1]["id"], "heavy");
  EXPECT_EQ(bench.Run("catalog compare light").status, 2);
  EXPECT_THAT(bench.Run("catalog compare light none").err, HasSubstr("no part has the id none"));
}

TEST(CatalogCommand, ChecksTheJobsBesideTheCatalogue) {
  const Workbench bench;
  const std::string jobs = std::string(bench.catalog()) + "-jobs";
  EXPECT_EQ(bench.Run("catalog check").status, 0);  // there are none
  {
    catalog::JobStore store(jobs, {});
    catalog::JobOrder order;
    order.kind = "design";
    order.request = std::string(100'000, 'x');
    order.hash = std::string(64, '0');
    store.Add("a", order);
    const auto held = bench.Run("catalog check");
    EXPECT_EQ(held.status, 0);
    EXPECT_THAT(held.err, HasSubstr("a service holds it"));
  }
  const auto sound = bench.Run("catalog check");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_EQ(sound.err, "");
  // Pages of the tree that holds the request become noise.
  std::string bytes = ReadAll(jobs);
  ASSERT_GT(bytes.size(), 30'000u);
  std::fill(bytes.begin() + 8192, bytes.begin() + 24'000, '\xA5');
  std::ofstream(jobs, std::ios::binary).write(bytes.data(), std::ssize(bytes));
  const auto damaged = bench.Run("catalog check");
  EXPECT_EQ(damaged.status, 2);
  EXPECT_THAT(damaged.err, HasSubstr("-jobs"));
}

TEST(CatalogCommand, ListsWhatIsAskedForInOrder) {
  const Workbench bench;
  const Json json = Document(
      bench
          .Run("catalog list valve --where mass_kg_max=0.05 --where port=M5 --sort=-mass_kg --json")
          .out);
  ASSERT_GT(json["parts"].size(), 1u);
  double last = 0.05;
  for (const Json& part : json["parts"]) {
    EXPECT_EQ(part["port"], "M5");
    EXPECT_LE(part["mass_kg"], last);
    last = part["mass_kg"];
  }
  EXPECT_THAT(bench.Run("catalog list --where mass=1").err, HasSubstr("nearest known"));
  EXPECT_EQ(bench.Run("catalog list --where mass_kg").status, 2);
  EXPECT_EQ(bench.Run("catalog list --where limit=3").status, 2);
}

TEST(CatalogCommand, BacksUpAndRestores) {
  const Workbench bench;
  ASSERT_EQ(bench.Run("catalog backup copy.db").status, 0);
  const auto exported = bench.Run("catalog export fitting").out;
  ASSERT_EQ(bench.Run("catalog add -", NewFitting("f").dump()).status, 0);
  EXPECT_NE(bench.Run("catalog export fitting").out, exported);
  ASSERT_EQ(bench.Run("catalog restore copy.db").status, 0);
  EXPECT_EQ(bench.Run("catalog export fitting").out, exported);
  bench.Write("bad.db", ReadAll(bench.Path("copy.db")).substr(0, 400'000));
  const auto refused = bench.Run("catalog restore bad.db");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, StartsWith("bad.db"));
  EXPECT_EQ(bench.Run("catalog export fitting").out, exported);
  ASSERT_EQ(bench.Run("catalog restore copy.db --catalog fresh.db").status, 0);
  EXPECT_EQ(bench.Run("catalog export fitting --catalog fresh.db").out, exported);
}

TEST(CatalogCommand, CheckPointsOutOddNumbersAndGaps) {
  const Workbench bench;
  auto heavy = NewFitting("heavy");
  heavy["mass_kg"] = 300;
  ASSERT_EQ(bench.Run("catalog add -", heavy.dump()).status, 0);
  const auto check = bench.Run("catalog check --json");
  EXPECT_EQ(check.status, 0);
  const Json json = Document(check.out);
  EXPECT_EQ(json["faults"], Json::array());
  int found = 0;
  for (const Json& outlier : json["outliers"])
    found += outlier["id"] == "heavy" && outlier["field"] == "mass_kg";
  EXPECT_EQ(found, 1);
  bool gap = false;
  for (const Json& field : json["gaps"])
    gap |= field["family"] == "fitting" && field["field"] == "price_eur";
  EXPECT_TRUE(gap);
  EXPECT_THAT(bench.Run("catalog check").out, HasSubstr("worth a second look"));
}

TEST(CatalogCommand, CheckNamesDuplicatesAndCountsEstimates) {
  const Workbench bench;
  auto again = Document(bench.Run("catalog list fitting --json").out)["parts"][0];
  again["id"] = "again";
  std::string number = again["part_number"];
  for (char& c : number) c = c == '-' ? ' ' : static_cast<char>(std::tolower(c));
  again["part_number"] = number;
  ASSERT_EQ(bench.Run("catalog add -", again.dump()).status, 0);
  const Json json = Document(bench.Run("catalog check --json").out);
  int found = 0;
  for (const Json& duplicates : json["duplicates"])
    for (const Json& id : duplicates["ids"]) found += id == "again";
  EXPECT_EQ(found, 1);
  int parts = 0;
  for (const Json& family : json["families"]) {
    parts += family["parts"].get<int>();
    EXPECT_LE(family["estimated"], family["values"]);
    EXPECT_LE(family["without_price"].size(), family["parts"]);
  }
  EXPECT_EQ(parts, json["parts"]);
  EXPECT_THAT(bench.Run("catalog check").out, HasSubstr("Maybe one part under several names"));
}

TEST(CatalogCommand, ImportsAForeignTableOnceItsQuestionsAreAnswered) {
  const Workbench bench;
  bench.Write("parts.csv", "Verteiler\nModell;Stations;Gewicht\nVX 4;4;210,5\nSumme;4;\n");
  const auto asked = bench.Run("catalog import manifold parts.csv");
  EXPECT_EQ(asked.status, 2);
  EXPECT_THAT(asked.err, HasSubstr("--column 'Gewicht=mass_kg [g]'"));
  const std::string answer =
      "catalog import manifold parts.csv --set manufacturer=Festo --column "
      "'Gewicht=mass_kg [g]'";
  EXPECT_THAT(bench.Run(answer + " --dry-run").out, HasSubstr("would add 1"));
  const auto done = bench.Run(answer);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("semicolon-delimited, header in row 2"));
  EXPECT_THAT(done.out, HasSubstr("row 4 left out: a row of totals"));
  EXPECT_EQ(Document(bench.Run("catalog show festo-vx-4 --json").out)["mass_kg"], 0.2105);
  EXPECT_THAT(bench.Run("catalog import manifold parts.csv --column Gewicht").err,
              HasSubstr("HEADING=COLUMN"));
}

}  // namespace catalog_command_test
}  // namespace plenum::server
