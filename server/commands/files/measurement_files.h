// Measurements of one rig from files, as one document. Throws BadInput.
#ifndef PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_
#define PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_

#include <string>
#include <vector>

#include "api/catalogue/table_reading.h"
#include "api/json/json.h"
#include "api/measure/diagnosis_document.h"
#include "server/commands/command.h"

namespace plenum::server {

// How CSV files are to be read.
struct CsvOptions {
  std::string rig;                   // the JSON file that describes what was measured; empty: none
  catalog::TableOptions table;       // of a person, what the files leave open
  std::vector<std::string> columns;  // "HEADING=FIELD [UNIT]"
};
// --rig and what answers the questions of a table.
std::vector<Option> CsvOptionTable(CsvOptions& options);

// JSON, or CSV of any dialect with its rig. `assume` of the command may say what pressures are
// counted from. Adds the files to the provenance.
api::Json ReadMeasurement(const std::vector<std::string>& files, const CsvOptions& options,
                          const std::vector<std::string>& assume, api::Provenance& provenance);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_
