#include "api/measure/csv/recording_request.h"

#include <optional>
#include <string>
#include <utility>

#include "api/json/reader.h"
#include "api/json/words.h"
#include "api/measure/csv/measurement_csv.h"
#include "api/measure/csv/recording_layout.h"
#include "api/measure/csv/table_options.h"
#include "catalog/tables/encoding.h"

namespace plenum::api {
namespace {

// Of RFC 4648; none where other characters stand in it.
std::optional<std::string> OfBase64(std::string_view text) {
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::size_t value = kAlphabet.find(c);
    if (value == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xFFFFFu;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xFFu);
  }
  return bytes;
}

std::string BytesOf(Reader& reader) {
  if (reader.Has("csv") == reader.Has("csv_base64")) {
    reader.Fail("csv", "or csv_base64 is required, and not both");
    return "";
  }
  const char* name = reader.Has("csv") ? "csv" : "csv_base64";
  const Json& text = *reader.Raw(name);
  if (!text.is_string()) {
    reader.Fail(name, "must be a text, not " + KindOf(text));
    return "";
  }
  if (std::string_view(name) == "csv") return text.get<std::string>();
  auto bytes = OfBase64(text.get_ref<const std::string&>());
  if (!bytes) reader.Fail(name, "must be bytes in base64 (RFC 4648)");
  return std::move(bytes).value_or("");
}

Json Object(Json properties, Json required) {
  return {
      {"type", "object"}, {"properties", std::move(properties)}, {"required", std::move(required)}};
}

}  // namespace

Parsed<Json> ReadRecordingRequest(const Json& request) {
  Errors errors;
  Reader reader(request, "", errors);
  reader.Schema("recording/1");
  const std::string bytes = BytesOf(reader);
  static const Json kNoRig = Json::object();
  const Json* rig = reader.Has("rig") ? reader.Raw("rig") : &kNoRig;
  if (!rig->is_object()) reader.Fail("rig", "must be an object, not " + KindOf(*rig));
  catalog::TableOptions options;
  if (auto table = reader.OptionalObject("table")) ReadTableOptions(*table, options);
  reader.Finish();
  if (!errors.empty()) return errors;
  CsvReading reading = ReadMeasurementCsv(bytes, *rig, options);
  for (const Error& error : reading.errors)
    errors.push_back(error.pointer.starts_with("/")
                         ? Error{"/rig" + error.pointer, error.detail}
                         : Error{"/csv", error.pointer + ": " + error.detail});
  if (!errors.empty()) return errors;
  return Json{{"schema", "recording_answer/1"},
              {"measurement", std::move(reading.document)},
              {"understood", std::move(reading.understood)},
              {"questions", RenderCsvQuestions(reading.questions)}};
}

Json DescribeRecording() {
  const Json text = {{"type", "string"}};
  Json table = {{"type", "object"},
                {"properties",
                 {{"encoding", {{"enum", catalog::EncodingNames()}}},
                  {"delimiter", {{"enum", RecordingDelimiters()}}},
                  {"decimal", {{"enum", {"point", "comma"}}}},
                  {"header_row", {{"type", "integer"}, {"minimum", 0}, {"maximum", 1'000'000}}},
                  {"columns", {{"type", "object"}, {"additionalProperties", text}}}}},
                {"additionalProperties", false}};
  Json schema = Object({{"schema", {{"const", "recording/1"}}},
                        {"csv", text},
                        {"csv_base64", {{"type", "string"}, {"contentEncoding", "base64"}}},
                        {"rig", {{"type", "object"}}},
                        {"table", std::move(table)}},
                       Json::array({"schema"}));
  schema["additionalProperties"] = false;
  return schema;
}

Json ExampleRecording() {
  return {{"schema", "recording/1"},
          {"csv",
           "Time (ms);p [bar];valve\n0;0;hold\n100;0,25;inflate\n200;0,61;inflate\n"
           "300;0,6;hold\n"}};
}

Json DescribeRecordingAnswer() {
  const Json maybe_text = {{"type", {"string", "null"}}}, text = {{"type", "string"}};
  const Json question = Object({{"option", text},
                                {"heading", maybe_text},
                                {"question", text},
                                {"answers", {{"type", "array"}, {"items", text}}}},
                               Json::array({"option", "heading", "question", "answers"}));
  return Object({{"schema", {{"const", "recording_answer/1"}}},
                 {"measurement", {{"type", {"object", "null"}}}},
                 {"understood", {{"type", "object"}}},
                 {"questions", {{"type", "array"}, {"items", question}}}},
                Json::array({"schema", "measurement", "understood", "questions"}));
}

}  // namespace plenum::api
