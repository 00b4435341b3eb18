#include "server/commands/files/measurement_files.h"

#include <iterator>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/csv/recording_layout.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/measurement.h"
#include "server/commands/files/input.h"

namespace plenum::server {
namespace {

api::Json DocumentOf(const std::string& text) { return ValueOrRefuse(api::ParseJson(text)); }

bool IsJson(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (text[first] == '{' || text[first] == '[');
}

// The rig's document with what the command assumes of the readings.
api::Json RigOf(const CsvOptions& options, const std::vector<std::string>& assume) {
  api::Json rig = DocumentOf(ReadText(options.rig));
  if (assume.empty() || !rig.is_object()) return rig;
  if (!rig.contains("rig") && !rig.contains("schema")) rig = api::Json{{"rig", std::move(rig)}};
  rig["assume"] = assume;
  return rig;
}

catalog::TableOptions TableOptionsOf(const CsvOptions& options) {
  catalog::TableOptions table = options.table;
  api::Errors errors;
  for (const std::string& text : options.columns) {
    // The unit of a field may hold one, too: "v=valve [1 = inflate; 0 = hold]".
    const std::size_t first = text.find('=');
    const std::size_t at = text.rfind('=', text.find('[', first == std::string::npos ? 0 : first));
    if (at == std::string::npos || at == 0)
      errors.push_back({"--column",
                        "must be HEADING=FIELD, \"HEADING=FIELD [UNIT]\", or HEADING= to "
                        "leave the column out; is \"" +
                            text + "\""});
    else
      table.columns[text.substr(0, at)] = text.substr(at + 1);
  }
  if (!errors.empty()) Refuse(errors);
  return table;
}

}  // namespace

std::vector<Option> CsvOptionTable(CsvOptions& options) {
  catalog::TableOptions& table = options.table;
  return {
      {"--rig", "The rig of CSV files, as JSON", &options.rig, {.value_name = "FILE"}},
      {"--encoding",
       "Of CSV: utf-8, utf-16le, utf-16be or windows-1252; found without",
       &table.encoding,
       {.value_name = "NAME", .allowed = OneOf(catalog::EncodingNames())}},
      {"--delimiter",
       "Of CSV: comma, semicolon, tab, pipe or blanks; found without",
       &table.delimiter,
       {.value_name = "NAME", .allowed = OneOf(api::RecordingDelimiters())}},
      {"--decimal",
       "Of CSV, what stands before decimals: point or comma; found without",
       &table.decimal,
       {.value_name = "MARK", .allowed = OneOf{"point", "comma"}}},
      {"--header-row",
       "Of CSV, the line with the headings; found without",
       &table.header_row,
       {.value_name = "N", .allowed = Within{1, 1'000'000}}},
      {"--column",
       "Of CSV: HEADING=FIELD or \"HEADING=FIELD [UNIT]\", as \"p=pressure_kpa_gauge [bar abs]\"; "
       "HEADING= leaves it out; may be repeated",
       &options.columns,
       {.value_name = "MEANING"}}};
}

api::Json ReadMeasurement(const std::vector<std::string>& files, const CsvOptions& options,
                          const std::vector<std::string>& assume, api::Provenance& provenance) {
  std::vector<api::Json> documents;
  documents.reserve(files.size());
  for (const std::string& file : files) {
    const std::string text = ReadText(file);
    provenance.files.push_back(api::FileOf(file, text));
    if (IsJson(text)) {
      documents.push_back(DocumentOf(text));
      continue;
    }
    if (options.rig.empty()) {
      if (!file.ends_with(".csv")) documents.push_back(DocumentOf(text));  // says what is wrong
      Refuse({{"--rig", "is required with CSV: the JSON file that describes the rig"}});
    }
    auto document = ValueOrRefuse(
        api::MeasurementFromCsv(text, RigOf(options, assume), TableOptionsOf(options)));
    for (api::Json& understood : document["understood"]) understood["file"] = file;
    documents.push_back(std::move(document));
  }
  return ValueOrRefuse(api::MergeMeasurements(documents));
}

}  // namespace plenum::server
