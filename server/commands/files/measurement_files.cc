#include "server/commands/files/measurement_files.h"

#include "api/measure/diagnose_request.h"
#include "api/measure/measurement.h"
#include "server/commands/files/input.h"

namespace plenum::server {
namespace {

api::Json DocumentOf(const std::string& text) { return ValueOrRefuse(api::ParseJson(text)); }

}  // namespace

api::Json ReadMeasurement(const std::vector<std::string>& files, const std::string& rig,
                          api::Provenance& provenance) {
  std::vector<api::Json> documents;
  documents.reserve(files.size());
  for (const std::string& file : files) {
    const std::string text = ReadText(file);
    provenance.files.push_back(api::FileOf(file, text));
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string::npos && (text[first] == '{' || text[first] == '[')) {
      documents.push_back(DocumentOf(text));
      continue;
    }
    if (rig.empty()) {
      if (!file.ends_with(".csv")) documents.push_back(DocumentOf(text));  // says what is wrong
      Refuse({{"--rig", "is required with CSV: the JSON file that describes the rig"}});
    }
    documents.push_back(ValueOrRefuse(api::MeasurementFromCsv(text, DocumentOf(ReadText(rig)))));
  }
  return ValueOrRefuse(api::MergeMeasurements(documents));
}

}  // namespace plenum::server
