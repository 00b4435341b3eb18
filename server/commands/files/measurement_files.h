// Measurements of one rig from files, as one document. Throws BadInput.
#ifndef PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_
#define PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "api/measure/diagnosis_document.h"

namespace plenum::server {

// JSON, or CSV with the JSON file `rig` (empty: none) that describes what was measured. Adds the
// files to the provenance.
api::Json ReadMeasurement(const std::vector<std::string>& files, const std::string& rig,
                          api::Provenance& provenance);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_FILES_MEASUREMENT_FILES_H_
