// Tables fit the terminal and lose no row, no column and no number.
#include "server/render/text/text_table.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace plenum::server {
namespace text_table_test {

using Align = Table::Align;

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Characters of a UTF-8 text.
std::size_t Characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

std::size_t Longest(const std::string& text) {
  std::size_t longest = 0;
  for (const std::string& line : LinesOf(text)) longest = std::max(longest, Characters(line));
  return longest;
}

TEST(TextTable, IsAsWideAsItsCellsWhereThereIsRoom) {
  Table table({{"part", Align::kLeft}, {"kg"}}, 2);
  table.Add({"a valve", "0.1"});
  table.Add({"b", "12.25"});
  EXPECT_EQ(table.Text(80),
            "  part        kg\n"
            "  ───────  ─────\n"
            "  a valve    0.1\n"
            "  b        12.25\n");
}

TEST(TextTable, CutsTextAndNeitherNumbersNorTheFirstColumn) {
  Table table({{"id", Align::kLeft}, {"source", Align::kLeft}, {"kg"}});
  table.Add({"generic-push-on-4mm", std::string(100, 'x'), "0.123456"});
  const std::string text = table.Text(60);
  EXPECT_EQ(Longest(text), 60u);
  EXPECT_NE(text.find("generic-push-on-4mm"), std::string::npos);
  EXPECT_NE(text.find("x…"), std::string::npos);
  EXPECT_NE(text.find("0.123456"), std::string::npos);
}

TEST(TextTable, WrapsTitlesAndThenBecomesSeveralWithTheFirstColumn) {
  Table table({{"t s"}, {"first pressure kPa"}, {"second pressure kPa"}, {"third pressure kPa"}});
  table.Add({"0.5", "1.5", "2.5", "3.5"});
  EXPECT_EQ(table.Text(46),
            "        first    second     third\n"
            "     pressure  pressure  pressure\n"
            "t s       kPa       kPa       kPa\n"
            "───  ────────  ────────  ────────\n"
            "0.5       1.5       2.5       3.5\n");
  EXPECT_EQ(table.Text(30),
            "        first    second\n"
            "     pressure  pressure\n"
            "t s       kPa       kPa\n"
            "───  ────────  ────────\n"
            "0.5       1.5       2.5\n"
            "\n"
            "        third\n"
            "     pressure\n"
            "t s       kPa\n"
            "───  ────────\n"
            "0.5       3.5\n");
}

TEST(TextTable, OfAnyShapeFits) {
  std::mt19937 random(1);
  const auto draw = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  for (int i = 0; i < 2000; ++i) {
    std::vector<Table::Column> columns;
    for (int n = draw(1, 12); n > 0; --n)
      columns.push_back({std::string(static_cast<std::size_t>(draw(0, 24)), 'T'),
                         draw(0, 1) != 0 ? Align::kLeft : Align::kRight});
    Table table(columns, draw(0, 4));
    const int rows = draw(0, 4);
    for (int row = 0; row < rows; ++row) {
      std::vector<std::string> cells;
      for (const auto& column : columns) {
        const bool text = column.align == Align::kLeft;
        std::string cell;
        for (int n = draw(0, text ? 120 : 12); n > 0; --n) cell += text ? "ü" : "7";
        cells.push_back(cell);
      }
      table.Add(cells);
    }
    const auto width = static_cast<std::size_t>(draw(80, 200));
    const std::string fitted = table.Text(width), whole = table.Text(kAnyWidth);
    EXPECT_LE(Longest(fitted), width) << fitted;
    // Numbers are never cut, wherever they stand.
    const auto sevens = [](const std::string& text) {
      return std::count(text.begin(), text.end(), '7');
    };
    const bool first_repeats = columns.front().align == Align::kRight;
    if (!first_repeats) {
      EXPECT_EQ(sevens(fitted), sevens(whole)) << fitted;
    }
    if (Longest(whole) <= width && rows > 0) {
      EXPECT_EQ(fitted, whole);
    }
  }
}

TEST(TextTable, TakesTheWidthFromTheEnvironment) {
  ASSERT_EQ(setenv("COLUMNS", "91", 1), 0);
  EXPECT_EQ(TerminalWidth(), 91u);
  ASSERT_EQ(setenv("COLUMNS", "12", 1), 0);
  EXPECT_EQ(TerminalWidth(), 40u);
  ASSERT_EQ(unsetenv("COLUMNS"), 0);
}

}  // namespace text_table_test
}  // namespace plenum::server
