#include "server/render/text/text_response.h"

#include <algorithm>

#include "server/render/text/text_remarks.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;

constexpr std::size_t kRowsMax = 41;

// The column title of a field of the contract: the last part of the name is the unit.
std::string Title(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string PerformanceTable(const Json& performance) {
  Table table({{"group", Table::Align::kLeft}, {"rise s"}, {"fall s"}, {"frequency max Hz"}});
  for (const auto& group : performance.at("groups")) {
    table.Add({group.at("name").get<std::string>(), Short(group.at("rise_time_s")),
               Short(group.at("fall_time_s")), Short(group.at("frequency_hz_max"))});
  }
  return table.Text();
}

std::string PressureTable(const Json& response) {
  const auto& t_s = response.at("t_s");
  const auto& source = response.at("source_pressure_kpa_gauge");
  std::vector<Table::Column> columns = {{"t s"}};
  for (const auto& group : response.at("groups")) {
    const bool measured = group.contains("actuator_pressure_kpa_gauge");
    columns.push_back(
        {group.at("name").get<std::string>() + (measured ? " sensor" : "") + " kPa gauge"});
    if (measured) columns.push_back({"actuator kPa gauge"});
    columns.push_back({"mL"});
    if (group.contains("temperature_k")) columns.push_back({"K"});
  }
  columns.push_back({"source kPa gauge"});
  Table table(columns);
  const std::size_t stride = std::max<std::size_t>(1, (t_s.size() + kRowsMax - 2) / (kRowsMax - 1));
  for (std::size_t i = 0; i < t_s.size(); i += stride) {
    std::vector<std::string> cells = {Short(t_s[i])};
    for (const auto& group : response.at("groups")) {
      for (const char* field :
           {"pressure_kpa_gauge", "actuator_pressure_kpa_gauge", "volume_ml", "temperature_k"}) {
        if (group.contains(field)) cells.push_back(Short(group.at(field)[i]));
      }
    }
    cells.push_back(i < source.size() ? Short(source[i]) : "–");
    table.Add(std::move(cells));
  }
  std::string text = table.Text();
  if (stride > 1) {
    text += "every " + std::to_string(stride) + "th of " + std::to_string(t_s.size()) +
            " samples; --json gives all\n";
  }
  return text;
}

}  // namespace

std::string CurvesText(const Json& answer) {
  Table table({{"run", Table::Align::kLeft},
               {"readings"},
               {"RMS kPa"},
               {"stated kPa"},
               {"peak kPa"},
               {"", Table::Align::kLeft}});
  for (const Json& run : answer.at("runs")) {
    const bool done = run.at("status") == "done";
    table.Add({run.at("id").get<std::string>(), done ? std::to_string(run.at("t_s").size()) : "–",
               done ? Short(run.at("rms_kpa")) : "–", Short(run.at("stated_rms_kpa")),
               done ? Short(run.at("peak_kpa")) : "–",
               !done                        ? run.at("detail").get<std::string>()
               : run.at("held_out") == true ? "held out"
                                            : ""});
  }
  return "Curves of the model \"" + answer.at("model").get<std::string>() + "\":\n" + table.Text() +
         "--json gives the curves\n";
}

std::string ResponseText(const Json& response) {
  std::string text = PerformanceTable(response.at("performance")) + "\n" + PressureTable(response);
  if (response.contains("detail") && response.at("detail").is_string()) {
    text += response.at("detail").get<std::string>() + "\n";
  }
  return text + RemarksText(response);
}

std::string MapText(const Json& answer) {
  const auto& rows = answer.at("rows");
  if (rows.empty()) return "no grid points\n";
  std::vector<Table::Column> columns;
  for (const auto& [name, value] : rows.front().items()) columns.push_back({Title(name)});
  Table table(columns);
  for (const auto& row : rows) {
    std::vector<std::string> cells;
    for (const auto& [name, value] : row.items()) cells.push_back(Short(value));
    table.Add(std::move(cells));
  }
  return table.Text() + RemarksText(answer);
}

}  // namespace plenum::server
