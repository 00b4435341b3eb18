// `plenum protocol` and `plenum diagnose --save-part`, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

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

}  // namespace protocol_command_test
}  // namespace plenum::server
