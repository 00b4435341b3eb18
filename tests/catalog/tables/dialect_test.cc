// A table that the program exports, rewritten in the dialects of others: the same parts come back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "catalog/tables/encoding.h"
#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"
#include "catalog/units/text.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace dialect_test {

using ::testing::ElementsAre;

struct Dialect {
  char delimiter;
  bool comma;  // before decimals
  std::string encoding;
  bool mark;  // of byte order
};

// Characters one by one, as UTF-16: written here, not with the decoder's counterpart.
std::string Encode(const std::string& text, const Dialect& dialect) {
  if (dialect.encoding == "utf-8") return (dialect.mark ? "\xEF\xBB\xBF" : "") + text;
  const bool big = dialect.encoding == "utf-16be";
  std::string bytes;
  const auto put = [&](unsigned unit) {
    const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
    bytes += big ? high : low;
    bytes += big ? low : high;
  };
  if (dialect.mark) put(0xFEFF);
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    if (byte(0) < 0x80) {
      put(byte(0));
      i += 1;
    } else if (byte(0) < 0xE0) {
      put((byte(0) & 31u) << 6 | (byte(1) & 63u));
      i += 2;
    } else {
      put((byte(0) & 15u) << 12 | (byte(1) & 63u) << 6 | (byte(2) & 63u));
      i += 3;
    }
  }
  return bytes;
}

std::string Quoted(const std::string& cell, char delimiter) {
  if (cell.find_first_of(std::string("\"\r\n") + delimiter) == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string Rewritten(const std::string& csv, const Family& family, const Dialect& dialect) {
  const CsvTable table = ParseTable(csv);
  std::string text;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (std::size_t i = 0; i < table.rows[r].size(); ++i) {
      std::string cell = table.rows[r][i];
      if (dialect.comma && r > 0 && FindNumber(family, table.rows[0][i]) != nullptr)
        for (char& c : cell)
          if (c == '.') c = ',';
      text += (i > 0 ? std::string(1, dialect.delimiter) : "") + Quoted(cell, dialect.delimiter);
    }
    text += "\r\n";
  }
  return Encode(text, dialect);
}

Part WithoutOuterBlanks(Part part) {
  const auto trim = [](std::string& text) {
    while (!text.empty() && std::string(" \n\r").find(text.back()) != std::string::npos)
      text.pop_back();
  };
  trim(part.manufacturer);
  trim(part.part_number);
  trim(part.notes);
  trim(part.series);
  for (auto& [name, text] : part.texts) trim(text.value), trim(text.source);
  for (auto& [name, number] : part.numbers) trim(number.source);
  if (part.curve) trim(part.curve->free_air_source), trim(part.curve->current_source);
  return part;
}

// Numbers such as 1.234, which other dialects write 1,234.
void MakeNumbersOpen(const Family& family, std::mt19937& random, Part& part) {
  for (auto& [name, number] : part.numbers) {
    const NumberField* field = FindNumber(family, name);
    const double value = 1.0 + static_cast<double>(101 + 10 * (random() % 89)) / 1000.0;
    if (field->min <= value && value <= field->max) number.value = value;
  }
  DerivePrice(part);
}

TEST(Dialects, AreReadToTheSameParts) {
  std::mt19937 random(20240702);
  const std::string encodings[] = {"utf-8", "utf-16le", "utf-16be"};
  int asked = 0, read = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Family& family = Families()[draw % Families().size()];
    std::vector<Part> parts;
    for (int i = 0; i < 3; ++i)
      parts.push_back(WithoutOuterBlanks(AnyPart(family, "part-" + std::to_string(i), random)));
    if (draw % 4 == 0)
      for (Part& part : parts) MakeNumbersOpen(family, random, part);
    std::erase_if(parts, [](const Part& part) { return !Validate(part).empty(); });
    const Dialect dialect{",;\t|"[random() % 4], random() % 2 == 0, encodings[random() % 3],
                          random() % 2 == 0};
    const std::string bytes = Rewritten(WriteCsv(family.name, parts), family, dialect);
    TableOptions options;
    // With the delimiter of the program's own CSV, the comma before decimals must be told.
    if (dialect.delimiter == ',' && dialect.comma) options.decimal = "comma";
    TableReading reading = ReadTable(family.name, bytes, options);
    // What 1,234 or 1.234 is may be asked, nothing else.
    for (const Question& question : reading.questions) {
      ASSERT_EQ(question.option, "decimal") << question.text;
      options.decimal = dialect.comma ? "comma" : "point";
    }
    asked += !options.decimal.empty();
    read += options.decimal.empty();
    if (!options.decimal.empty()) reading = ReadTable(family.name, bytes, options);
    ASSERT_TRUE(reading.questions.empty());
    std::vector<Part> again;
    const CsvErrors errors = ReadRows(family.name, RowsOf(reading, bytes),
                                      [&](Part part, int) { again.push_back(std::move(part)); });
    for (const CsvError& error : errors.errors)
      ADD_FAILURE() << error.row << " " << error.column << ": " << error.detail;
    ASSERT_EQ(again, parts) << family.name << " " << dialect.delimiter << dialect.encoding;
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(asked, 10);
}

TEST(Dialects, AnExportIsReadAsItIs) {
  std::mt19937 random(5);
  for (const Family& family : Families()) {
    const std::string csv = WriteCsv(family.name, {AnyPart(family, "a", random)});
    const TableReading reading = ReadTable(family.name, csv);
    EXPECT_TRUE(reading.as_exported) << family.name;
    std::vector<Part> parts;
    ReadRows(family.name, RowsOf(reading, csv), [&](Part part, int) { parts.push_back(part); });
    EXPECT_EQ(WriteCsv(family.name, parts), csv);
  }
}

TEST(Dialects, MutatedTablesAreReadOrRefused) {
#ifdef PLENUM_SANITIZED
  constexpr int kDraws = 200;
#else
  constexpr int kDraws = 2'000;
#endif
  std::mt19937 random(99);
  const std::string seed =
      "Titel;;;;\nHersteller;Modell;Stationen;Gewicht [g];C [dm3/(s bar)]\n"
      ";;;;\nSMC;V-1;4;1.234,5;0,28\nSMC;V-2;8;350 g;Cv 0,05\nSumme;;12;;\n";
  const char* const kTokens[] = {";",    "\"", "\n",  "\t", "1,234", "[g]",   "(",
                                 "\xE8", "Σ",  "-",   "e5", "#1",    "sep=;", " in ",
                                 "/",    "\r", "1/4", "Cv", "''",    "9 999"};
  int read = 0;
  for (int i = 0; i < kDraws; ++i) {
    std::string bytes = seed;
    for (unsigned k = 0; k < 1 + random() % 4; ++k) {
      const std::size_t at = random() % bytes.size();
      if (random() % 3 == 0)
        bytes.erase(at, 1 + random() % 6);
      else
        bytes.insert(at, kTokens[random() % std::size(kTokens)]);
    }
    TableOptions options;
    if (random() % 2 == 0) options.columns["*"] = "";
    if (random() % 2 == 0) options.decimal = "comma";
    const TableReading reading = ReadTable("manifold", bytes, options);
    if (!reading.questions.empty() || !reading.errors.empty()) continue;
    std::vector<Part> parts;
    const CsvErrors errors = ReadRows("manifold", RowsOf(reading, bytes),
                                      [&](Part part, int) { parts.push_back(std::move(part)); });
    if (errors.count > 0) continue;
    ++read;
    for (const Part& part : parts) ASSERT_TRUE(Validate(part).empty());
  }
  EXPECT_GT(read, kDraws / 50);
}

TEST(Encodings, AreFoundOrAskedFor) {
  EXPECT_EQ(Decode("abc", "").encoding, "utf-8");
  EXPECT_EQ(Decode("Gr\xC3\xB6\xC3\x9F"
                   "e",
                   "")
                .encoding,
            "utf-8");
  EXPECT_EQ(Decode("Gr\xF6\xDF"
                   "e 5 dm\xB3, 20 \xB0"
                   "C",
                   "")
                .text,
            "Größe 5 dm³, 20 °C");
  // Polish "dmł", Czech "č", German of DOS: other letters stand there.
  EXPECT_NE(Decode("z\xB3"
                   "oty",
                   "")
                .question,
            "");
  EXPECT_NE(Decode("\xE8"
                   "erpadlo",
                   "")
                .question,
            "");
  EXPECT_NE(Decode("Gr\x94\xE1"
                   "e",
                   "")
                .question,
            "");
  EXPECT_EQ(Decode("\xE8", "windows-1252").text, "è");
  EXPECT_NE(Decode("\xFF\xFE"
                   "a",
                   "")
                .error,
            "");
  EXPECT_EQ(Decode(std::string("a\0b\0", 4), "").text, "ab");
}

}  // namespace dialect_test
}  // namespace plenum::catalog
