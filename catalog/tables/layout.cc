#include "catalog/tables/layout.h"

#include <algorithm>
#include <map>

#include "catalog/tables/heading_words.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kFrontBytes = 256 << 10;
constexpr std::size_t kFrontRecords = 200;
constexpr std::size_t kHeaderWithin = 50;
constexpr std::ptrdiff_t kCellsLookedAt = 100;  // of a record, for headings
constexpr int kKnownFewest = 2;
constexpr std::size_t kColumnsForTitles = 3;
constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kDelimiters = ",;\t|";

int CountKnown(const KnownHeading& is_known, const CsvRow& cells, const TableOptions& options) {
  const auto end = cells.begin() + std::min(std::ssize(cells), kCellsLookedAt);
  return static_cast<int>(std::count_if(cells.begin(), end, [&](const std::string& cell) {
    if (IsBlank(cell) || (cell[0] >= '0' && cell[0] <= '9')) return false;
    return options.columns.contains(cell) || is_known(cell);
  }));
}

// How many cells most records have.
std::size_t UsualWidth(const std::vector<Record>& records) {
  std::map<std::size_t, int> counts;
  for (const Record& record : records)
    if (CountFilled(record.cells) > 1) ++counts[record.cells.size()];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 1 : most->first;
}

struct Candidate {
  std::string name;
  std::size_t width = 1;
  int known = 0;       // headings
  double share = 0.0;  // of the records that are as wide as most
};

Candidate Try(const KnownHeading& is_known, std::string_view text, const std::string& name,
              const TableOptions& options) {
  const auto records = FirstRecords(text, DelimiterOf(name));
  Candidate candidate{name, UsualWidth(records), 0, 0.0};
  if (records.empty()) return candidate;
  candidate.known = FindHeader(is_known, records, options).known;
  const auto usual = std::count_if(records.begin(), records.end(), [&](const Record& record) {
    return record.cells.size() == candidate.width;
  });
  candidate.share = static_cast<double>(usual) / static_cast<double>(records.size());
  return candidate;
}

// "sep=;" in the first line, as some spreadsheets write it.
std::string SaidDelimiter(std::string_view text) {
  if (!text.starts_with("sep=") || text.size() < 5) return "";
  const std::size_t at = kDelimiters.find(text[4]);
  return at == std::string_view::npos ? "" : DelimiterNames()[at];
}

}  // namespace

const std::vector<std::string>& DelimiterNames() {
  static const std::vector<std::string> kNames = {"comma", "semicolon", "tab", "pipe"};
  return kNames;
}

char DelimiterOf(std::string_view name) {
  const auto& names = DelimiterNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? ',' : kDelimiters[static_cast<std::size_t>(found - names.begin())];
}

std::vector<Record> FirstRecords(std::string_view text, char delimiter) {
  const bool cut = text.size() > kFrontBytes;
  std::vector<Record> records;
  ForEachRow(
      text.substr(0, kFrontBytes),
      [&](CsvRow cells, int row) {
        if (records.size() < kFrontRecords && CountFilled(cells) > 0)
          records.push_back({std::move(cells), row});
      },
      [](const CsvError&) {}, delimiter);
  if (cut && records.size() < kFrontRecords && records.size() > 1) records.pop_back();
  return records;
}

KnownHeading HeadingsOf(const Family& family) {
  return [&family](const std::string& heading) {
    return !MatchHeading(family, heading).targets.empty();
  };
}

Header FindHeader(const KnownHeading& is_known, const std::vector<Record>& records,
                  const TableOptions& options) {
  Header header;
  if (options.header_row > 0) {
    const auto given = std::find_if(records.begin(), records.end(), [&](const Record& record) {
      return record.row == options.header_row;
    });
    header.index = static_cast<std::size_t>(given - records.begin());
    if (given != records.end()) header.known = CountKnown(is_known, given->cells, options);
    return header;
  }
  for (std::size_t i = 0; i < std::min(records.size(), kHeaderWithin); ++i) {
    const int known = CountKnown(is_known, records[i].cells, options);
    if (known > header.known) header = {i, known};
  }
  if (header.known >= kKnownFewest) return header;
  const std::size_t width = UsualWidth(records);
  const auto first = std::find_if(records.begin(), records.end(), [&](const Record& record) {
    return record.cells.size() == width && CountFilled(record.cells) > 1;
  });
  if (first != records.end()) header.index = static_cast<std::size_t>(first - records.begin());
  return header;
}

void FindDelimiter(const KnownHeading& is_known, std::string_view text, const TableOptions& options,
                   TableReading& reading) {
  reading.delimiter = options.delimiter.empty() ? SaidDelimiter(text) : options.delimiter;
  if (!reading.delimiter.empty()) return;
  std::vector<Candidate> candidates;
  for (const std::string& name : DelimiterNames()) {
    Candidate candidate = Try(is_known, text, name, options);
    if (candidate.width > 1) candidates.push_back(std::move(candidate));
  }
  // The one that makes most headings known; without any known, the only one that makes columns.
  int most = 0;
  for (const Candidate& candidate : candidates) most = std::max(most, candidate.known);
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return most >= kKnownFewest ? candidate.known < most : candidate.share <= 0.5;
  });
  if (candidates.size() == 1) {
    reading.delimiter = candidates.front().name;
    return;
  }
  Question question{"delimiter", "", "", {}};
  for (const Candidate& candidate : candidates) {
    question.text += (question.text.empty() ? "" : ", ") + candidate.name + " gives " +
                     std::to_string(candidate.width) + " columns";
    question.answers.push_back(candidate.name);
  }
  if (candidates.empty()) question.answers = DelimiterNames();
  question.text = candidates.empty() ? "no delimiter makes columns of this text: which one is it?"
                                     : "which delimiter is it? " + question.text;
  reading.questions.push_back(std::move(question));
}

bool IsBlank(std::string_view cell) {
  for (std::size_t at = 0; (at = cell.find_first_not_of(kBlanks, at)) != std::string_view::npos;
       at += 2)
    if (!cell.substr(at).starts_with("\u00A0")) return false;
  return true;
}

std::size_t CountFilled(const CsvRow& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return !IsBlank(cell); }));
}

const char* WhyNoPart(const Family& family, const std::vector<ColumnRead>& columns,
                      const CsvRow& cells) {
  const auto is_number = [&](const ColumnRead& column) {
    return std::any_of(column.targets.begin(), column.targets.end(), [&](const Target& target) {
      return FindNumber(family, target.column) != nullptr;
    });
  };
  bool label = false, sums = true, again = true;
  for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i) {
    again = again && cells[i] == columns[i].heading;
    if (IsBlank(cells[i])) continue;
    if (!label) {
      if (!(label = IsTotalLabel(cells[i]))) sums = false;
    } else if (!columns[i].targets.empty() && !is_number(columns[i])) {
      sums = false;
    }
    label = true;
  }
  if (again) return "the header again";
  if (sums) return "a row of totals";
  if (CountFilled(cells) == 1 && columns.size() >= kColumnsForTitles) return "one cell only";
  return nullptr;
}

}  // namespace plenum::catalog
