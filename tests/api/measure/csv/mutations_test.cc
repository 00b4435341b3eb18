// Recordings changed at random: each is read, asked about or refused, and none ends the process.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/measurement.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace mutations_test {

std::vector<std::string> Seeds() {
  std::vector<std::string> seeds;
  const auto folder = test::SourceDir() / "tests/fuzz/corpus/recording";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(file.path(), std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

std::string Changed(std::string text, const std::vector<std::string>& seeds, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  static const std::vector<std::string> kPieces = {
      ",",     ";",         "\t",         "\n",
      "\"",    " ",         "0",          "-1",
      "1e308", "1e-400",    "NaN",        "∞",
      "[",     "]",         "(V)",        "=",
      "abs",   "12:00:00",  "23:59:60.5", "31.02.2026",
      "1,234", "1.234.567", "open",       "0",
      "1",     "2",         "hold",       "run",
      "t_s",   "p [bar]",   "\xFF",       std::string(1, '\0')};
  for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
    const std::size_t at = below(text.size() + 1);
    switch (below(4)) {
      case 0:
        text.erase(at, below(40));
        break;
      case 1:
        text.insert(at, kPieces[below(kPieces.size())]);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      default: {
        const std::string& other = seeds[below(seeds.size())];
        const std::size_t from = below(other.size());
        text.insert(at, other.substr(from, below(60)));
      }
    }
  }
  return text;
}

TEST(RecordingMutations, AreReadAskedAboutOrRefused) {
  const auto seeds = Seeds();
  ASSERT_GE(seeds.size(), 6U);
  const Json rig = Json::parse(R"({
    "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100 },
    "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
    "supply": { "kind": "regulated", "source_pressure_kpa_gauge": 200 } })");
  std::mt19937 random(34);
  int read = 0, complete = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = Changed(seeds[random() % seeds.size()], seeds, random);
    const CsvReading reading = ReadMeasurementCsv(text, rig);
    const bool refused = !reading.errors.empty() || !reading.questions.empty();
    EXPECT_TRUE(refused || !reading.document.is_null()) << text;
    for (const auto& error : reading.errors) EXPECT_FALSE(error.detail.empty());
    reading.understood.dump(-1, ' ', false, Json::error_handler_t::strict);
    if (reading.document.is_null()) continue;
    ++read;
    complete += std::holds_alternative<calibration::Dataset>(ParseMeasurement(reading.document));
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(complete, 20);
}

}  // namespace mutations_test
}  // namespace plenum::api
