#include "catalog/csv_table.h"

#include <utility>

#include "catalog/text.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  CsvTable Parse() {
    while (at_ < text_.size()) ParseRow();
    while (!table_.rows.empty() && table_.rows.back() == CsvRow{""}) table_.rows.pop_back();
    return std::move(table_);
  }

 private:
  void ParseRow() {
    table_.rows.emplace_back();
    for (;;) {
      table_.rows.back().push_back(text_.substr(at_, 1) == "\"" ? Quoted() : Plain());
      if (at_ < text_.size() && text_[at_] == ',') {
        ++at_;
        continue;
      }
      SkipLineEnd();
      return;
    }
  }

  bool AtLineEnd() const {
    return at_ >= text_.size() || text_[at_] == '\n' || text_.substr(at_, 2) == "\r\n";
  }

  void SkipLineEnd() { at_ += text_.substr(at_, 1) == "\r" ? 2 : 1; }

  std::string Plain() {
    const std::size_t begin = at_;
    while (!AtLineEnd() && text_[at_] != ',') ++at_;
    std::string cell(text_.substr(begin, at_ - begin));
    if (cell.find('"') != std::string::npos)
      Fail("a quote inside a cell that does not start with one");
    return cell;
  }

  std::string Quoted() {
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"' && text_.substr(at_ + 1, 1) != "\"") {
        ++at_;
        if (!AtLineEnd() && text_[at_] != ',') {
          Fail("text after a closing quote");
          Plain();
        }
        return cell;
      }
      if (text_[at_] == '"') ++at_;
      cell += text_[at_];
    }
    Fail("a quote that is never closed");
    return cell;
  }

  // The column is named by the header if that has been read.
  void Fail(std::string detail) {
    const std::size_t column = table_.rows.back().size();
    const bool named = table_.rows.size() > 1 && column < table_.rows.front().size();
    table_.errors.push_back(
        {static_cast<int>(table_.rows.size()),
         named ? table_.rows.front()[column] : "column " + std::to_string(column + 1),
         std::move(detail)});
  }

  std::string_view text_;
  std::size_t at_ = 0;
  CsvTable table_;
};

}  // namespace

CsvTable ParseTable(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  CsvTable table = Parser(text).Parse();
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    for (std::size_t i = 0; i < table.rows[row].size(); ++i)
      if (!IsCleanText(table.rows[row][i]))
        table.errors.push_back({static_cast<int>(row) + 1, "column " + std::to_string(i + 1),
                                "must be UTF-8 without control characters"});
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
