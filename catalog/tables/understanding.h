// What is understood of a table of parts as people have it, what it leaves open, and the answers.
#ifndef PLENUM_CATALOG_TABLES_UNDERSTANDING_H_
#define PLENUM_CATALOG_TABLES_UNDERSTANDING_H_

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/csv.h"
#include "catalog/tables/decimal.h"
#include "catalog/tables/heading.h"

namespace plenum::catalog {

// Answers of a person; what is empty is found out.
struct TableOptions {
  std::string encoding;   // one of EncodingNames()
  std::string delimiter;  // one of DelimiterNames()
  std::string decimal;    // "point" or "comma", of the whole table
  int header_row = 0;     // counts records from 1
  // By heading, or "#3" for the third column: "mass_kg [g]", several with '+' between them, or
  // empty to leave the column out. "*" stands for all headings that are not known.
  std::map<std::string, std::string> columns;
  std::map<std::string, std::string> set;  // the same for all parts, by column of CsvColumns
  bool operator==(const TableOptions&) const = default;
};

struct Question {
  std::string
      option;  // that answers it: "encoding", "delimiter", "decimal", "header_row", "column"
  std::string heading;  // of the column that it is about
  std::string text;
  std::vector<std::string> answers;  // some that are possible
  bool operator==(const Question&) const = default;
};

struct ColumnRead {
  std::string key;  // heading, or "#3" where another column has the same or there is none
  std::string heading;
  std::vector<Target> targets;  // none: left out
  Decimal decimal = Decimal::kPoint;
  bool has_decimals = false;         // the mark was needed
  std::vector<std::string> samples;  // the first cells that are not empty
};

struct RowLeftOut {
  int row = 0;
  std::string why;
  bool operator==(const RowLeftOut&) const = default;
};

// Complete where there are neither questions nor errors.
struct TableReading {
  std::string family;
  bool as_exported = false;  // the project's own CSV: read as it is
  std::string encoding, delimiter;
  int header_row = 0;
  int units_row = 0;       // with the units alone, below the header; 0: none
  bool makes_ids = false;  // of manufacturer and part number
  std::vector<ColumnRead> columns;
  std::map<std::string, std::string> set;
  std::vector<RowLeftOut> left_out;  // the first of them, at most kRowsLeftOutShown
  std::size_t left_out_count = 0;
  std::vector<Question> questions;
  std::vector<CsvError> errors;  // of the options and of the bytes
  std::string text;              // decoded; empty where the bytes themselves are the text
};
inline constexpr std::size_t kRowsLeftOutShown = 50;

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_UNDERSTANDING_H_
