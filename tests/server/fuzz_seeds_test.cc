// The seeds of the fuzzers of computations come through to the computation: of a seed that is
// refused at once hardly a mutant does. After a change that refuses the answers among them,
//   PLENUM_NEW_SEEDS=1 server_tests --gtest_filter='FuzzSeeds.*'
// writes these anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/fuzz/computations.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::fuzz {
namespace fuzz_seeds_test {

using api::Json;

std::filesystem::path Corpus(const char* target) {
  return test::SourceDir() / "tests/fuzz/corpus" / target;
}

// Those that people named; what a fuzzer kept has a hash for a name.
void ForEachSeed(const char* target, const std::function<void(const std::string&, Json)>& look) {
  for (const auto& file : std::filesystem::directory_iterator(Corpus(target))) {
    const std::string name = file.path().filename();
    if (name.size() >= 40) continue;
    SCOPED_TRACE(name);
    look(name, api::Parse(server::ReadAll(file.path())));
  }
}

Json Answer(Json request, bool proof) {
  request["ranking"]["proof"] = proof;
  request["ranking"]["time_limit_s"] = 100.0;
  const auto parts = api::SmallCatalogueWithVacuum();
  return api::AnswerRequest(std::get<api::DesignRequest>(api::ParseRequirements(request, parts)),
                            {}, parts);
}

// As a file that is small enough for the fuzzer.
void Write(Json answer, const std::string& name) {
  for (Json& design : answer["designs"]) design.erase("response");
  answer["seconds"] = 0.0;
  answer["catalogue_revision"] = {{"number", 1}, {"hash", "of the seeds"}};
  std::ofstream(Corpus("verify") / name) << answer.dump();
}

TEST(FuzzSeeds, DesignsAreFound) {
  ForEachSeed("design", [](const std::string& name, Json request) {
    const bool front = request["objective"].contains("pareto");
    const Json answer = Answer(request, !front);
    EXPECT_EQ(answer["designs"].empty(), name == "infeasible");
    if (std::getenv("PLENUM_NEW_SEEDS") == nullptr || name == "units") return;
    Write(answer, name + (front ? "" : "_proof"));
  });
}

TEST(FuzzSeeds, EvaluationsWork) {
  ForEachSeed("evaluation", [](const std::string& name, const Json& request) {
    const auto answer = api::RunEvaluation(request, api::SmallCatalogue(), {});
    ASSERT_EQ(api::ErrorsOf(answer).empty(), name != "no_volume");
    if (name == "no_volume") return;
    EXPECT_EQ(std::get<Json>(answer).at("works"), true);
  });
}

TEST(FuzzSeeds, AnswersAreAcceptedAsFarAsTheFuzzersLimitGoes) {
  ForEachSeed("verify", [](const std::string&, const Json& answer) {
    const auto verified = VerifyWithinLimit(answer);
    ASSERT_TRUE(std::holds_alternative<Json>(verified));
    const Json& document = std::get<Json>(verified);
    EXPECT_NE(document.at("accepted"), document.at("stopped"));
    for (const Json& check : document.at("checks")) EXPECT_EQ(check.at("ok"), true) << check;
  });
}

}  // namespace fuzz_seeds_test
}  // namespace plenum::fuzz
