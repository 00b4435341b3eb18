// Long CSV of measured runs as a measurement document.
#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <vector>

#include "api/json/words.h"
#include "api/measure/measurement.h"

namespace plenum::api {
namespace {

constexpr std::string_view kPressure = "pressure_kpa_gauge";
constexpr std::size_t kErrorsMax = 20;

const std::vector<std::string>& ChannelNames() {
  static const std::vector<std::string> kNames = {"source_pressure_kpa_gauge",
                                                  "inlet_pressure_kpa_gauge", "temperature_k",
                                                  "volume_ml", "flow_l_per_min_anr"};
  return kNames;
}

std::string_view Trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

class Table {
 public:
  Table(std::string_view csv, Errors& errors) : errors_(errors) {
    if (csv.starts_with("\xEF\xBB\xBF")) csv.remove_prefix(3);
    const std::vector<std::string_view> lines = Split(csv, '\n');
    ReadHeader(lines.front());
    if (!errors_.empty()) return;
    for (line_ = 2; line_ <= lines.size(); ++line_) {
      const std::string_view line = lines[line_ - 1];
      if (!Trimmed(line).empty()) ReadRow(Split(line, separator_));
      if (errors_.size() >= kErrorsMax) {
        errors_.push_back({"line " + std::to_string(line_), "too many errors; the rest is unread"});
        return;
      }
    }
    if (runs_.empty() && errors_.empty()) errors_.push_back({"line 2", "must hold a sample"});
  }

  // { id, valve, t_s, pressure_kpa_gauge, channels } of each run in order of appearance.
  std::vector<Json> Take() { return std::move(runs_); }

 private:
  void ReadHeader(std::string_view header) {
    separator_ = header.find(';') != std::string_view::npos ? ';' : ',';
    for (const std::string_view cell : Split(header, separator_)) {
      const std::string name(Trimmed(cell));
      std::vector<std::string> known = {"run", "t_s", "valve", std::string(kPressure)};
      known.insert(known.end(), ChannelNames().begin(), ChannelNames().end());
      if (std::find(known.begin(), known.end(), name) == known.end())
        errors_.push_back({"line 1", "unknown column " + Quoted(name) +
                                         "; nearest known: " + Nearest(name, known)});
      if (std::find(columns_.begin(), columns_.end(), name) != columns_.end())
        errors_.push_back({"line 1", "column " + Quoted(name) + " stands there twice"});
      columns_.push_back(name);
    }
    for (const char* name : {"run", "t_s", "valve", "pressure_kpa_gauge"})
      if (std::find(columns_.begin(), columns_.end(), name) == columns_.end())
        errors_.push_back({"line 1", "column " + Quoted(name) + " is required"});
  }

  void Fail(const std::string& column, const std::string& detail) {
    errors_.push_back({"line " + std::to_string(line_) + ", " + column, detail});
  }

  Json NumberIn(const std::string& column, std::string_view cell, bool gaps) {
    if (cell.empty() && gaps) return nullptr;
    double number = 0.0;
    const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (status == std::errc() && end == cell.data() + cell.size() && number - number == 0.0)
      return number;
    Fail(column,
         "must be a number" + std::string(gaps ? " or empty" : "") + ", not " + Quoted(cell));
    return nullptr;
  }

  void ReadRow(const std::vector<std::string_view>& cells) {
    if (cells.size() != columns_.size()) {
      Fail("row", "has " + std::to_string(cells.size()) + " cells, must have " +
                      std::to_string(columns_.size()));
      return;
    }
    std::map<std::string, std::string_view> row;
    for (std::size_t c = 0; c < cells.size(); ++c) row[columns_[c]] = Trimmed(cells[c]);
    if (row["run"].empty()) return Fail("run", "must name the run");
    const std::string valve(row["valve"]);
    if (valve != "hold" && valve != "inflate" && valve != "deflate")
      return Fail("valve", "must be hold, inflate or deflate, not " + Quoted(valve));
    const Json t_s = NumberIn("t_s", row["t_s"], false);
    Json& run = RunOf(std::string(row["run"]));
    if (run["valve"].empty() || run["valve"].back()["state"] != valve)
      run["valve"].push_back({{"t_s", t_s}, {"state", valve}});
    run["t_s"].push_back(t_s);
    run[std::string(kPressure)].push_back(
        NumberIn(std::string(kPressure), row[std::string(kPressure)], true));
    for (const std::string& name : ChannelNames())
      if (row.contains(name)) run["channels"][name].push_back(NumberIn(name, row[name], true));
  }

  Json& RunOf(const std::string& id) {
    const auto [found, is_new] = index_.try_emplace(id, runs_.size());
    if (is_new)
      runs_.push_back({{"id", id},
                       {"valve", Json::array()},
                       {"t_s", Json::array()},
                       {kPressure, Json::array()}});
    return runs_[found->second];
  }

  Errors& errors_;
  char separator_ = ',';
  std::size_t line_ = 1;
  std::vector<std::string> columns_;
  std::vector<Json> runs_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace

Parsed<Json> MeasurementFromCsv(std::string_view csv, const Json& rig) {
  Errors errors;
  std::vector<Json> runs = Table(csv, errors).Take();
  if (!rig.is_object()) errors.push_back({"", "the rig file must hold an object"});
  if (!errors.empty()) return errors;
  const bool is_document = rig.contains("rig") || rig.contains("schema");
  Json document = is_document ? rig : Json{{"rig", rig}};
  document["schema"] = "measurement/1";
  std::map<std::string, Json> described;
  if (is_document && rig.contains("runs"))
    for (const Json& run : rig["runs"])
      if (run.is_object() && run.contains("id") && run["id"].is_string())
        described[run["id"].get<std::string>()] = run;
  document["runs"] = Json::array();
  for (Json& samples : runs) {
    Json run = described[samples["id"].get<std::string>()];
    if (run.is_null()) run = Json::object();
    for (auto& [name, value] : samples.items()) run[name] = std::move(value);
    document["runs"].push_back(std::move(run));
  }
  return document;
}

}  // namespace plenum::api
