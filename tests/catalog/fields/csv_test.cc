#include "catalog/fields/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/fields/fields.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace csv_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

auto Error(int row, const std::string& column, const std::string& part_of_detail) {
  return AllOf(Field(&CsvError::row, row), Field(&CsvError::column, column),
               Field(&CsvError::detail, HasSubstr(part_of_detail)));
}

const std::string kHeader =
    "id,manufacturer,part_number,internal_volume_ml,mass_kg,body_volume_ml,"
    "pressure_max_kpa_gauge\n";

TEST(Csv, RoundTripIsExactForEveryFamily) {
  std::mt19937 random(11);
  for (const Family& family : Families()) {
    std::vector<Part> parts;
    for (int i = 0; i < 100; ++i) parts.push_back(AnyPart(family, "p" + std::to_string(i), random));
    const CsvParts read = ReadCsv(family.name, WriteCsv(family.name, parts));
    EXPECT_THAT(read.errors, ElementsAre()) << family.name;
    EXPECT_EQ(read.parts, parts) << family.name;
  }
}

TEST(Csv, ReadsByColumnNameWithDefaults) {
  const CsvParts read =
      ReadCsv("reservoir",
              "\xEF\xBB\xBFmass_kg,id,part_number,manufacturer,internal_volume_ml,"
              "body_volume_ml,pressure_max_kpa_gauge,mass_kg.provenance,mass_kg.source\r\n"
              "0.25,r1,\"A \"\"1\"\", B\",Mäker,500,600,1000,datasheet,p. 3\r\n"
              "0.5,r2,C,M,500,600,1000,,\r\n\r\n");
  ASSERT_THAT(read.errors, ElementsAre());
  ASSERT_EQ(read.parts.size(), 2u);
  EXPECT_EQ(read.parts[0].part_number, "A \"1\", B");
  EXPECT_EQ(read.parts[0].numbers.at("mass_kg"), (Number{0.25, Provenance::kDatasheet, "p. 3"}));
  EXPECT_EQ(read.parts[1].numbers.at("mass_kg"), (Number{0.5, Provenance::kThirdParty, ""}));
  EXPECT_FALSE(read.parts[0].numbers.contains("price_eur"));
}

TEST(Csv, ReadsACurve) {
  const CsvParts read =
      ReadCsv("compressor",
              "id,manufacturer,part_number,voltage_v,duty_max,mass_kg,body_volume_ml,"
              "pressure_max_kpa_gauge,curve,free_air.provenance,current.provenance\n"
              "c,M,N,12,0.5,1,900,700,0:24.9:7;68.9:14.2:8,datasheet,estimated\n");
  ASSERT_THAT(read.errors, ElementsAre());
  ASSERT_TRUE(read.parts.at(0).curve);
  EXPECT_THAT(read.parts[0].curve->points,
              ElementsAre(CurvePoint{0, 24.9, 7}, CurvePoint{68.9, 14.2, 8}));
  EXPECT_EQ(read.parts[0].curve->free_air_provenance, Provenance::kDatasheet);
  EXPECT_EQ(read.parts[0].curve->current_provenance, Provenance::kEstimated);
}

TEST(Csv, ReadsSeriesListsAndUncertainty) {
  const std::string header = kHeader.substr(0, kHeader.size() - 1) +
                             ",series,orderable,aliases,offers,documents,mass_kg.uncertainty\n";
  const CsvParts read = ReadCsv(
      "reservoir",
      header +
          "r,M,P,500,0.2,600,1000,M P,TRUE,\"[\"\"P1\"\", \"\"\\u00b5\\ud83d\\ude00\"\"]\","
          "\"[{\"\"supplier\"\":\"\"Shop\"\",\"\"price\"\":12.5,\"\"currency\"\":\"\"EUR\"\","
          "\"\"pack\"\":10,\"\"date\"\":\"\"2024-05\"\"}]\","
          "\"[{\"\"link\"\":\"\"https://example.org\"\",\"\"sha256\"\":null}]\",5 %\n"
          "s,M,P,500,0.2,600,1000,,no,,,,\n");
  ASSERT_THAT(read.errors, ElementsAre());
  const Part& part = read.parts.at(0);
  EXPECT_EQ(part.series, "M P");
  EXPECT_EQ(part.orderable, true);
  EXPECT_THAT(part.aliases, ElementsAre("P1", "µ😀"));
  EXPECT_THAT(part.offers, ElementsAre(Offer{"Shop", 12.5, "EUR", 10, "2024-05", ""}));
  EXPECT_THAT(part.documents, ElementsAre(Document{"https://example.org", ""}));
  EXPECT_EQ(part.numbers.at("mass_kg").uncertainty, 0.05);
  EXPECT_EQ(part.numbers.at("price_eur").value, 1.25);
  EXPECT_EQ(part.numbers.at("price_eur").provenance, Provenance::kDerived);
  EXPECT_EQ(read.parts.at(1).orderable, false);
  EXPECT_FALSE(read.parts.at(1).numbers.contains("price_eur"));
}

TEST(Csv, RefusesBrokenListsAndUncertainties) {
  const std::string header = kHeader.substr(0, kHeader.size() - 1);
  const struct {
    const char* column;
    const char* cell;
    const char* detail;
  } cases[] = {
      {"orderable", "maybe", "\"maybe\""},
      {"aliases", "P1", "list of texts"},
      {"aliases", "\"[\"\"P1\"\"\"", "list of texts"},
      {"aliases", "\"[\"\"P1\"\"]x\"", "list of texts"},
      {"aliases", "\"[\"\"\\ud83d\"\"]\"", "list of texts"},
      {"aliases", "\"[\"\"\"\"]\"", "alias 1"},
      {"offers", "[1]", "list of objects"},
      {"offers", "[{}]", "offer 1: price is required"},
      {"offers", "\"[{\"\"price\"\":\"\"much\"\"}]\"", "price must be a number, is \"much\""},
      {"offers", "\"[{\"\"price\"\":1,\"\"curency\"\":\"\"EUR\"\"}]\"", "nearest: currency"},
      {"offers", "\"[{\"\"price\"\":1,\"\"price\"\":2}]\"", "list of objects"},
      {"documents", "[{}]", "needs a link or a sha256"},
      {"mass_kg.uncertainty", "0", "between 1e-06 and 1"},
      {"mass_kg.uncertainty", "120 %", "is 1.2"},
      {"mass_kg.uncertainty", "small", "\"small\""},
      {"price_eur.uncertainty", "0.1", "there is no value"},
  };
  for (const auto& [column, cell, detail] : cases) {
    const CsvParts read =
        ReadCsv("reservoir", header + "," + column + "\nr,M,P,500,0.2,600,1000," + cell + "\n");
    EXPECT_THAT(read.errors, ElementsAre(Error(2, column, detail))) << column << " " << cell;
  }
}

TEST(Csv, TheLongestListsFitTheirCells) {
  Part part = Reservoir("r");
  std::string quotes;
  for (int i = 0; i < 200; ++i) quotes += '"';
  for (int i = 0; i < 16; ++i) part.aliases.push_back(quotes.substr(1) + char('a' + i));
  part.offers.assign(16, {quotes, 1, "EUR", 1, "2024-02-29", std::string(1000, '"')});
  part.documents.assign(16, {std::string(1000, '\\'), std::string(64, 'f')});
  part.numbers["price_eur"] = {1, Provenance::kDerived,
                               "offer of " + quotes + ", 2024-02-29: 1 EUR"};
  ASSERT_THAT(Validate(part), ElementsAre());
  const CsvParts read = ReadCsv("reservoir", WriteCsv("reservoir", {part}));
  EXPECT_THAT(read.errors, ElementsAre());
  EXPECT_THAT(read.parts, ElementsAre(part));
}

TEST(Csv, TakesUnitsInCells) {
  const CsvParts read = ReadCsv("reservoir", kHeader + "r,M,P,0.5 L,350 g,600 cm³,6 bar\n");
  ASSERT_THAT(read.errors, ElementsAre());
  const auto& numbers = read.parts.at(0).numbers;
  EXPECT_EQ(numbers.at("internal_volume_ml").value, 500);
  EXPECT_EQ(numbers.at("mass_kg").value, 0.35);
  EXPECT_EQ(numbers.at("body_volume_ml").value, 600);
  EXPECT_EQ(numbers.at("pressure_max_kpa_gauge").value, 600);
  // Written in the unit of the column, so that it is converted only once.
  EXPECT_THAT(WriteCsv("reservoir", read.parts), HasSubstr(",0.35,third_party,"));

  const CsvParts pump = ReadCsv("compressor",
                                "id,manufacturer,part_number,voltage_v,duty_max,mass_kg,"
                                "body_volume_ml,pressure_max_kpa_gauge,curve\n"
                                "c,M,N,12 V,50 %,1 kg,0.9 L,7 bar,0 bar:24 L/min:7000 mA;"
                                "0.7 bar : 0.2 L/s : 8 A\n");
  ASSERT_THAT(pump.errors, ElementsAre());
  EXPECT_THAT(pump.parts.at(0).curve->points,
              ElementsAre(CurvePoint{0, 24, 7}, CurvePoint{70, 12, 8}));
  EXPECT_EQ(pump.parts[0].numbers.at("duty_max").value, 0.5);

  EXPECT_THAT(ReadCsv("reservoir", kHeader + "r,M,P,500 kg,1,600,6 bar abs\n").errors,
              ElementsAre(Error(2, "internal_volume_ml", "one of mL, cm3"),
                          Error(2, "pressure_max_kpa_gauge", "\"6 bar abs\"")));
}

TEST(Csv, ReportsEveryErrorWithRowAndColumn) {
  const CsvParts read = ReadCsv("reservoir", kHeader +
                                                 "r1,M,P,500,heavy,600,1000\n"
                                                 "r2,M,P,500,0.2\n"
                                                 "R3,M,P,500,inf,600,1e9\n"
                                                 "r4,M,P,500,0.2,600,1000\n"
                                                 "r4,,P,500,0.2,600,1000\n");
  EXPECT_THAT(read.errors,
              ElementsAre(Error(2, "mass_kg", "\"heavy\""), Error(3, "", "has 5 cells"),
                          Error(4, "mass_kg", "\"inf\""), Error(4, "id", "\"R3\""),
                          Error(4, "pressure_max_kpa_gauge", "between 1 and 50000"),
                          Error(6, "manufacturer", "has 0"), Error(6, "id", "row 5")));
}

TEST(Csv, SuggestsTheNearestColumnAndRefusesTwins) {
  const CsvParts read = ReadCsv("reservoir", "id,mass_kgs,id\n");
  EXPECT_THAT(read.errors,
              ElementsAre(Error(1, "mass_kgs", "nearest: mass_kg"), Error(1, "id", "twice")));
}

TEST(Csv, RefusesAProvenanceWithoutValueOrOutsideTheFive) {
  const std::string header = kHeader.substr(0, kHeader.size() - 1) +
                             ",price_eur,price_eur.provenance,mass_kg.provenance\n";
  const CsvParts read = ReadCsv("reservoir", header + "r,M,P,500,1,600,1000,,datasheet,guess\n");
  EXPECT_THAT(read.errors, ElementsAre(Error(2, "mass_kg.provenance", "\"guess\""),
                                       Error(2, "price_eur.provenance", "no value")));
}

TEST(Csv, RefusesBrokenCurves) {
  const std::string header =
      "id,manufacturer,part_number,voltage_v,duty_max,mass_kg,body_volume_ml,"
      "pressure_max_kpa_gauge,curve\n";
  for (const char* curve : {"0:1", "0:1:2:3", "0:1:2;", "0:x:2", "0;1;2", "0:nan:1", ":0:1:2"})
    EXPECT_THAT(ReadCsv("compressor", header + "c,M,N,12,0.5,1,900,700," + curve + "\n").errors,
                ElementsAre(Error(2, "curve", "L/min")))
        << curve;
}

TEST(Csv, CountsAllErrorsAndKeepsTheFirst) {
  std::string text = "id,manufacturer\n";
  for (int i = 0; i < 3'000; ++i) text += "Not An Id " + std::to_string(i) + ",m\n";
  int parts = 0;
  const CsvErrors found = ReadCsv("tubing", text, [&](const Part&, int) { ++parts; });
  EXPECT_EQ(parts, 3'000);
  EXPECT_EQ(found.errors.size(), kCsvErrorsMax);
  EXPECT_GE(found.count, 3'000u);
  EXPECT_EQ(found.errors.front().row, 2);
}

TEST(Csv, LimitsWhatOneRowTakes) {
  const auto errors = [](const std::string& text) { return ReadCsv("tubing", text).errors; };
  const auto wide = errors("id," + std::string(2'000'000, ',') + "\n");
  ASSERT_FALSE(wide.empty());
  EXPECT_NE(wide.front().detail.find("import_columns_max"), std::string::npos);
  for (const std::string quote : {"", "\""}) {
    const auto lengthy = errors("id\n" + quote + std::string(2'000'000, 'x') + quote + "\n");
    ASSERT_FALSE(lengthy.empty());
    EXPECT_EQ(lengthy.front().row, 2);
    EXPECT_NE(lengthy.front().detail.find("import_cell_bytes_max"), std::string::npos);
  }
}

TEST(Csv, RefusesBrokenQuotesAndBytes) {
  EXPECT_THAT(ReadCsv("reservoir", kHeader + "r,\"M\n").errors,
              ElementsAre(Error(2, "manufacturer", "never closed")));
  EXPECT_THAT(ReadCsv("reservoir", kHeader + "r,\"M\"x,P,500,1,600,1000\n").errors,
              ElementsAre(Error(2, "manufacturer", "after a closing quote")));
  EXPECT_THAT(ReadCsv("reservoir", kHeader + "r,M\"x,P,500,1,600,1000\n").errors,
              ElementsAre(Error(2, "manufacturer", "quote inside")));
  EXPECT_THAT(ReadCsv("reservoir", kHeader + "r,M\xFF,P,500,1,600,1000\n").errors,
              ElementsAre(Error(2, "column 2", "UTF-8")));
  EXPECT_THAT(ReadCsv("reservoir", "").errors, ElementsAre(Error(1, "", "header")));
  EXPECT_THAT(ReadCsv("tank", kHeader).errors, ElementsAre(Error(1, "", "\"tank\"")));
}

}  // namespace csv_test
}  // namespace plenum::catalog
