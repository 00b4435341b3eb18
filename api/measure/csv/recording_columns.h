// The columns of a recording: which field each gives, in which unit.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_COLUMNS_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_COLUMNS_H_

#include <string_view>

#include "api/measure/csv/recording.h"
#include "catalog/tables/layout.h"

namespace plenum::api {

// The delimiter of table.text: columns with blanks between them have tabs there.
std::string_view TableDelimiter(const catalog::TableReading& table);

// Fills columns, units_row and scales of the recording, or asks (recording_layout.h). `below` is
// the record after the header, which may hold the units alone.
void MapRecordingColumns(const catalog::CsvRow& header, const catalog::Record& below,
                         const catalog::TableOptions& options, Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_COLUMNS_H_
