// Tables as people have them, written by hand: what each of them says was read with the eye and
// converted with a pocket calculator, not with the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"
#include "tests/catalog/foreign_tables.h"

namespace plenum::catalog {
namespace foreign_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using namespace foreign_tables;

class Foreign : public testing::TestWithParam<ForeignTable> {};

TEST_P(Foreign, IsReadWithoutAnEdit) { ExpectReadWithoutAnEdit(GetParam()); }

// The same table with the thousands of two languages.
const std::vector<Fact> kLuxfer{{0, kVolume, 1500.5},
                                {0, kMass, 1.23425},
                                {0, kBody, 2000},
                                {0, kPressure, 1000},
                                {1, kPressure, 1600}};

const ForeignTable kTables[] = {
    {"semicolon.csv",
     "reservoir",
     {"festo-crvzs-0-1", "festo-crvzs-0-4"},
     {{0, kVolume, 100}, {0, kMass, 0.1205}, {0, kBody, 250.25}, {1, kPressure, 1600}}},
    {"tab.tsv",
     "fitting",
     {"smc-kq2h04-m5a", "smc-kq2h06-01as"},
     {{0, "tube_outer_diameter_mm", 4},
      {0, kC, 0.28},
      {0, "critical_ratio", 0.31},
      {1, kMass, 0.0116},
      {1, kBody, 4.75},
      {1, kPressure, 1000}}},
    {"pipe.csv",
     "tubing",
     {"smc-tu0425b", "smc-tu0604b"},
     {{0, kOuter, 4}, {0, kInner, 2.5}, {0, kPerMetre, 0.0092}, {1, kPressure, 800}}},
    {"excel_unicode.txt",
     "tubing",
     {"festo-pun-h-4x0-75", "festo-pun-h-6x1"},
     {{0, kOuter, 4}, {0, kInner, 2.6}, {0, kPerMetre, 0.0087}, {1, kPressure, 1000}}},
    {"utf16be_no_mark.csv",
     "manifold",
     {"smc-ss3y3-42-04", "smc-ss3y3-42-08"},
     {{0, "stations", 4}, {1, kMass, 0.3305}}},
    {"latin1.csv",
     "tubing",
     {"rauh-soehne-pu-4", "rauh-soehne-pu-6"},
     {{0, kOuter, 4}, {0, kInner, 2.5}, {1, kPerMetre, 0.0185}, {1, kPressure, 850}}},
    {"bom.csv",
     "reservoir",
     {"norgren-t55a0010"},
     {{0, kVolume, 100}, {0, kMass, 0.35}, {0, kBody, 300}, {0, kPressure, 1700}}},
    {"merged_titles.csv",
     "reservoir",
     {"smc-vbat05a1", "smc-vbat10a1"},
     {{0, kVolume, 500}, {0, kMass, 1.3}, {1, kBody, 1700.5}, {1, kPressure, 2000}}},
    {"totals.csv",
     "reservoir",
     {"festo-crvzs-2", "festo-crvzs-5"},
     {{0, kMass, 1.15}, {1, kVolume, 5000}, {1, kBody, 6900}}},
    {"empty_rows.csv",
     "silencer",
     {"festo-uc-m5", "festo-uc-1-8"},
     {{0, kMass, 0.0012}, {1, kMass, 0.0046}}},
    {"units_row.csv",
     "reservoir",
     {"smc-vbat02a", "smc-vbat03a"},
     {{0, kVolume, 200}, {0, kMass, 0.1605}, {0, kBody, 310.5}, {1, kPressure, 1000}}},
    {"thousands.csv", "reservoir", {"luxfer-l1", "luxfer-l2"}, kLuxfer},
    {"thousands_german.csv", "reservoir", {"luxfer-l1", "luxfer-l2"}, kLuxfer},
    {"thousands_swiss.csv",
     "reservoir",
     {"luxfer-l1"},
     {{0, kVolume, 1500.5}, {0, kMass, 1.23425}, {0, kBody, 2000}, {0, kPressure, 1000}}},
    {"units_in_cells.csv",
     "reservoir",
     {"clippard-avt-12-1", "clippard-avt-24-4"},
     {{0, kVolume, 16.387064},
      {0, kMass, 0.014174761562},
      {1, kBody, 147.483576},
      {1, kPressure, 1034.213593975}}},
    {"cv.csv",
     "check_valve",
     {"beswick-cv-10", "beswick-cv-18"},
     {{0, kC, 0.2}, {1, kC, 1.0}, {0, "cracking_pressure_kpa_gauge", 10.342135940}}},
    {"nenndurchfluss.csv",
     "silencer",
     {"festo-u-1-8", "festo-u-1-4"},
     {{0, "critical_ratio", 0.3}, {0, kMass, 0.0095}, {1, kMass, 0.018}}},
    {"sep_line.csv", "manifold", {"festo-vabm-4", "festo-vabm-8"}, {{1, kMass, 0.405}}},
    {"mac_lines.csv", "manifold", {"festo-vabm-4", "festo-vabm-8"}, {{1, kMass, 0.4055}}},
    {"one_maker.csv",
     "manifold",
     {"smc-ss5y3-20-05", "smc-ss5y3-20-10"},
     {{0, "stations", 5}, {0, kMass, 0.2205}},
     BySetting({}, {{"manufacturer", "SMC"}})},
    {"by_hand.csv",
     "manifold",
     {"smc-ss5y5-04", "smc-ss5y5-08"},
     {{0, "stations", 4}, {1, kMass, 0.55}},
     BySetting({{"Fabrikat", "manufacturer"},
                {"Sachnummer", "part_number"},
                {"Plätze", "stations"},
                {"Gew. in g", "mass_kg [g]"},
                {"*", ""}},
               {})},
    {"us_tubing.csv",
     "tubing",
     {"freelin-wade-1a-151", "freelin-wade-1a-156"},
     {{0, kOuter, 6.35},
      {0, kInner, 4.064},
      {0, kPerMetre, 0.0223224591535},
      {1, kOuter, 9.525},
      {1, kPressure, 827.370875}}},
    {"packs.csv",
     "battery",
     {"tattu-ta-75c-450-3s1p", "tattu-ta-45c-850-3s1p"},
     {{0, "cells_series", 3},
      {0, "nominal_voltage_v", 11.1},
      {0, "capacity_ah", 0.45},
      {0, "current_max_a", 33.75},
      {0, kMass, 0.042524284688},
      {1, "price_eur", 14.9}}},
    {"repeated_header.csv",
     "manifold",
     {"festo-vabm-4", "festo-vabm-8", "festo-vabm-9"},
     {{2, "stations", 9}}},
};
INSTANTIATE_TEST_SUITE_P(Each, Foreign, testing::ValuesIn(kTables));

TEST(ForeignTables, WhatWasUnderstoodIsTold) {
  const TableReading totals = ReadTable("reservoir", Bytes("foreign/totals.csv"));
  EXPECT_EQ(totals.delimiter, "semicolon");
  EXPECT_EQ(totals.encoding, "utf-8");
  EXPECT_TRUE(totals.makes_ids);
  EXPECT_THAT(totals.left_out,
              ElementsAre(RowLeftOut{5, "a row of totals"}, RowLeftOut{6, "a row of totals"}));
  ASSERT_EQ(totals.columns.size(), 6u);
  EXPECT_EQ(FormatTarget(totals.columns[3].targets.at(0)), "mass_kg [kg]");
  EXPECT_EQ(totals.columns[3].decimal, Decimal::kComma);
  EXPECT_THAT(totals.columns[3].samples, ElementsAre("1,15", "2,05"));

  const TableReading titles = ReadTable("reservoir", Bytes("foreign/merged_titles.csv"));
  EXPECT_EQ(titles.header_row, 5);
  EXPECT_EQ(titles.left_out_count, 3u);
  EXPECT_EQ(ReadTable("tubing", Bytes("foreign/latin1.csv")).encoding, "windows-1252");
  EXPECT_EQ(ReadTable("manifold", Bytes("foreign/utf16be_no_mark.csv")).encoding, "utf-16be");
  EXPECT_EQ(ReadTable("tubing", Bytes("foreign/excel_unicode.txt")).encoding, "utf-16le");
  EXPECT_EQ(ReadTable("reservoir", Bytes("foreign/units_row.csv")).units_row, 2);
}

TEST(ForeignTables, TextsAreThoseOfTheTable) {
  const Read read = ReadAs("tubing", Bytes("foreign/latin1.csv"));
  ASSERT_EQ(read.parts.size(), 2u);
  EXPECT_EQ(read.parts[0].manufacturer, "Rauh & Söhne");
  EXPECT_EQ(read.parts[0].notes, "kälteflexibel bis -20 °C");
  EXPECT_EQ(read.parts[1].part_number, "PU-6");
}

TEST(ForeignTables, PrintedFlowIsDerived) {
  const Read read = ReadAs("silencer", Bytes("foreign/nenndurchfluss.csv"));
  ASSERT_EQ(read.parts.size(), 2u);
  const Number& c = read.parts[0].numbers.at(kC);
  // ISO 6358 with pencil and paper: p1 7.013 bar, p2 6.013 bar.
  EXPECT_NEAR(c.value, 5.50028, 1e-5);
  EXPECT_NEAR(read.parts[1].numbers.at(kC).value, 9.50810, 1e-5);
  EXPECT_EQ(c.provenance, Provenance::kDerived);
  EXPECT_THAT(c.source, HasSubstr("Qn 1400"));
}

struct OpenTable {
  const char* file;
  const char* family;
  const char* option;
  const char* question;  // a part of it
  TableOptions answer;   // with which it is read
};
std::ostream& operator<<(std::ostream& out, const OpenTable& table) { return out << table.file; }

class Open : public testing::TestWithParam<OpenTable> {};

TEST_P(Open, IsRefusedWithTheQuestionAndReadWithTheAnswer) {
  const OpenTable& table = GetParam();
  const std::string bytes = Bytes(std::string("open/") + table.file);
  const TableReading asked = ReadTable(table.family, bytes);
  EXPECT_THAT(asked.errors, IsEmpty());
  ASSERT_EQ(asked.questions.size(), 1u);
  EXPECT_EQ(asked.questions[0].option, table.option);
  EXPECT_THAT(asked.questions[0].text, HasSubstr(table.question));
  const TableReading answered = ReadTable(table.family, bytes, table.answer);
  for (const Question& question : answered.questions) EXPECT_NE(question.option, table.option);
  if (asked.header_row == 0) return;  // what the columns are is the next question
  EXPECT_FALSE(ReadAs(table.family, bytes, table.answer).parts.empty());
}

const OpenTable kOpen[] = {
    {"thousands_or_decimals.csv",
     "manifold",
     "decimal",
     "\"1,234\" a number with decimals",
     {"", "", "comma", 0, {}, {}}},
    {"points_in_a_table_of_commas.csv",
     "reservoir",
     "decimal",
     "\"1.250\"",
     {"", "", "comma", 0, {}, {}}},
    {"mixed_decimals.csv",
     "manifold",
     "decimal",
     "\"405.5\" and \"210,5\"",
     {"", "", "point", 0, {{"Weight [g]", ""}}, {}}},
    {"two_columns_for_one_field.csv", "manifold", "column", "both give mass_kg",
     BySetting({{"mass (g)", ""}}, {})},
    {"encoding.csv", "manifold", "encoding", "0xE0", {"windows-1252", "", "", 0, {}, {}}},
    {"unit_missing.csv", "manifold", "column", "in which unit is \"210\"",
     BySetting({{"Gewicht", "mass_kg [g]"}}, {})},
    {"which_volume.csv", "reservoir", "column", "internal_volume_ml or body_volume_ml",
     BySetting({{"Volume [ml]", "internal_volume_ml"}}, {{"body_volume_ml", "200"}})},
    {"delimiter.csv",
     "manifold",
     "delimiter",
     "comma gives 4 columns",
     {"", "semicolon", "", 0, {}, {}}},
    {"currency_missing.csv", "silencer", "column", "in which currency is \"12.5\"",
     BySetting({{"Price", "offer_price [USD]"}}, {})},
    {"price_of_a_roll.csv", "tubing", "column", "is it the price of a metre",
     BySetting({}, {{"offer_pack", "50"}})},
    {"typ.csv", "vacuum_pump", "column", "is it part_number or type?",
     BySetting({{"Typ", "part_number"}}, {})},
    {"unknown_heading.csv", "manifold", "column", "which column of manifold",
     BySetting({{"Lagerort", ""}}, {})},
};
INSTANTIATE_TEST_SUITE_P(Each, Open, testing::ValuesIn(kOpen));

TEST(OpenTables, AnswersDecideWhatIsRead) {
  const std::string bytes = Bytes("open/thousands_or_decimals.csv");
  const auto mass = [&](const char* decimal) {
    TableOptions options;
    options.decimal = decimal;
    return ReadAs("manifold", bytes, options).parts.at(0).numbers.at(kMass).value;
  };
  EXPECT_DOUBLE_EQ(mass("comma"), 0.001234);
  EXPECT_DOUBLE_EQ(mass("point"), 1.234);
}

TEST(OpenTables, WrongAnswersAreRefused) {
  const std::string bytes = Bytes("open/unit_missing.csv");
  const auto detail = [&](const TableOptions& options) {
    const TableReading reading = ReadTable("manifold", bytes, options);
    return reading.errors.empty() ? "" : reading.errors[0].detail;
  };
  EXPECT_THAT(detail(BySetting({{"Gewicht", "mass_kg [bar]"}}, {})), HasSubstr("is no unit"));
  EXPECT_THAT(detail(BySetting({{"Gewicht", "mas_kg"}}, {})), HasSubstr("nearest: mass_kg"));
  EXPECT_THAT(detail(BySetting({{"Masse", "mass_kg"}}, {})), HasSubstr("has no column"));
  EXPECT_THAT(detail(BySetting({}, {{"mas_kg", "1"}})), HasSubstr("nearest: mass_kg"));
  EXPECT_THAT(detail(BySetting({}, {{"manufacturer", "SMC"}})), HasSubstr("the table has it"));
  EXPECT_THAT(detail({"", "dot", "", 0, {}, {}}), HasSubstr("must be one of"));
  EXPECT_THAT(detail({"", "", "", 99, {}, {}}), HasSubstr("is no row"));
}

TEST(ForeignTables, ErrorsNameTheRowOfTheFileAndItsHeading) {
  const Read read = ReadAs("manifold",
                           "Title;;;\nMaker;Model;Stations;Weight [g]\nFesto;A;4;heavy\n"
                           "Festo;B;4;1,5 bar\nFesto;C;4;2,5\n");
  ASSERT_EQ(read.errors.size(), 1u);  // what cannot be converted comes first
  EXPECT_EQ(read.errors[0].row, 4);
  EXPECT_EQ(read.errors[0].column, "Weight [g]");
  EXPECT_THAT(read.errors[0].detail, HasSubstr("1.5 bar"));
}

TEST(ForeignTables, TwoPartsNeverBecomeOne) {
  const Read read = ReadAs("manifold", "Maker;Model;Stations\nSMC;V-1;4\nSMC;V 1;5\n");
  ASSERT_EQ(read.errors.size(), 1u);
  EXPECT_THAT(read.errors[0].detail, HasSubstr("is in row 2"));
}

}  // namespace foreign_test
}  // namespace plenum::catalog
