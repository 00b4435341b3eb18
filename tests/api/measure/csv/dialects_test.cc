// One recording, written as many instruments and programs write it: the same measurement.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/measurement.h"

namespace plenum::api {
namespace dialects_test {

// The recording: times in ms and pressures in Pa gauge, whole numbers, so that each dialect below
// is written from them without the code under test. It inflates, holds and deflates.
struct Row {
  int ms, pa;
  char valve;  // inflate, hold, deflate
};
const std::vector<Row>& Rows() {
  static const std::vector<Row> kRows = {{0, 0, 'h'},        {100, 250, 'i'},    {200, 31250, 'i'},
                                         {300, 62000, 'i'},  {400, 81500, 'i'},  {500, 95125, 'i'},
                                         {600, 100000, 'i'}, {700, 100250, 'h'}, {800, 100125, 'h'},
                                         {900, 100000, 'h'}, {1000, 99875, 'd'}, {1100, 42000, 'd'},
                                         {1200, 9500, 'd'},  {1300, 500, 'd'}};
  return kRows;
}

// Whole thousandths with `digits` decimals of them.
std::string Thousandths(long long number, char mark) {
  const long long size = number < 0 ? -number : number;
  std::string decimals = std::to_string(size % 1000);
  decimals.insert(0, 3 - decimals.size(), '0');
  return (number < 0 ? "-" : "") + std::to_string(size / 1000) + mark + decimals;
}

std::string Text(double number, int decimals, char mark) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  std::string cell(text);
  for (char& c : cell)
    if (c == '.') c = mark;
  return cell;
}

const Json& Rig() {
  static const Json kRig = Json::parse(R"({ "rig": {
    "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100 },
    "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
    "supply": { "kind": "regulated", "source_pressure_kpa_gauge": 200 },
    "ambient": { "pressure_kpa_abs": 98, "temperature_k": 293.15 } } })");
  return kRig;
}

using Cells = std::function<std::string(const Row&)>;
std::string Table(const std::string& head, const Cells& cells, const std::string& end = "\n") {
  std::string text = head;
  for (const Row& row : Rows()) text += cells(row) + end;
  return text;
}

std::string Told(const CsvReading& reading) {
  std::string told;
  for (const auto& error : reading.errors) told += error.pointer + ": " + error.detail + "\n";
  for (const auto& question : reading.questions) told += "? " + question.text + "\n";
  return told;
}

// The measurement is that of Rows(), with pressures to `tolerance_kpa`.
void ExpectRecording(const std::string& csv, const Json& rig = Rig(), double tolerance_kpa = 1e-9,
                     const catalog::TableOptions& options = {}) {
  const CsvReading reading = ReadMeasurementCsv(csv, rig, options);
  ASSERT_TRUE(reading.errors.empty() && reading.questions.empty()) << Told(reading) << csv;
  const Json& run = reading.document["runs"][0];
  ASSERT_EQ(run["t_s"].size(), Rows().size());
  for (std::size_t i = 0; i < Rows().size(); ++i) {
    EXPECT_NEAR(run["t_s"][i].get<double>(), Rows()[i].ms / 1000.0, 1e-9) << csv;
    EXPECT_NEAR(run["pressure_kpa_gauge"][i].get<double>(), Rows()[i].pa / 1000.0, tolerance_kpa);
  }
  const Json valve = Json::parse(R"([ { "t_s": 0.0, "state": "hold" },
    { "t_s": 0.1, "state": "inflate" }, { "t_s": 0.7, "state": "hold" },
    { "t_s": 1.0, "state": "deflate" } ])");
  ASSERT_EQ(run["valve"].size(), valve.size());
  for (std::size_t i = 0; i < valve.size(); ++i) {
    EXPECT_EQ(run["valve"][i]["state"], valve[i]["state"]);
    EXPECT_NEAR(run["valve"][i]["t_s"].get<double>(), valve[i]["t_s"].get<double>(), 1e-9);
  }
  const auto dataset = ParseMeasurement(reading.document);
  if (const auto* errors = std::get_if<Errors>(&dataset))
    ADD_FAILURE() << errors->front().pointer << ": " << errors->front().detail;
}

std::string Word(const Row& row) {
  return row.valve == 'i' ? "inflate" : row.valve == 'd' ? "deflate" : "hold";
}
std::string Seconds(const Row& row, char mark = '.') { return Thousandths(row.ms, mark); }
std::string Kpa(const Row& row, char mark = '.') { return Thousandths(row.pa, mark); }

TEST(RecordingDialects, TheDocumentedColumns) {
  ExpectRecording(Table("run,t_s,valve,pressure_kpa_gauge\n", [](const Row& row) {
    return "r1," + Seconds(row) + "," + Word(row) + "," + Kpa(row);
  }));
}

// A row tells what the valve is told then, not since when; nor is there a row before the first.
TEST(RecordingDialects, InstantsAreKnownToTheRowBefore) {
  const std::string csv =
      "t_s,valve,pressure_kpa_gauge\n0,hold,0\n0.03,inflate,1\n0.05,inflate,9\n0.06,hold,10\n";
  const CsvReading reading = ReadMeasurementCsv(csv, Rig());
  const Json& valve = reading.document["runs"][0]["valve"];
  ASSERT_EQ(valve.size(), 3u);
  EXPECT_FALSE(valve[0].contains("uncertainty_s"));
  EXPECT_NEAR(valve[1]["uncertainty_s"].get<double>(), 0.0173205, 1e-6);
  EXPECT_NEAR(valve[2]["uncertainty_s"].get<double>(), 0.0057735, 1e-6);
}

TEST(RecordingDialects, DecimalCommaAndSemicolon) {
  ExpectRecording(Table(
      "Zeit [s];Druck [kPa];Ventil\r\n",
      [](const Row& row) { return Seconds(row, ',') + ";" + Kpa(row, ',') + ";" + Word(row); },
      "\r\n"));
}

TEST(RecordingDialects, MillisecondsAndBar) {
  ExpectRecording(Table("Time (ms);p [bar];valve\n", [](const Row& row) {
    return std::to_string(row.ms) + ";" + Text(row.pa / 1e5, 5, '.') + ";" + Word(row);
  }));
}

TEST(RecordingDialects, MicrosecondsAndPascalWithTabs) {
  ExpectRecording(Table("micros\tP1 (Pa)\tValve state\n", [](const Row& row) {
    return std::to_string(row.ms) + "000\t" + std::to_string(row.pa) + "\t" + Word(row);
  }));
}

TEST(RecordingDialects, MinutesAndMmHgWithPipes) {
  // 1 mmHg is 133.322387415 Pa (NIST SP 811).
  ExpectRecording(Table("t in min|Pressure in mmHg|valve\n",
                        [](const Row& row) {
                          return Text(row.ms / 60000.0, 12, '.') + "|" +
                                 Text(row.pa / 133.322387415, 12, '.') + "|" + Word(row);
                        }),
                  Rig(), 1e-9);
}

TEST(RecordingDialects, PsiGaugeWithExponents) {
  // 1 psi is 6894.757293168361 Pa.
  ExpectRecording(Table("time_s,p_psig,valve\n", [](const Row& row) {
    char cell[40];
    std::snprintf(cell, sizeof cell, "%.13E", row.pa / 6894.757293168361);
    return Seconds(row) + "," + cell + "," + Word(row);
  }));
}

TEST(RecordingDialects, AbsoluteWithTheAmbientOfTheRig) {
  for (const char* heading : {"p_abs [kPa]", "Pressure (kPa abs)", "Absolutdruck absolut [kPa]",
                              "pressure_kpa_abs", "p [kPa(a)]"}) {
    const auto csv = Table("t [s],valve," + std::string(heading) + "\n", [](const Row& row) {
      return Seconds(row) + "," + Word(row) + "," + Thousandths(row.pa + 98000, '.');
    });
    if (std::string(heading).starts_with("Absolutdruck"))
      ExpectRecording(csv, Rig(), 1e-9, [] {
        catalog::TableOptions options;
        options.columns["#3"] = "pressure_kpa_gauge [kPa abs]";
        return options;
      }());
    else
      ExpectRecording(csv);
  }
}

TEST(RecordingDialects, UnitsInARowOfTheirOwnAsPicoScope) {
  ExpectRecording(Table("Time,Channel A,Ventil\n(ms),(mbar),\n\n", [](const Row& row) {
    return Text(row.ms, 8, '.') + "," + Text(row.pa / 100.0, 8, '.') + "," + Word(row);
  }));
}

TEST(RecordingDialects, PreambleOfAnInstrument) {
  const std::string preamble =
      "LabVIEW Measurement\t\t\nWriter_Version\t2\nOperator\tA. \"Bo\" C.\nDate\t2026/01/31\n"
      "Time\t12:03:04,25\n***End_of_Header***\t\n\n";
  ExpectRecording(preamble + Table("X_Value\tPressure [kPa]\tValve\tComment\n",
                                   [](const Row& row) {
                                     return Seconds(row) + "\t" + Kpa(row) + "\t" + Word(row) +
                                            "\t";
                                   }),
                  Rig(), 1e-9, [] {
                    catalog::TableOptions options;
                    options.columns["X_Value"] = "t_s [s]";
                    return options;
                  }());
}

TEST(RecordingDialects, CommentsOfPrograms) {
  ExpectRecording("# made by hand\n# t_s, pressure_kpa_gauge, valve\n" +
                  Table("", [](const Row& row) {
                    return (row.ms == 500 ? "# a break\n" : "") + Seconds(row) + ", " + Kpa(row) +
                           ", " + Word(row);
                  }));
}

TEST(RecordingDialects, BlanksBetweenColumns) {
  ExpectRecording(Table("   Time (s)   Pressure (kPa)   Valve\n", [](const Row& row) {
    return "   " + Seconds(row) + "  " + Kpa(row) + " " + Word(row);
  }));
  ExpectRecording(Table("t_s pressure_kpa_gauge valve\n", [](const Row& row) {
    return Seconds(row) + "    " + Kpa(row) + " " + Word(row);
  }));
}

TEST(RecordingDialects, QuotedCellsWithDecimalCommas) {
  ExpectRecording(Table("\"t [s]\",\"p [kPa]\",\"valve\"\n", [](const Row& row) {
    return "\"" + Seconds(row, ',') + "\",\"" + Kpa(row, ',') + "\",\"" + Word(row) + "\"";
  }));
}

TEST(RecordingDialects, EncodingsOfOfficePrograms) {
  const std::string csv = Table("Zeit (s);Überdruck p (kPa);Ventil µ\n", [](const Row& row) {
    return Seconds(row, ',') + ";" + Kpa(row, ',') + ";" + Word(row);
  });
  ExpectRecording("\xEF\xBB\xBF" + csv);
  std::string latin, wide = "\xFF\xFE";
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const auto byte = static_cast<unsigned char>(csv[i]);
    const unsigned code =
        byte < 0x80 ? byte : ((byte & 0x1Fu) << 6) | (static_cast<unsigned char>(csv[++i]) & 0x3Fu);
    latin += static_cast<char>(code);
    wide += static_cast<char>(code & 0xFF);
    wide += static_cast<char>(code >> 8);
  }
  ExpectRecording(latin);
  ExpectRecording(wide);
}

TEST(RecordingDialects, ClockTimesOverMidnight) {
  const auto clock = [](const Row& row, const char* form) {
    const long long of_day = (24 * 3600 - 1) * 1000LL + 500 + row.ms;  // begins at 23:59:59.500
    const long long ms = of_day % 86400000;
    char text[80];
    std::snprintf(text, sizeof text, form, of_day >= 86400000 ? 2 : 1, ms / 3600000,
                  ms / 60000 % 60, ms / 1000 % 60, ms % 1000);
    return std::string(text);
  };
  for (const char* form :
       {"2026-02-%02d %02lld:%02lld:%02lld.%03lld", "2026-02-%02dT%02lld:%02lld:%02lld.%03lldZ",
        "%02d.02.2026 %02lld:%02lld:%02lld,%03lld", "02/%02d/2026 %02lld:%02lld:%02lld.%03lld"})
    ExpectRecording(Table("Timestamp;p [kPa];valve\n", [&](const Row& row) {
      return clock(row, form) + ";" + Kpa(row) + ";" + Word(row);
    }));
  // Without a date.
  ExpectRecording(Table("Uhrzeit [hh:mm:ss.fff];p [kPa];valve\n", [&](const Row& row) {
    return clock(row, "%d 2026 %02lld:%02lld:%02lld.%03lld").substr(7) + ";" + Kpa(row) + ";" +
           Word(row);
  }));
}

TEST(RecordingDialects, DateBesideAClock) {
  ExpectRecording(Table("Datum;Zeit;p [kPa];valve\n", [](const Row& row) {
    return "31.01.2026;10:00:0" + Seconds(row, ',') + ";" + Kpa(row, ',') + ";" + Word(row);
  }));
}

TEST(RecordingDialects, TwoValveColumns) {
  for (const auto& levels : std::vector<std::pair<std::string, std::string>>{
           {"1", "0"}, {"TRUE", "FALSE"}, {"open", "closed"}, {"24.02", "0.01"}, {"auf", "zu"}})
    ExpectRecording(Table("t [s],p [kPa],fill valve,vent valve\n", [&](const Row& row) {
      return Seconds(row) + "," + Kpa(row) + "," +
             (row.valve == 'i' ? levels.first : levels.second) + "," +
             (row.valve == 'd' ? levels.first : levels.second);
    }));
}

TEST(RecordingDialects, NumbersForThreeStates) {
  ExpectRecording(Table("t [s],p [kPa],command\n", [](const Row& row) {
    return Seconds(row) + "," + Kpa(row) + "," +
           (row.valve == 'i'   ? "1"
            : row.valve == 'd' ? "-1"
                               : "0");
  }));
  catalog::TableOptions options;
  options.columns["command"] = "valve [0 = hold; 1 = inflate; 2 = deflate]";
  ExpectRecording(Table("t [s],p [kPa],command\n",
                        [](const Row& row) {
                          return Seconds(row) + "," + Kpa(row) + "," +
                                 (row.valve == 'i'   ? "1"
                                  : row.valve == 'd' ? "2"
                                                     : "0");
                        }),
                  Rig(), 1e-9, options);
}

TEST(RecordingDialects, VoltsWithTheScaleOfTheRig) {
  Json rig = Rig();
  rig["csv"] = Json::parse(
      R"({ "columns": { "Channel A [V]": "pressure_kpa_gauge [0.5 V = 0 bar; 4.5 V = 2 bar]"
}
})");
  // 0.5 V at 0 kPa and 4.5 V at 200 kPa: 0.02 V a kPa.
  ExpectRecording(Table("t [s],Channel A [V],valve\n",
                        [](const Row& row) {
                          return Seconds(row) + "," + Text(0.5 + row.pa * 0.02e-3, 9, '.') + "," +
                                 Word(row);
                        }),
                  rig, 1e-6);
}

TEST(RecordingDialects, WithoutHeadings) {
  catalog::TableOptions options;
  options.columns = {{"#1", "t_s [ms]"},
                     {"#2", "pressure_kpa_gauge [kPa gauge]"},
                     {"#3", "valve [1 = inflate; 0 = hold; 2 = deflate]"}};
  ExpectRecording(Table("",
                        [](const Row& row) {
                          return std::to_string(row.ms) + "," + Kpa(row) + "," +
                                 (row.valve == 'i'   ? "1"
                                  : row.valve == 'd' ? "2"
                                                     : "0");
                        }),
                  Rig(), 1e-9, options);
}

TEST(RecordingDialects, ColumnsOfNothingAndSeveralRuns) {
  const auto csv =
      Table("Trial;t [s];Humidity [%];p [kPa];valve;T [°C];Supply pressure [bar gauge]\n",
            [](const Row& row) {
              return "a;" + Seconds(row) + ";45;" + Kpa(row) + ";" + Word(row) + ";21.5;2.1";
            }) +
      Table("", [](const Row& row) {
        return "b;" + Seconds(row) + ";;" + Kpa(row) + ";" + Word(row) + ";;";
      });
  ExpectRecording(csv);
  const Json document = ReadMeasurementCsv(csv, Rig()).document;
  ASSERT_EQ(document["runs"].size(), 2U);
  EXPECT_NEAR(document["runs"][0]["channels"]["temperature_k"][3].get<double>(), 294.65, 1e-9);
  EXPECT_NEAR(document["runs"][0]["channels"]["source_pressure_kpa_gauge"][3].get<double>(), 210.0,
              1e-9);
  EXPECT_TRUE(document["runs"][1]["channels"]["temperature_k"][3].is_null());
  const Json& understood = document["understood"][0];
  EXPECT_TRUE(understood["columns"][2]["field"].is_null());
  EXPECT_EQ(understood["delimiter"], "semicolon");
  EXPECT_EQ(understood["columns"][3]["unit"], "kPa");
  EXPECT_EQ(understood["runs"][1]["readings"], Rows().size());
}

}  // namespace dialects_test
}  // namespace plenum::api
