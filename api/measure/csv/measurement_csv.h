// A recording as CSV of any dialect, as a measurement/1 document.
//
// One row a reading; columns for the time, the pressure, the run, the valve and the channels, by
// name, by other words and by unit. What the table leaves open is asked, never guessed. Answers
// stand in the options, or in the member "csv" of the rig's document (table_options.h).
#ifndef PLENUM_API_MEASURE_CSV_MEASUREMENT_CSV_H_
#define PLENUM_API_MEASURE_CSV_MEASUREMENT_CSV_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "catalog/tables/understanding.h"

namespace plenum::api {

struct CsvReading {
  Json document;    // measurement/1 with a list "understood"; null: there are errors, or questions
                    // without whose answer there is no measurement
  Json understood;  // understood.h; of the table as far as it was read
  std::vector<catalog::Question> questions;  // option "valve" asks for the valve of a run
  Errors errors;                             // pointers as "line 7, p [bar]"
};

// `rig` is a rig, or a measurement whose runs, by id, hold everything but samples. Beside what it
// says:
//   a table without a column of runs is one run, with the id of the only one that `rig` has;
//   a run without a valve column has the valve or cycle that `rig` gives it;
//   a run on a regulated supply of unsaid pressure has the median of its source's readings.
CsvReading ReadMeasurementCsv(std::string_view bytes, const Json& rig,
                              const catalog::TableOptions& options = {});

// The document alone; questions are errors that say how they are answered.
Parsed<Json> MeasurementFromCsv(std::string_view bytes, const Json& rig,
                                const catalog::TableOptions& options = {});

// [ { option, heading, question, answers } ].
Json RenderCsvQuestions(const std::vector<catalog::Question>& questions);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_MEASUREMENT_CSV_H_
