#include "server/render/text/text_table.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>

namespace plenum::server {
namespace {

bool StartsCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

std::size_t Width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), StartsCharacter));
}

constexpr std::size_t kGap = 2;           // between two columns
constexpr std::size_t kLeastOfText = 8;   // of a column with text that is cut
constexpr std::size_t kTextOfParts = 24;  // where columns stand in several tables

std::size_t Total(const std::vector<std::size_t>& widths) {
  return std::accumulate(widths.begin(), widths.end(), kGap * (widths.size() - 1));
}

std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// In lines of at most `width` characters, as far as its words allow.
std::vector<std::string> Wrapped(const std::string& text, std::size_t width) {
  if (Width(text) <= width) return {text};
  std::vector<std::string> lines;
  for (const std::string& word : WordsOf(text)) {
    if (!lines.empty() && Width(lines.back()) + 1 + Width(word) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

// Makes columns with text narrower, the widest first, until they fit into `room`, if they can.
void Narrow(const std::vector<Table::Column>& columns, std::size_t room,
            std::vector<std::size_t>& widths) {
  while (Total(widths) > room) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (columns[i].align == Table::Align::kLeft && (widest == 0 || widths[i] > widths[widest]))
        widest = i;
    if (widest == 0 || widths[widest] <= kLeastOfText) return;
    --widths[widest];
  }
}

// Numbers of columns that fit into `room` together, the first one of all among each.
std::vector<std::vector<std::size_t>> Parted(std::size_t room,
                                             const std::vector<std::size_t>& widths) {
  std::vector<std::vector<std::size_t>> parts;
  std::size_t used = room;
  for (std::size_t i = 1; i < widths.size(); ++i) {
    used += kGap + widths[i];
    if (used > room) {
      parts.push_back({0});
      used = widths[0] + kGap + widths[i];
    }
    parts.back().push_back(i);
  }
  return parts;
}

}  // namespace

std::vector<std::size_t> Table::Widths(bool wrapped) const {
  std::vector<std::size_t> widths;
  widths.reserve(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::size_t width = wrapped ? 0 : Width(columns_[i].title);
    if (wrapped)
      for (const std::string& word : WordsOf(columns_[i].title))
        width = std::max(width, Width(word));
    for (const auto& row : rows_) width = std::max(width, Width(row[i]));
    widths.push_back(width);
  }
  return widths;
}

std::string Table::Lines(const std::vector<std::size_t>& shown,
                         const std::vector<std::size_t>& widths) const {
  std::string text;
  const auto line = [&](auto&& cell) {
    std::string out(static_cast<std::size_t>(indent_), ' ');
    for (const std::size_t i : shown) {
      const std::string content = Cut(cell(i), widths[i]);
      const std::string blanks(widths[i] - Width(content), ' ');
      out += (i != shown.front() ? std::string(kGap, ' ') : "") +
             (columns_[i].align == Align::kRight ? blanks + content : content + blanks);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + "\n";
  };
  std::vector<std::vector<std::string>> titles(columns_.size());
  std::size_t lines = 1;
  for (const std::size_t i : shown) {
    titles[i] = Wrapped(columns_[i].title, widths[i]);
    lines = std::max(lines, titles[i].size());
  }
  for (std::size_t above = lines; above-- > 0;)
    line([&](std::size_t i) {
      return above < titles[i].size() ? titles[i][titles[i].size() - 1 - above] : std::string();
    });
  line([&](std::size_t i) {
    std::string rule;
    for (std::size_t n = 0; n < widths[i]; ++n) rule += "─";
    return rule;
  });
  for (const auto& row : rows_) {
    line([&](std::size_t i) { return row[i]; });
  }
  return text;
}

std::string Table::Text(std::size_t width) const {
  std::vector<std::size_t> all(columns_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> widths = Widths(false);
  const std::size_t room = width - std::min(width, static_cast<std::size_t>(indent_));
  if (Total(widths) <= room) return Lines(all, widths);
  widths = Widths(true);
  widths[0] = std::min(widths[0], room / 2);
  const std::size_t rest = room - widths[0] - kGap;
  for (std::size_t i = 1; i < widths.size(); ++i) widths[i] = std::min(widths[i], rest);
  std::vector<std::size_t> narrow = widths;
  Narrow(columns_, room, narrow);
  if (Total(narrow) <= room) return Lines(all, narrow);
  for (std::size_t i = 1; i < widths.size(); ++i)
    if (columns_[i].align == Align::kLeft) widths[i] = std::min(widths[i], kTextOfParts);
  std::string text;
  for (const auto& part : Parted(room, widths))
    text += (text.empty() ? "" : "\n") + Lines(part, widths);
  return text;
}

std::size_t TerminalWidth() {
  constexpr long kLeast = 40;
  const char* stated = std::getenv("COLUMNS");
  if (const long columns = stated != nullptr ? std::atol(stated) : 0; columns > 0)
    return static_cast<std::size_t>(std::max(columns, kLeast));
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kAnyWidth;
  return static_cast<std::size_t>(std::max<long>(size.ws_col, kLeast));
}

std::string Cut(const std::string& text, std::size_t width) {
  if (Width(text) <= width) return text;
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    if (StartsCharacter(text[end]) && ++characters == width) break;
  }
  return text.substr(0, end) + "…";
}

std::string Short(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < 1e-3) return fmt::format("{:.2e}", value);
  if (size >= 1e7) return fmt::format("{:.3e}", value);
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 5);
  return fmt::format("{:.{}f}", value, decimals);
}

std::string Short(const api::Json& value) {
  return value.is_number() ? Short(value.get<double>()) : "–";
}

std::string Grouped(const api::Json& count) {
  const std::string digits = count.is_string() ? count.get<std::string>() : count.dump();
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

}  // namespace plenum::server
