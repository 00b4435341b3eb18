// Aligned text tables for a terminal.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_TABLE_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_TABLE_H_

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "api/json/json.h"

namespace plenum::server {

inline constexpr std::size_t kAnyWidth = std::numeric_limits<std::size_t>::max();

// Characters of a line: COLUMNS where it is set, else what the terminal at standard output says,
// and kAnyWidth where that is none. At least 40.
std::size_t TerminalWidth();

class Table {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string title;
    Align align = Align::kRight;
  };

  explicit Table(std::vector<Column> columns, int indent = 0)
      : columns_(std::move(columns)), indent_(indent) {}
  void Add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  // Title line, a rule, then the rows; columns two blanks apart. No line is longer than `width`:
  // titles are wrapped, cells with text cut, the widest first; the first column may keep half of
  // the line. Where that is not enough the columns stand in several tables, each with the first.
  std::string Text(std::size_t width = TerminalWidth()) const;

 private:
  // Of each column, its title on one line or, wrapped, a word a line.
  std::vector<std::size_t> Widths(bool wrapped) const;
  // The columns of these numbers, each so wide.
  std::string Lines(const std::vector<std::size_t>& shown,
                    const std::vector<std::size_t>& widths) const;

  std::vector<Column> columns_;
  int indent_;
  std::vector<std::vector<std::string>> rows_;
};

// At most `width` characters (not bytes); what is cut ends in "…".
std::string Cut(const std::string& text, std::size_t width);

// Three significant digits: 1234, 12.3, 0.0123; "–" for null and what is not finite.
std::string Short(double value);
std::string Short(const api::Json& value);
// 1 234 567 from 1234567.
std::string Grouped(const api::Json& count);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_TABLE_H_
