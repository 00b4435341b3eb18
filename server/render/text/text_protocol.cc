#include "server/render/text/text_protocol.h"

#include <fmt/format.h>

#include <algorithm>

#include "api/protocol/protocol_document.h"
#include "server/render/text/text_diagnosis.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;
using Align = Table::Align;

// As large as the number itself is no uncertainty of it.
std::string TwoDigitPercent(const Json& share) {
  if (!share.is_number()) return "–";
  if (share.get<double>() >= api::kNothingTold) return "not told";
  return fmt::format("{:.2g} %", 100.0 * share.get<double>());
}

std::string At(const Json& row) {
  return row.contains("pressure_kpa_gauge")
             ? fmt::format(" at {} kPa", Short(row.at("pressure_kpa_gauge")))
             : "";
}

std::string EquipmentText(const Json& test) {
  const Json& equipment = test.at("equipment");
  if (equipment.is_null()) return "";
  std::string text = fmt::format("  bottle of {} L", Short(equipment.at("bottle_l")));
  if (!equipment.at("source_pressure_kpa_gauge").is_null())
    text +=
        fmt::format(", source at {} kPa gauge", Short(equipment.at("source_pressure_kpa_gauge")));
  return text + fmt::format(", {} readings a second for {} s, {} times; one check with {} L\n",
                            Short(equipment.at("sampling_hz")), Short(equipment.at("duration_s")),
                            equipment.at("repeats").dump(), Short(equipment.at("check_bottle_l")));
}

std::string PrecisionTable(const Json& rows) {
  if (rows.empty()) return "";
  Table table({{"number", Align::kLeft},
               {"uncertainty"},
               {"by the sensor"},
               {"by the rig"},
               {"how", Align::kLeft}},
              2);
  for (const Json& row : rows)
    table.Add({Spoken(row.at("field")).name + At(row), TwoDigitPercent(row.at("uncertainty")),
               TwoDigitPercent(row.at("from_noise")), TwoDigitPercent(row.at("from_rig")),
               row.at("how").get<std::string>() + (row.at("told") == true ? "" : "; not told")});
  return table.Text();
}

std::string TestText(const Json& test) {
  std::string title = test.at("protocol");
  std::replace(title.begin(), title.end(), '_', ' ');
  std::string text = title + "\n" + EquipmentText(test);
  int number = 0;
  for (const Json& step : test.at("steps"))
    text += fmt::format("  {}. {}\n", ++number, step.get<std::string>());
  text += PrecisionTable(test.at("precision"));
  for (const Json& warning : test.at("warnings"))
    text += "  note: " + warning.get<std::string>() + "\n";
  if (test.at("recording").is_object())
    text += "  columns: run, t_s, valve, pressure_kpa_gauge\n  then: " +
            test.at("recording").at("command").get<std::string>() + "\n";
  return text + "\n";
}

// What is known of one number after it was written.
std::string KeptText(const Json& number) {
  const std::string field = number.at("field");
  std::string text;
  if (number.at("written") == true && number.at("combined") == true)
    text += fmt::format("  {} combines with the measurement before: {}, {}\n", field,
                        Short(number.at("value")), TwoDigitPercent(number.at("uncertainty")));
  if (number.at("written") == true && number.at("spread").is_number())
    text += fmt::format(
        "  {} of {} pieces: {}, spread between them {}, the mean known to {}, a piece to {}\n",
        field, number.at("pieces").dump(), Short(number.at("value")),
        TwoDigitPercent(number.at("spread")), TwoDigitPercent(number.at("standard_error")),
        TwoDigitPercent(number.at("uncertainty")));
  if (number.at("warning").is_string())
    text += fmt::format("  {}: {}\n", field, number.at("warning").get<std::string>());
  return text;
}

std::string SavedText(const Json& answer) {
  const Json saved = answer.value("saved_part", Json());
  if (!saved.is_object()) return "";
  std::string text;
  const std::string part = saved.at("part");
  if (saved.at("revision").is_object()) {
    const Json& piece = saved.at("specimen");
    text = fmt::format("Written into {}{}, revision {} of the catalogue.\n", part,
                       piece.is_string() ? " as piece \"" + piece.get<std::string>() + "\"" : "",
                       saved.at("revision").at("number").dump());
    for (const Json& number : saved.at("numbers")) text += KeptText(number);
  }
  for (const Json& reason : saved.at("refused"))
    text += fmt::format("Not written into {}: {}.\n", part, reason.get<std::string>());
  return text + "\n";
}

// What other bottles say of the same numbers.
std::string BottlesText(const Json& answer) {
  std::string text;
  for (const Json& bottle : answer.value("bottles", Json::array())) {
    int agree = 0;
    for (const Json& number : bottle.at("numbers")) agree += number.at("agrees") == true ? 1 : 0;
    text += fmt::format("  bottle {} of {} ml: {} of {} numbers agree\n",
                        bottle.at("specimen").is_string() ? bottle.at("specimen").get<std::string>()
                                                          : std::string("without a name"),
                        Short(bottle.at("rest_volume_ml")), agree, bottle.at("numbers").size());
  }
  return text;
}

}  // namespace

std::string ProtocolText(const Json& protocol) {
  const std::string part = protocol.at("part");
  if (protocol.at("tests").empty())
    return fmt::format("No test is known for {}, a {}.\n", part,
                       protocol.at("family").get<std::string>());
  std::string text = fmt::format("How to measure {}\n\n", part);
  for (const Json& test : protocol.at("tests")) text += TestText(test);
  return text + "Uncertainties are relative, one standard deviation of all repeats together.\n";
}

std::string SavedPartText(const Json& answer) { return SavedText(answer); }

std::string MeasuredText(const Json& answer) {
  const Json measured = answer.value("measured", Json::array());
  if (measured.empty()) return SavedText(answer);
  Table table({{"measured", Align::kLeft},
               {"declared"},
               {"fitted"},
               {"95 % interval"},
               {"uncertainty"},
               {"unit", Align::kLeft},
               {"", Align::kLeft}},
              2);
  for (const Json& row : measured) {
    const std::string unit = row.at("unit");
    const auto [name, spoken] =
        Spoken(row.at("number").get<std::string>() + (unit == "1" ? "" : "_" + unit));
    const Json& interval = row.at("interval_95");
    table.Add({name + At(row) + " of " + row.at("part").get<std::string>(),
               Short(row.at("declared")), Short(row.at("fitted")),
               Short(interval[0]) + " to " + Short(interval[1]),
               TwoDigitPercent(row.at("uncertainty")), spoken,
               row.at("refused").is_string() ? row.at("refused").get<std::string>() : ""});
  }
  std::string text = table.Text() + BottlesText(answer);
  for (const Json& reason : answer.value("measured_refused", Json::array()))
    text += "  not for the catalogue: " + reason.get<std::string>() + "\n";
  return text + "\n" + SavedText(answer);
}

}  // namespace plenum::server
