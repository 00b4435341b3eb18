// The inputs of ../shared/cases, where they are there: each gives an answer or a named error, and
// the service goes on.
#include <gtest/gtest.h>
#include <httplib.h>

#include <filesystem>

#include "tests/server/service.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace cases_test {

constexpr double kSeconds = 0.5;

std::vector<std::filesystem::path> Cases() {
  std::vector<std::filesystem::path> files;
  const auto cases = test::SourceDir().parent_path() / "shared/cases";
  for (const char* folder : {"designs", "measured"})
    if (std::filesystem::exists(cases / folder))
      for (const auto& file : std::filesystem::directory_iterator(cases / folder))
        if (file.path().extension() == ".json") files.push_back(file.path());
  return files;
}

TEST(Cases, GiveAnAnswerOrANamedErrorByCommandAndOverHttp) {
  const auto files = Cases();
  if (files.empty()) GTEST_SKIP() << "no ../shared/cases beside the checkout";
  const Service service;
  httplib::Client client("127.0.0.1", service.port());
  client.set_read_timeout(120);
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename());
    api::Json document = JsonOf(ReadAll(file));
    const std::string schema = document.value("schema", "measurement/1");
    std::string command = "diagnose", path = "/v1/diagnoses", limit = " --time-limit 0.5";
    if (schema == "requirements/1") {
      command = "design", path = "/v1/designs";
      document["ranking"]["time_limit_s"] = kSeconds;
    } else if (schema == "evaluation/1") {
      command = "evaluate", path = "/v1/evaluations", limit = "";
    } else {
      document["time_limit_s"] = kSeconds;
    }
    const auto outcome = service.bench().Run(command + " '" + file.string() + "' --json" + limit);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 2) << outcome.status << outcome.err;
    EXPECT_FALSE(outcome.status == 0 ? outcome.out.empty() : outcome.err.empty());
    const auto reply =
        client.Post(path, {{"Prefer", "wait=60"}}, document.dump(), "application/json");
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->status, outcome.status == 0 ? 200 : 422) << reply->body.substr(0, 300);
    if (reply->status == 422) {
      EXPECT_FALSE(JsonOf(reply->body).at("errors").empty());
    }
  }
}

}  // namespace cases_test
}  // namespace plenum::server
