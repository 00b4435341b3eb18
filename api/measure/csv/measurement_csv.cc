#include "api/measure/csv/measurement_csv.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/json/reader.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/csv/gauge_check.h"
#include "api/measure/csv/recording_layout.h"
#include "api/measure/csv/recording_rows.h"
#include "api/measure/csv/table_options.h"
#include "api/measure/csv/understood.h"
#include "api/measure/csv/valve_cells.h"
#include "api/measure/valve/row_instants.h"

namespace plenum::api {
namespace {

using catalog::Question;

const Json* Member(const Json& object, const char* name) {
  return object.is_object() && object.contains(name) ? &object[name] : nullptr;
}

// The rig's document: a rig alone becomes one.
Json DocumentOf(const Json& rig) {
  const bool is_document = rig.contains("rig") || rig.contains("schema");
  return is_document ? rig : Json{{"rig", rig}};
}

double AmbientKpa(const Json& document) {
  const Json* rig = Member(document, "rig");
  if (rig == nullptr || !rig->is_object()) return 100.0;
  Errors told_later;
  Reader reader(*rig, "/rig", told_later);
  const model::Ambient ambient = ReadAmbient(reader);
  return ambient.pressure_pa / kPaPerKpa;
}

// Whether an assumption of the measurement says what the readings are counted from.
bool SettlesGauge(const Json& document) {
  const Json* assume = Member(document, "assume");
  if (assume == nullptr) return false;
  const auto settles = [](const Json& one) {
    return one.is_string() && (one.get_ref<const std::string&>() == "as_written" ||
                               one.get_ref<const std::string&>().find("abs") != std::string::npos);
  };
  return settles(*assume) ||
         (assume->is_array() && std::any_of(assume->begin(), assume->end(), settles));
}

const Json* RunOf(const Json& document, const std::string& id) {
  const Json* runs = Member(document, "runs");
  if (runs == nullptr || !runs->is_array()) return nullptr;
  for (const Json& run : *runs)
    if (run.is_object() && run.contains("id") && run["id"] == id) return &run;
  return nullptr;
}

// The id of the only run that the document describes.
void NameOnlyRun(const Json& document, Recording& recording) {
  const Json* runs = Member(document, "runs");
  if (recording.ColumnOf(kRunField) >= 0 || recording.runs.size() != 1 || runs == nullptr) return;
  if (!runs->is_array() || runs->size() != 1) return;
  const Json* id = Member(runs->front(), "id");
  if (id != nullptr && id->is_string()) recording.runs.front().id = id->get<std::string>();
}

Json ListOf(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return list;
}

// A row tells what the valve is told then, not since when: the instant lies between it and the row
// before, or, where the command is sent as the row is written, at the row.
Json ScheduleOf(const RecordedRun& run) {
  Json valve = Json::array();
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    if (i > 0 && run.states[i] == run.states[i - 1]) continue;
    valve.push_back({{"t_s", run.t_s[i]}, {"state", run.states[i]}});
    const double row_s = i > 0 ? run.t_s[i] - run.t_s[i - 1] : 0.0;
    if (row_s > 0.0) valve.back()["uncertainty_s"] = UncertaintyOfRow(row_s);
  }
  return valve;
}

bool HasSchedule(const Json& run) {
  for (const char* name : {"valve", "cycle"})
    if (const Json* given = Member(run, name); given != nullptr && !given->is_null()) return true;
  return false;
}

// Of a supply whose pressure nobody says, the median of what was measured there.
void AddSourcePressure(const Json& document, const RecordedRun& recorded, Json& run,
                       std::vector<std::string>& notes) {
  const auto found = recorded.readings.find(std::string(kSourcePressureField));
  if (found == recorded.readings.end() || run.contains(kSourcePressureField) ||
      run.contains("rig") || recorded.readings.contains(std::string(kSetpointField)))
    return;
  const Json* rig = Member(document, "rig");
  const Json* supply = rig == nullptr ? nullptr : Member(*rig, "supply");
  const Json* kind = supply == nullptr ? nullptr : Member(*supply, "kind");
  if (kind == nullptr || *kind != "regulated" || supply->contains(kSourcePressureField)) return;
  std::vector<double> kpa;
  std::copy_if(found->second.begin(), found->second.end(), std::back_inserter(kpa),
               [](double one) { return std::isfinite(one); });
  if (kpa.empty()) return;
  const auto middle = kpa.begin() + std::ssize(kpa) / 2;
  std::nth_element(kpa.begin(), middle, kpa.end());
  if (*middle < 0.0) return;
  run[std::string(kSourcePressureField)] = *middle;
  notes.push_back("the source pressure of run " + Quoted(recorded.id) +
                  " is the median of its readings, " + Decimal(Rounded(*middle)) + " kPa gauge");
}

Json RunDocument(const Json& document, const RecordedRun& recorded,
                 std::vector<std::string>& notes) {
  const Json* described = RunOf(document, recorded.id);
  Json run = described == nullptr ? Json::object() : *described;
  run["id"] = recorded.id;
  if (!recorded.specimen.empty()) run["specimen"] = recorded.specimen;
  if (!recorded.states.empty()) run["valve"] = ScheduleOf(recorded);
  run["t_s"] = ListOf(recorded.t_s);
  for (const auto& [field, values] : recorded.readings) {
    if (field == kPressureField)
      run[field] = ListOf(values);
    else
      run["channels"][field] = ListOf(values);
  }
  AddSourcePressure(document, recorded, run, notes);
  return run;
}

// When the pressure begins to rise and to fall, as far as the curve shows one fill and one vent.
Json LikelyValve(const RecordedRun& run) {
  const std::vector<double>& kpa = run.readings.at(std::string(kPressureField));
  double low = std::numeric_limits<double>::infinity(), high = -low, last = low;
  for (const double one : kpa)
    if (std::isfinite(one)) low = std::min(low, one), high = std::max(high, one), last = one;
  if (!(high > low) || !(last < low + 0.2 * (high - low))) return nullptr;
  std::size_t rise = 0, fall = 0;
  bool risen = false;
  for (std::size_t i = 0; i < kpa.size(); ++i) {
    if (!std::isfinite(kpa[i])) continue;
    risen = risen || kpa[i] > low + 0.05 * (high - low);
    if (!risen) rise = i;
    if (kpa[i] >= low + 0.9 * (high - low)) fall = i;
  }
  if (fall <= rise) return nullptr;
  Json valve = Json::array({Json{{"t_s", run.t_s[rise]}, {"state", "inflate"}},
                            Json{{"t_s", run.t_s[fall]}, {"state", "deflate"}}});
  return valve;
}

Question ValveQuestion(const RecordedRun& run) {
  Question question{"valve",
                    run.id,
                    "no column says what the valve of run " + Quoted(run.id) +
                        " does: when does it inflate, hold and deflate? Give its instants in the "
                        "rig's document, in \"runs\" of id " +
                        Quoted(run.id),
                    {}};
  if (const Json valve = LikelyValve(run); !valve.is_null())
    question.answers.push_back(valve.dump());
  return question;
}

void AddErrors(const catalog::TableReading& table, Errors& errors) {
  for (const catalog::CsvError& error : table.errors) {
    std::string pointer = error.row > 0 ? "line " + std::to_string(error.row) : "csv";
    if (!error.column.empty()) pointer += ", " + error.column;
    errors.push_back({std::move(pointer), error.detail});
  }
}

// Reads the table; questions and errors tell how far it came.
Recording ReadRecording(std::string_view bytes, const Json& document,
                        const catalog::TableOptions& options) {
  Recording recording;
  recording.ambient_kpa_abs = AmbientKpa(document);
  ReadRecordingLayout(bytes, options, recording);
  const bool has_fields =
      recording.ColumnOf(kTimeField) >= 0 && recording.ColumnOf(kPressureField) >= 0;
  if (!recording.table.errors.empty() || !has_fields) return recording;
  const bool asks = recording.is_open();
  ReadRecordingRows(recording);
  if (asks) {  // its numbers have no meaning yet
    recording.table.errors.clear();
    return recording;
  }
  if (!recording.table.errors.empty()) return recording;
  CheckGauge(SettlesGauge(document), recording);
  if (recording.table.questions.empty()) FindValveStates(recording);
  return recording;
}

}  // namespace

CsvReading ReadMeasurementCsv(std::string_view bytes, const Json& rig,
                              const catalog::TableOptions& given) {
  CsvReading reading;
  if (!rig.is_object()) {
    reading.errors.push_back({"", "the rig file must hold an object"});
    return reading;
  }
  Json document = DocumentOf(rig);
  catalog::TableOptions options = given;
  if (const Json* csv = Member(document, "csv")) {
    Reader reader(*csv, "/csv", reading.errors);
    ReadTableOptions(reader, options);
    if (!reading.errors.empty()) return reading;
  }
  document.erase("csv");
  Recording recording = ReadRecording(bytes, document, options);
  NameOnlyRun(document, recording);
  AddErrors(recording.table, reading.errors);
  reading.questions = recording.table.questions;
  if (reading.errors.empty() && reading.questions.empty()) {
    Json runs = Json::array();
    for (const RecordedRun& run : recording.runs) {
      runs.push_back(RunDocument(document, run, recording.notes));
      if (!HasSchedule(runs.back())) reading.questions.push_back(ValveQuestion(run));
    }
    document["schema"] = "measurement/1";
    document["runs"] = std::move(runs);
    reading.document = std::move(document);
  }
  reading.understood = UnderstoodOf(recording);
  if (!reading.document.is_null())
    reading.document["understood"] = Json::array({reading.understood});
  return reading;
}

Parsed<Json> MeasurementFromCsv(std::string_view bytes, const Json& rig,
                                const catalog::TableOptions& options) {
  CsvReading reading = ReadMeasurementCsv(bytes, rig, options);
  for (const Question& question : reading.questions) {
    std::string pointer = question.option;
    if (question.option == "column" && reading.understood["heading_line"].is_number())
      pointer = "line " + std::to_string(reading.understood["heading_line"].get<int>());
    if (!question.heading.empty()) pointer += ", " + question.heading;
    std::string detail = question.text;
    if (!question.answers.empty() && question.option == "column")
      detail += ". Answer it as --column " +
                Quoted(question.heading + "=" + question.answers.front()) +
                ", or by \"csv\": {\"columns\": {…}} of the rig";
    else if (!question.answers.empty() && question.option == "valve")
      detail += ", as \"valve\": " + question.answers.front() + ", which the curve suggests";
    else if (!question.answers.empty())
      detail += " Answer it as --" + question.option + " " + question.answers.front() +
                ", or in \"csv\" of the rig";
    reading.errors.push_back({std::move(pointer), std::move(detail)});
  }
  if (!reading.errors.empty()) return reading.errors;
  return std::move(reading.document);
}

Json RenderCsvQuestions(const std::vector<Question>& questions) {
  Json list = Json::array();
  for (const Question& question : questions)
    list.push_back({{"option", question.option},
                    {"heading", question.heading.empty() ? Json(nullptr) : Json(question.heading)},
                    {"question", question.text},
                    {"answers", question.answers}});
  return list;
}

}  // namespace plenum::api
