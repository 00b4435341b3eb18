#include "catalog/fields/csv_table.h"

#include <algorithm>
#include <utility>

#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class Parser {
 public:
  Parser(std::string_view text, const TakeRow& take, const TakeError& fail, char delimiter)
      : text_(text), take_(take), fail_(fail), delimiter_(delimiter) {}

  void Parse() {
    int empty = 0;  // rows that are dropped if no other follows
    while (at_ < text_.size()) {
      ++row_;
      CsvRow cells = ParseRow();
      CheckText(cells);
      if (row_ == 1) header_ = cells;
      if (cells == CsvRow{""}) {
        ++empty;
        continue;
      }
      for (; empty > 0; --empty) take_({""}, row_ - empty);
      take_(std::move(cells), row_);
    }
  }

 private:
  CsvRow ParseRow() {
    CsvRow cells;
    for (;;) {
      const std::size_t column = cells.size();
      std::string cell = text_.substr(at_, 1) == "\"" ? Quoted(column) : Plain(column);
      if (cell.size() > kCsvCellBytesMax)
        Fail(column, "has more than " + std::to_string(kCsvCellBytesMax) +
                         " bytes (import_cell_bytes_max)");
      if (column < kCsvColumnsMax)
        cells.push_back(std::move(cell));
      else
        overlong_ = true;
      if (at_ < text_.size() && text_[at_] == delimiter_) {
        ++at_;
        continue;
      }
      SkipLineEnd();
      if (std::exchange(overlong_, false))
        fail_({row_, "",
               "has more than " + std::to_string(kCsvColumnsMax) + " cells (import_columns_max)"});
      return cells;
    }
  }

  bool AtLineEnd() const {
    return at_ >= text_.size() || text_[at_] == '\n' || text_.substr(at_, 2) == "\r\n";
  }

  void SkipLineEnd() { at_ += text_.substr(at_, 1) == "\r" ? 2 : 1; }

  std::string Plain(std::size_t column) {
    const std::size_t begin = at_;
    const auto ends = [&](std::size_t at) {
      const char c = text_[at];
      return c == delimiter_ || c == '\n' || (c == '\r' && text_.substr(at, 2) == "\r\n");
    };
    std::size_t end = begin;
    while (end < text_.size() && !ends(end)) ++end;
    at_ = end;
    std::string cell(text_.substr(begin, std::min(at_ - begin, kCsvCellBytesMax + 1)));
    if (cell.find('"') != std::string::npos)
      Fail(column, "a quote inside a cell that does not start with one");
    return cell;
  }

  std::string Quoted(std::size_t column) {
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"' && text_.substr(at_ + 1, 1) != "\"") {
        ++at_;
        if (!AtLineEnd() && text_[at_] != delimiter_) {
          Fail(column, "text after a closing quote");
          Plain(column);
        }
        return cell;
      }
      if (text_[at_] == '"') ++at_;
      if (cell.size() <= kCsvCellBytesMax) cell += text_[at_];
    }
    Fail(column, "a quote that is never closed");
    return cell;
  }

  void CheckText(const CsvRow& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!IsCleanText(cells[i]))
        fail_(
            {row_, "column " + std::to_string(i + 1), "must be UTF-8 without control characters"});
  }

  // The column is named by the header if that has been read.
  void Fail(std::size_t column, std::string detail) {
    const bool named = row_ > 1 && column < header_.size();
    fail_({row_, named ? header_[column] : "column " + std::to_string(column + 1),
           std::move(detail)});
  }

  std::string_view text_;
  const TakeRow& take_;
  const TakeError& fail_;
  char delimiter_;
  std::size_t at_ = 0;
  int row_ = 0;
  CsvRow header_;
  bool overlong_ = false;  // the row that is being read
};

}  // namespace

void ForEachRow(std::string_view text, const TakeRow& take, const TakeError& fail, char delimiter) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Parser(text, take, fail, delimiter).Parse();
}

CsvTable ParseTable(std::string_view text) {
  CsvTable table;
  ForEachRow(
      text, [&](CsvRow cells, int) { table.rows.push_back(std::move(cells)); },
      [&](CsvError error) { table.errors.push_back(std::move(error)); });
  return table;
}

std::string FormatRow(const CsvRow& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (cells[i].find_first_of("\",\r\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (char c : cells[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

}  // namespace plenum::catalog
