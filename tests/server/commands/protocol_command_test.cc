// `plenum protocol` and `plenum diagnose --save-part`, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "api/catalogue/stores.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace protocol_command_test {

using testing::HasSubstr;

constexpr const char* kPart = "generic-lp-small-200kpa";

api::Json OneDocument(const std::string& text) { return std::get<api::Json>(api::ParseJson(text)); }

TEST(ProtocolCommand, PrintsStepsPrecisionAndATemplate) {
  const Workbench bench;
  const std::string part = std::string("protocol ") + kPart;
  const auto text = bench.Run(part + " --template rig.json");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("Weigh the bottle"));
  EXPECT_THAT(text.out, HasSubstr("sonic conductance"));
  const api::Json rig = OneDocument(ReadAll(bench.Path("rig.json")));
  EXPECT_EQ(rig["schema"], "measurement/1");
  const api::Json json = OneDocument(bench.Run(part + " --json --bottle-l 2").out);
  EXPECT_EQ(json["schema"], "protocol/1");
  EXPECT_EQ(json["tests"][0]["equipment"]["bottle_l"], 2);
}

TEST(ProtocolCommand, RefusesByName) {
  const Workbench bench;
  const auto unknown = bench.Run("protocol generic-lp-small-200kp");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("nearest id: generic-lp-small-200kpa"));
  EXPECT_EQ(bench.Run(std::string("protocol ") + kPart + " --bottle-l 0").status, 2);
  EXPECT_EQ(bench.Run("protocol smc-tia01 --template rig.json").status, 2);  // tubing: no test
}

TEST(ProtocolCommand, ARecordingIsWrittenOnceIntoItsPart) {
  const Workbench bench;
  for (const char* name : {"bottle_test_rig.json", "bottle_test_simulated.csv"})
    bench.Write(name, ReadAll(test::SourceDir() / "examples" / name));
  const std::string diagnose =
      "diagnose bottle_test_simulated.csv --rig bottle_test_rig.json --save-part ";
  const auto saved = bench.Run(diagnose + kPart);
  EXPECT_EQ(saved.status, 0) << saved.err;
  EXPECT_THAT(saved.out, HasSubstr(std::string("Written into ") + kPart));
  const auto shown = bench.Run(std::string("catalog show ") + kPart + " --json");
  const api::Json part = OneDocument(shown.out);
  EXPECT_EQ(part["provenance"]["critical_ratio"]["kind"], "measured");
  EXPECT_EQ(part["documents"].size(), 1u);
  const auto again = bench.Run(diagnose + kPart + " --json");
  EXPECT_THAT(OneDocument(again.out)["saved_part"]["refused"].dump(), HasSubstr("saved before"));
  const auto other = bench.Run(diagnose + "smc-tia01");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("--save-part"));
}

// One bottle, declared as two of which one is 20 % wrong.
TEST(ProtocolCommand, BottlesThatDisagreeAreRefused) {
  const Workbench bench;
  const auto example = [](const char* name) {
    return ReadAll(test::SourceDir() / "examples" / name);
  };
  api::Json rig = OneDocument(example("bottle_test_rig.json"));
  for (api::Json& run : rig["runs"]) run["specimen"] = "first";
  rig["runs"][2]["specimen"] = "second";
  rig["runs"][2]["rig"] = {{"actuator", {{"rest_volume_ml", 800.0}}}};
  rig["time_limit_s"] = 600;  // the template's own
  bench.Write("two.json", rig.dump());
  bench.Write("recording.csv", example("bottle_test_simulated.csv"));
  const std::string diagnose = "diagnose recording.csv --rig two.json --json --save-part ";
  const api::Json answer = OneDocument(bench.Run(diagnose + kPart).out);
  EXPECT_TRUE(answer["saved_part"]["revision"].is_null());
  EXPECT_THAT(answer["saved_part"]["refused"].dump(), HasSubstr("first (1000 ml)"));
  EXPECT_THAT(answer["saved_part"]["refused"].dump(), HasSubstr("second (800 ml)"));
  EXPECT_EQ(answer["bottles"][0]["numbers"][0]["agrees"], false);
  rig["runs"][2]["rig"]["actuator"]["rest_volume_ml"] = 1000.0;
  bench.Write("two.json", rig.dump());
  const api::Json alike = OneDocument(bench.Run(diagnose + kPart + " --save-part-specimen A").out);
  EXPECT_TRUE(alike["saved_part"]["revision"].is_object()) << alike["saved_part"].dump();
  EXPECT_EQ(alike["saved_part"]["specimen"], "A");
  EXPECT_EQ(alike["bottles"][0]["numbers"][0]["agrees"], true);
  const std::string recording = ReadAll(bench.Path("recording.csv"));
  const auto kept = bench.Run(std::string("catalog document get ") + kPart + " " +
                              catalog::Sha256(recording) + " --out -");
  EXPECT_EQ(kept.out, recording);
}

// Times in ms under a heading that says s: told at once, with what settles it.
TEST(ProtocolCommand, ARecordingInMsIsNoticed) {
  const Workbench bench;
  const auto folder = test::SourceDir() / "examples";
  bench.Write("rig.json", ReadAll(folder / "bottle_test_rig.json"));
  std::istringstream lines(ReadAll(folder / "bottle_test_simulated.csv"));
  std::string ms, line;
  for (std::getline(lines, line), ms = line + "\n"; std::getline(lines, line);) {
    const std::size_t first = line.find(',') + 1, second = line.find(',', first);
    ms += line.substr(0, first) +
          std::to_string(1000.0 * std::stod(line.substr(first, second - first))) +
          line.substr(second) + "\n";
  }
  bench.Write("ms.csv", ms);
  const api::Json answer = OneDocument(bench.Run("diagnose ms.csv --rig rig.json --json").out);
  ASSERT_EQ(answer["slips"].size(), 1u) << answer["verdict"];
  EXPECT_EQ(answer["slips"][0]["assume"], "all_ms");
}

TEST(ProtocolCommand, AMassIsReadByHand) {
  const Workbench bench;
  const std::string measured = std::string("catalog measured ") + kPart;
  const auto saved =
      bench.Run(measured + " mass_kg=0.0613 --uncertainty 0.005 --how scale --anyway");
  EXPECT_EQ(saved.status, 0) << saved.err;
  EXPECT_THAT(saved.out, HasSubstr(std::string("Written into ") + kPart));
  const api::Json part =
      OneDocument(bench.Run(std::string("catalog show ") + kPart + " --json").out);
  EXPECT_EQ(part["mass_kg"], 0.0613);
  EXPECT_EQ(part["provenance"]["mass_kg"]["kind"], "measured");
  EXPECT_EQ(bench.Run(measured + " weight=1 --uncertainty 0.005").status, 2);
  EXPECT_EQ(bench.Run("catalog measured none mass_kg=1 --uncertainty 0.005").status, 2);
}

}  // namespace protocol_command_test
}  // namespace plenum::server
