// The built command, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace command_test {

using api::Json;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kSimulation[] = R"({
  "schema": "simulation/1",
  "actuators": [ { "name": "a", "count": 1, "rest_volume_ml": 50.0, "expansion_ratio": 2.0,
    "operating_pressure_kpa_gauge": 100.0,
    "line": { "sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35 } } ],
  "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200.0 },
  "valve": [ { "t_s": 0.0, "state": "inflate" }, { "t_s": 1.0, "state": "deflate" } ],
  "t_end_s": 2.0, "sample_hz": 50 })";
constexpr char kMap[] = R"({ "schema": "map/1", "source_pressure_ratio": [1.5, 3],
  "operating_pressure_ratio": [2.0], "expansion_ratio": [1, 2], "critical_ratio": [0.3] })";

// The document, if `text` is exactly one.
Json OneDocument(const std::string& text) {
  auto parsed = api::ParseJson(text);
  if (const auto* errors = std::get_if<api::Errors>(&parsed)) {
    ADD_FAILURE() << errors->front().detail << " in\n" << text.substr(0, 400);
    return {};
  }
  return std::get<Json>(parsed);
}

TEST(Command, UnknownFlagsAndCommandsAreBadInput) {
  const Workbench bench;
  EXPECT_EQ(bench.Run("").status, 2);
  EXPECT_EQ(bench.Run("fly").status, 2);
  const auto outcome = bench.Run("design - --fast");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("--fast"));
  EXPECT_EQ(bench.Run("design - --top many").status, 2);
}

TEST(Command, HelpIsAnAnswer) {
  const Workbench bench;
  const auto outcome = bench.Run("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* command : {"design", "verify", "simulate", "map", "catalog", "serve"}) {
    EXPECT_THAT(outcome.out, HasSubstr(command));
  }
}

TEST(Command, TheVersionIsThatOfTheAnswers) {
  const Workbench bench;
  const auto outcome = bench.Run("--version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "0.2.0\n");
  bench.Write("map.json", kMap);
  EXPECT_EQ(OneDocument(bench.Run("map map.json --json").out)["plenum"], "0.2.0");
}

TEST(Command, VerifyAcceptsAnAnswerAndRefusesAChangedOne) {
  const Workbench bench;
  bench.Write("request.json", Exosuit(120.0).dump());
  const auto designed = bench.Run("design request.json --top 2 --proof --json");
  ASSERT_EQ(designed.status, 0) << designed.err;
  Json answer = OneDocument(designed.out);
  bench.Write("result.json", designed.out);
  const auto accepted = bench.Run("verify result.json --json");
  EXPECT_EQ(accepted.status, 0) << accepted.err;
  EXPECT_EQ(OneDocument(accepted.out)["accepted"], true);
  EXPECT_THAT(bench.Run("verify result.json").out, HasSubstr("Accepted."));
  const auto cut = bench.Run("verify result.json --time-limit 1e-9");
  EXPECT_EQ(cut.status, 2);
  EXPECT_THAT(cut.out, HasSubstr("Not accepted: stopped"));
  EXPECT_THAT(cut.err, HasSubstr("not accepted: out of time after 1e-09 s"));

  answer["designs"][0]["totals"]["mass_kg"] = 0.1;
  bench.Write("changed.json", answer.dump());
  const auto refused = bench.Run("verify changed.json --json");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("refused: amounts"));
  EXPECT_EQ(OneDocument(refused.out)["accepted"], false);
  EXPECT_EQ(bench.Run("verify request.json").status, 2);
}

TEST(Command, MissingFilesAreNamed) {
  const Workbench bench;
  const auto no_file = bench.Run("design nowhere.json");
  EXPECT_EQ(no_file.status, 2);
  EXPECT_THAT(no_file.err, HasSubstr("nowhere.json"));
  const auto no_catalog = bench.Run("catalog list --catalog other.db");
  EXPECT_EQ(no_catalog.status, 2);
  EXPECT_THAT(no_catalog.err, HasSubstr("other.db"));
  EXPECT_FALSE(std::filesystem::exists(bench.Path("other.db")));
}

TEST(Command, SomethingElseThanACatalogueIsBadInput) {
  const Workbench bench;
  bench.Write("text.db", "this is no database, though it is long enough to look like a file\n");
  EXPECT_EQ(bench.Run("catalog check --catalog text.db").status, 2);
}

TEST(Command, DesignNamesEveryBadField) {
  const Workbench bench;
  auto request = Exosuit(1.0);
  request["actuators"][0]["rest_volume_ml"] = -1;
  request["duty"]["frequency_hz"] = "fast";
  const auto outcome = bench.Run("design - --json", request.dump());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("/actuators/0/rest_volume_ml"));
  EXPECT_THAT(outcome.err, HasSubstr("/duty/frequency_hz"));
}

TEST(Command, DesignRefusesTextThatIsNotJson) {
  const Workbench bench;
  EXPECT_EQ(bench.Run("design -", "{ \"schema\": ").status, 2);
  EXPECT_EQ(bench.Run("design -", "{}{}").status, 2);
}

TEST(Command, DesignChecksItsFlagsLikeTheFile) {
  const Workbench bench;
  const auto outcome = bench.Run("design - --top 0", Exosuit(1.0).dump());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("/ranking/count"));
}

TEST(Command, DesignFromStandardInputGivesOneDocument) {
  const Workbench bench;
  const auto outcome = bench.Run("design - --json --top 1 --time-limit 1", Exosuit(30.0).dump());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());  // no progress where there is no terminal
  const auto answer = OneDocument(outcome.out);
  EXPECT_EQ(answer["schema"], "designs/1");
  EXPECT_LE(answer["designs"].size(), 1u);
  EXPECT_LT(answer["seconds"].get<double>(), 10.0);
}

TEST(Command, DesignPrintsAFrontAndItsRobustness) {
  const Workbench bench;
  Json request = OneDocument(ReadAll(test::SourceDir() / "examples/gripper.json"));
  request["objective"] = {{"pareto", {"mass_kg", "volume_l"}}};
  request["robust"] = {{"draws", 20}};
  const auto text = bench.Run("design -", request.dump());
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("Pareto front"));
  EXPECT_THAT(text.out, HasSubstr("20 draws"));
  const auto json = OneDocument(bench.Run("design - --json", request.dump()).out);
  ASSERT_EQ(json["status"], "optimal");
  const auto& front = json["front"];
  ASSERT_EQ(front.size(), json["designs"].size());
  for (std::size_t i = 1; i < front.size(); ++i) {
    EXPECT_GT(front[i]["objectives"]["mass_kg"], front[i - 1]["objectives"]["mass_kg"]);
    EXPECT_LT(front[i]["objectives"]["volume_l"], front[i - 1]["objectives"]["volume_l"]);
  }
}

TEST(Command, DesignExplainsWhatIsAsked) {
  const Workbench bench;
  Json request = OneDocument(ReadAll(test::SourceDir() / "examples/gripper.json"));
  request["explain"] = {{"prices", true}, {"ranks", 3}};
  request["ranking"] = {{"count", 3}};
  const auto text = bench.Run("design -", request.dump());
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("Price of each requirement"));
  EXPECT_THAT(text.out, HasSubstr("Design 3 would be first"));
}

TEST(Command, AnInterruptedDesignPrintsWhatItHas) {
  const Workbench bench;
  // The signal comes a while after the program says that it catches it, however slowly it starts.
  bench.Write("interrupt.sh", R"(exec 3<&0
"$@" <&3 &
for _ in $(seq 6000); do
  grep -q '^SigCgt:.*[2367abef]$' /proc/$!/status && break
  sleep 0.01
done
sleep 0.3
kill -INT $!
wait $!
)");
  const auto outcome = bench.Run("design - --json", SlowToProve(60.0).dump(), "sh interrupt.sh");
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(OneDocument(outcome.out)["status"], "cancelled");
}

std::vector<std::string> PartIds(const api::Json& answer) {
  std::vector<std::string> ids;
  for (const auto& design : answer["designs"])
    for (const auto& part : design["parts"]) ids.push_back(part["id"]);
  return ids;
}

TEST(Command, ALighterBatteryTakesRankOneAndItsRemovalBringsTheListBack) {
  const Workbench bench;
  const auto design = [&] {
    return OneDocument(bench.Run("design - --json", Exosuit(30.0).dump()).out);
  };
  const auto before = design();
  ASSERT_EQ(before["status"], "optimal");
  std::string battery;
  for (const auto& part : before["designs"][0]["parts"])
    if (part["family"] == "battery") battery = part["id"];
  auto lighter = OneDocument(bench.Run("catalog show " + battery + " --json").out);
  lighter["id"] = "bench-light-pack";
  lighter["mass_kg"] = 0.5 * lighter["mass_kg"].get<double>();
  bench.Write("part.json", lighter.dump());
  ASSERT_EQ(bench.Run("catalog add part.json").status, 0);

  const auto with = design();
  EXPECT_THAT(PartIds(with), testing::Contains("bench-light-pack"));
  EXPECT_EQ(with["designs"][0]["parts"][4]["id"], "bench-light-pack");
  EXPECT_LT(with["designs"][0]["totals"]["mass_kg"].get<double>(),
            before["designs"][0]["totals"]["mass_kg"].get<double>());
  ASSERT_EQ(bench.Run("catalog remove bench-light-pack").status, 0);
  EXPECT_EQ(PartIds(design()), PartIds(before));
}

TEST(Command, PartMassesSumToTheTotals) {
  const Workbench bench;
  const auto answer = OneDocument(bench.Run("design - --json", Exosuit(30.0).dump()).out);
  ASSERT_FALSE(answer["designs"].empty());
  for (const auto& design : answer["designs"]) {
    double mass_kg = 0.0;
    for (const auto& part : design["parts"]) mass_kg += part["mass_kg"].get<double>();
    EXPECT_NEAR(mass_kg, design["totals"]["mass_kg"].get<double>(), 1e-9);
  }
}

TEST(Command, SimulateAndMapPrintOneDocumentOrATable) {
  const Workbench bench;
  const auto response = OneDocument(bench.Run("simulate - --json", kSimulation).out);
  EXPECT_EQ(response["schema"], "response/1");
  EXPECT_EQ(response["t_s"].size(), response["groups"][0]["pressure_kpa_gauge"].size());
  EXPECT_THAT(bench.Run("simulate -", kSimulation).out, HasSubstr("rise s"));

  bench.Write("map.json", kMap);
  EXPECT_EQ(OneDocument(bench.Run("map map.json --json").out)["rows"].size(), 4u);
  EXPECT_EQ(bench.Run("map map.json").status, 0);
  EXPECT_EQ(bench.Run("map -", R"({"schema": "map/1"})").status, 2);
}

TEST(Command, CatalogAddsShowsAndRemovesAPart) {
  const Workbench bench;
  bench.Write("part.json", NewFitting("bench-f1").dump());
  ASSERT_EQ(bench.Run("catalog add part.json").status, 0);
  EXPECT_EQ(bench.Run("catalog add part.json").status, 2);  // taken
  const auto shown = bench.Run("catalog show bench-f1 --json");
  const auto part = OneDocument(shown.out);
  EXPECT_EQ(part["mass_kg"], 0.003);
  EXPECT_EQ(part["origin"], "user");
  EXPECT_THAT(bench.Run("catalog show bench-f1").out, HasSubstr("critical_ratio"));
  EXPECT_EQ(bench.Run("catalog remove bench-f1").status, 0);
  EXPECT_EQ(bench.Run("catalog show bench-f1").status, 2);
  EXPECT_EQ(bench.Run("catalog add -", shown.out).status, 0);  // what show prints goes back in
}

TEST(Command, CatalogRefusesABadPart) {
  const Workbench bench;
  auto part = NewFitting("bench-f1");
  part["critical_ratio"] = 1.5;
  const auto outcome = bench.Run("catalog add -", part.dump());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("/critical_ratio"));
}

TEST(Command, CatalogExportGoesBackInUnchanged) {
  const Workbench bench;
  const auto csv = bench.Run("catalog export valve");
  ASSERT_EQ(csv.status, 0);
  const auto count = OneDocument(bench.Run("catalog list valve --json").out)["parts"].size();
  ASSERT_GT(count, 0u);
  const auto imported = OneDocument(bench.Run("catalog import valve - --json", csv.out).out);
  EXPECT_EQ(imported["unchanged"].size(), count);
  EXPECT_THAT(imported["replaced"], IsEmpty());
  EXPECT_EQ(bench.Run("catalog list valve --csv").out, csv.out);
}

TEST(Command, CatalogImportDryRunWritesNothing) {
  const Workbench bench;
  bench.Run("catalog add -", NewFitting("bench-f1").dump());
  auto csv = bench.Run("catalog export fitting").out;
  bench.Run("catalog remove bench-f1");
  EXPECT_THAT(bench.Run("catalog import fitting - --dry-run", csv).out, HasSubstr("would add 1"));
  EXPECT_EQ(bench.Run("catalog show bench-f1").status, 2);
  EXPECT_EQ(bench.Run("catalog import fitting -", csv).status, 0);
  EXPECT_EQ(bench.Run("catalog show bench-f1").status, 0);
}

TEST(Command, CatalogRefusesUnknownFamilies) {
  const Workbench bench;
  EXPECT_EQ(bench.Run("catalog list wheels").status, 2);
  EXPECT_EQ(bench.Run("catalog export wheels").status, 2);
  EXPECT_EQ(bench.Run("catalog import wheels -", "id\n").status, 2);
}

TEST(Command, CatalogCheckFindsNoFault) {
  const Workbench bench;
  EXPECT_EQ(bench.Run("catalog check").status, 0);
}

TEST(Command, ServeRefusesOtherMachinesWithoutTokens) {
  const Workbench bench;
  for (const char* host : {"0.0.0.0", "::", "192.168.1.1", "example.com"}) {
    const auto outcome = bench.Run(std::string("serve --port 0 --host ") + host);
    EXPECT_EQ(outcome.status, 2) << host;
    EXPECT_THAT(outcome.err, HasSubstr("needs tokens"));
  }
  EXPECT_EQ(bench.Run("serve --port 70000").status, 2);
}

TEST(Command, ServeEndsCleanlyOnSignals) {
  const Workbench bench;
  for (const int signal : {SIGINT, SIGTERM}) {
    ServeProcess serve(bench.catalog());
    EXPECT_EQ(serve.End(signal), 0);
  }
}

}  // namespace command_test
}  // namespace plenum::server
