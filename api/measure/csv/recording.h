// What is read of the table of a recording: columns, runs with their readings, what is open.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_H_

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "api/measure/csv/clock.h"
#include "api/measure/csv/headings/recording_units.h"
#include "api/measure/csv/headings/recording_words.h"
#include "catalog/tables/understanding.h"

namespace plenum::api {

// A delimiter beside those of catalog/tables/layout.h: any number of blanks.
inline constexpr std::string_view kBlanks = "blanks";

// A cell of a valve: a number, or one of the recording's valve words.
struct ValveCell {
  double number = std::numeric_limits<double>::quiet_NaN();
  int word = -1;
};

inline constexpr std::array kValveFields = {kValveField, kInflateValveField, kDeflateValveField};

struct RecordedRun {
  std::string id;
  std::string specimen;    // empty: none is named
  std::vector<int> lines;  // of the readings
  std::vector<double> t_s;
  std::array<std::vector<ValveCell>, kValveFields.size()> valves;  // as kValveFields
  std::map<std::string, std::vector<double>> readings;             // by field; NaN is missing
  std::vector<std::string> states;  // hold, inflate, deflate; empty without a valve column
  ClockSeconds clock;
  bool has_clock = false;
};

struct Recording {
  catalog::TableReading table;  // its questions and errors are those of the recording
  bool has_headings = true;
  double ambient_kpa_abs = 100.0;
  std::vector<ColumnScale> scales;       // of the columns
  std::vector<std::string> meanings;     // of the columns; empty: the field says it all
  std::vector<std::string> valve_words;  // the different ones
  std::vector<RecordedRun> runs;         // in order of appearance
  std::vector<std::string> notes;        // what was decided, in sentences
  bool is_open() const { return !table.questions.empty() || !table.errors.empty(); }

  // The column that gives a field; -1: none.
  int ColumnOf(std::string_view field) const {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (!table.columns[i].targets.empty() && table.columns[i].targets.front().column == field)
        return static_cast<int>(i);
    return -1;
  }
};

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_H_
