#include "api/measure/csv/recording_rows.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "api/json/words.h"
#include "api/measure/csv/recording_columns.h"
#include "catalog/tables/decimal.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/tables/layout.h"

namespace plenum::api {
namespace {

using catalog::CsvRow;
using catalog::Trimmed;

constexpr std::size_t kErrorsMax = 20;
constexpr std::size_t kSamples = 3, kSampleBytes = 60;
constexpr std::size_t kValveWordsMax = 1000;

bool IsMissing(std::string_view cell) {
  for (const std::string_view one :
       {"", "NaN", "nan", "NAN", "null", "NULL", "NA", "N/A", "n/a", "-", "--", "∞", "-∞", "inf",
        "-inf", "Inf", "-Inf", "Infinity", "-Infinity"})
    if (cell == one) return true;
  return false;
}

class RowReader {
 public:
  explicit RowReader(Recording& recording) : recording_(recording), table_(recording.table) {
    for (std::size_t i = 0; i < table_.columns.size(); ++i)
      if (!table_.columns[i].targets.empty()) needed_ = i + 1;
    for (const auto& column : table_.columns)
      fields_.push_back(column.targets.empty() ? "" : column.targets.front().column);
  }

  void Read(CsvRow cells, int line) {
    line_ = line;
    if (stopped_ || catalog::CountFilled(cells) == 0 || IsHeaderAgain(cells)) return;
    while (cells.size() > table_.columns.size() && catalog::IsBlank(cells.back())) cells.pop_back();
    if (cells.size() > table_.columns.size() || cells.size() < needed_) return FailWidth(cells);
    RecordedRun* run = RunOf(cells);
    if (run == nullptr) return;
    TakeSpecimen(cells, *run);
    const auto t_s = TimeOf(cells, *run);
    if (!t_s) return;
    if (run->t_s.size() >= kRunSamplesMax)
      return Stop("run " + Quoted(run->id) + " has more than " + std::to_string(kRunSamplesMax) +
                  " readings");
    run->t_s.push_back(*t_s);
    run->lines.push_back(line);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view cell = Trimmed(cells[i]);
      auto& samples = table_.columns[i].samples;
      if (samples.size() < kSamples && !cell.empty() && cell.size() <= kSampleBytes)
        samples.emplace_back(cell);
      if (IsReadingField(fields_[i])) run->readings[fields_[i]].push_back(ReadingOf(i, cell));
      for (std::size_t k = 0; k < kValveFields.size(); ++k)
        if (fields_[i] == kValveFields[k]) run->valves[k].push_back(ValveOf(i, cell));
    }
  }

  void Fail(int line, const std::string& column, std::string detail) {
    if (stopped_) return;
    table_.errors.push_back({line, column, std::move(detail)});
    if (table_.errors.size() >= kErrorsMax) {
      table_.errors.push_back({line, "", "too many errors; the rest is unread"});
      stopped_ = true;
    }
  }

 private:
  void Stop(std::string detail) {
    Fail(line_, "", std::move(detail));
    stopped_ = true;
  }

  void FailCell(std::size_t i, std::string detail) {
    Fail(line_, table_.columns[i].key, std::move(detail));
  }

  bool IsHeaderAgain(const CsvRow& cells) const {
    if (!recording_.has_headings || cells.size() != table_.columns.size()) return false;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (Trimmed(cells[i]) != table_.columns[i].heading) return false;
    return true;
  }

  void FailWidth(const CsvRow& cells) {
    std::string detail = "has " + std::to_string(cells.size()) + " cells, must have " +
                         std::to_string(table_.columns.size());
    if (table_.delimiter == "comma" && cells.size() > table_.columns.size())
      detail +=
          "; is a comma both the delimiter and the decimal mark? Then no reader can tell "
          "them apart: export it with another delimiter";
    Fail(line_, "row", std::move(detail));
  }

  RecordedRun* RunOf(const CsvRow& cells) {
    const int column = recording_.ColumnOf(kRunField);
    std::string id(kOnlyRun);
    if (column >= 0) {
      id = Trimmed(cells[static_cast<std::size_t>(column)]);
      if (id.empty()) {
        FailCell(static_cast<std::size_t>(column), "must name the run");
        return nullptr;
      }
    }
    const auto [found, is_new] = index_.try_emplace(id, recording_.runs.size());
    if (is_new && recording_.runs.size() >= kRunsMax) {
      Stop("more than " + std::to_string(kRunsMax) +
           " runs; is the column of the runs another one?");
      return nullptr;
    }
    if (is_new)
      recording_.runs.push_back({.id = id,
                                 .specimen = {},
                                 .lines = {},
                                 .t_s = {},
                                 .valves = {},
                                 .readings = {},
                                 .states = {},
                                 .clock = {},
                                 .has_clock = false});
    return &recording_.runs[found->second];
  }

  void TakeSpecimen(const CsvRow& cells, RecordedRun& run) {
    const int column = recording_.ColumnOf(kSpecimenField);
    if (column < 0) return;
    const auto at = static_cast<std::size_t>(column);
    const std::string name(Trimmed(cells[at]));
    if (run.t_s.empty()) run.specimen = name;
    if (run.specimen != name)
      FailCell(at, "must be one for all rows of run " + Quoted(run.id) + ", which began with " +
                       Quoted(run.specimen) + ", not " + Quoted(name));
  }

  std::optional<double> TimeOf(const CsvRow& cells, RecordedRun& run) {
    const auto column = static_cast<std::size_t>(recording_.ColumnOf(kTimeField));
    const std::string_view cell = Trimmed(cells[column]);
    std::optional<double> t_s;
    if (auto clock = ParseClock(cell)) {
      if (const int date = recording_.ColumnOf(kDateField); date >= 0 && !clock->day)
        clock->day = ParseDay(cells[static_cast<std::size_t>(date)]);
      t_s = run.clock.Add(*clock);
      run.has_clock = true;
    } else if (run.has_clock) {
      FailCell(column, "must be a clock time as in the lines before, not " + Quoted(cell));
      return std::nullopt;
    } else {
      t_s = NumberOf(column, cell);
    }
    if (!t_s) {
      FailCell(column, "must be a number or a clock time as 12:03:04.250, not " + Quoted(cell));
    } else if (!run.t_s.empty() && *t_s < run.t_s.back()) {
      FailCell(column, "must not fall from row to row, and " + Quoted(cell) +
                           " is before the time of line " + std::to_string(run.lines.back()) +
                           "; if another run begins here, name the runs in a column \"run\"");
      return std::nullopt;
    }
    return t_s;
  }

  // In the unit of the field; none: no number.
  std::optional<double> NumberOf(std::size_t i, std::string_view cell) {
    const auto& column = table_.columns[i];
    double x = 0.0;
    const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
    const bool plain = column.decimal == catalog::Decimal::kPoint && status == std::errc() &&
                       end == cell.data() + cell.size();
    std::string unit;
    if (!plain) {
      const catalog::CellNumber number = catalog::FrontOf(cell);
      const auto digits = catalog::WithPoint(number.digits, column.decimal);
      if (number.digits.empty() || !digits || number.tail.starts_with("/")) return std::nullopt;
      std::string text = *digits + number.tail;
      std::erase(text, '+');
      const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), x);
      if (error != std::errc() || last != text.data() + text.size()) return std::nullopt;
      if (number.negative) x = -x;
      unit = number.rest;
    }
    const double value = unit.empty() ? recording_.scales[i](x) : InUnitOfCell(i, unit, x);
    if (!std::isfinite(value)) return std::nullopt;
    return value;
  }

  // "1.2 bar": the cell's unit instead of the heading's; NaN: it is none.
  double InUnitOfCell(std::size_t i, const std::string& unit, double x) {
    const ScaleOrError scale = ScaleOf(fields_[i], unit, recording_.ambient_kpa_abs);
    return scale.error.empty() ? scale.scale(x) : kNaN;
  }

  double ReadingOf(std::size_t i, std::string_view cell) {
    if (IsMissing(cell)) return kNaN;
    const auto number = NumberOf(i, cell);
    if (!number) FailCell(i, "must be a number or empty, not " + Quoted(cell));
    return number.value_or(kNaN);
  }

  ValveCell ValveOf(std::size_t i, std::string_view cell) {
    ValveCell valve;
    if (cell.empty()) {
      FailCell(i, "must not be empty: it says what the valve does");
      return valve;
    }
    if (const auto number = NumberOf(i, cell)) {
      valve.number = *number;
      return valve;
    }
    const auto [found, is_new] =
        words_.try_emplace(std::string(cell), static_cast<int>(recording_.valve_words.size()));
    if (is_new && recording_.valve_words.size() >= kValveWordsMax)
      Stop("the valve has more than " + std::to_string(kValveWordsMax) + " different states");
    if (is_new) recording_.valve_words.emplace_back(cell);
    valve.word = found->second;
    return valve;
  }

  Recording& recording_;
  catalog::TableReading& table_;
  std::vector<std::string> fields_;
  std::size_t needed_ = 0;  // cells that a row must have
  int line_ = 0;
  bool stopped_ = false;
  std::map<std::string, std::size_t> index_;
  std::map<std::string, int> words_;
};

// Times of a clock in seconds since 1970, or ticks of an instrument since its start.
void BeginAtZero(RecordedRun& run, std::vector<std::string>& notes) {
  constexpr double kFarS = 1e6;  // what a measurement takes
  if (run.t_s.empty() || std::abs(run.t_s.front()) < kFarS) return;
  const double first = run.t_s.front();
  for (double& t_s : run.t_s) t_s = std::round((t_s - first) * 1e9) / 1e9;
  notes.push_back("times of run " + Quoted(run.id) +
                  " are far from zero: they are counted from its first reading");
}

}  // namespace

void ReadRecordingRows(Recording& recording) {
  catalog::TableReading& table = recording.table;
  RowReader reader(recording);
  const int last_heading = std::max(table.header_row, table.units_row);
  catalog::ForEachRow(
      table.text,
      [&](CsvRow cells, int row) {
        if (row > last_heading) reader.Read(std::move(cells), row);
      },
      [&](const catalog::CsvError& error) {
        if (error.row > last_heading) reader.Fail(error.row, error.column, error.detail);
      },
      catalog::DelimiterOf(TableDelimiter(table)));
  if (recording.runs.empty() && table.errors.empty())
    table.errors.push_back({last_heading + 1, "", "must hold a reading"});
  for (RecordedRun& run : recording.runs) BeginAtZero(run, recording.notes);
}

}  // namespace plenum::api
