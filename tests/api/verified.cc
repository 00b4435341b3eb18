#include "tests/api/verified.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "api/catalogue/part_document.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/verification.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace {

const std::filesystem::path kRoot = test::SourceDir();

}  // namespace

const Catalogue& Project() {
  static const Catalogue catalogue = [] {
    const catalog::Store store(kRoot / "catalog.db", catalog::Access::kRead);
    auto [revision, parts] = store.ListWithHead();
    return Catalogue{revision, parts};
  }();
  return catalogue;
}

Json Example(const std::string& name) {
  std::ifstream file(kRoot / "examples" / (name + ".json"));
  return Parse(std::string(std::istreambuf_iterator<char>(file), {}));
}

Json Answered(const Json& request) {
  const auto parsed = std::get<DesignRequest>(ParseRequirements(request, Project().parts));
  Json answer = AnswerRequest(parsed, {}, Project().parts);
  answer["catalogue_revision"] = RenderRevisionName(Project().revision);
  return Parse(answer.dump());
}

std::string Pointers(const Json& request) {
  std::string all;
  for (const Error& error : ErrorsOf(ParseRequirements(request, Project().parts)))
    all += error.pointer + " ";
  return all;
}

Json SlowFingers(int groups) {
  Json request = Example("gripper");
  Json finger = request["actuators"][0];
  finger["count"] = 2;
  finger["rise_time_s_max"] = 2.0;
  finger["fall_time_s_max"] = 2.0;
  request["actuators"] = Json::array();
  for (int g = 0; g < groups; ++g) {
    finger["name"] = "fingers " + std::to_string(g);
    request["actuators"].push_back(finger);
  }
  request["duty"] = {{"frequency_hz", 0.1}, {"actuations", 500}, {"simultaneous", groups == 1}};
  request["supply"] = {{"configurations", {"direct_pump"}}};
  request["ranking"] = {{"count", 2}, {"list", "combinations"}, {"proof", true}};
  return request;
}

Parsed<Json> Evaluated(const Json& request, const Json& design) {
  return RunEvaluation({{"schema", "evaluation/1"}, {"requirements", request}, {"design", design}},
                       Project().parts, {});
}

Json Verified(const Json& answer) {
  return VerifiedWithin(answer, std::numeric_limits<int>::max());
}

Json VerifiedWithin(const Json& answer, int looks) {
  const auto verified = VerifyAnswer(answer, Project().parts, Project().revision, {},
                                     [left = looks]() mutable { return left-- <= 0; });
  for (const Error& error : ErrorsOf(verified)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<Json>(verified);
}

std::string RefusalsIn(const Json& verified) {
  std::string refusals;
  for (const Json& check : verified["checks"])
    if (!check["ok"])
      refusals +=
          check["check"].get<std::string>() + ": " + check["detail"].get<std::string>() + "\n";
  return refusals;
}

std::string Refusals(const Json& answer) {
  const Json verified = Verified(answer);
  std::string refusals = RefusalsIn(verified);
  EXPECT_EQ(verified["accepted"], refusals.empty());
  return refusals;
}

void ExpectRefused(const Json& answer, std::span<const Tampering> tamperings) {
  for (const Tampering& tampering : tamperings) {
    Json tampered = answer;
    tampering.tamper(tampered);
    ASSERT_NE(tampered, answer) << tampering.name;
    const std::string refusals = Refusals(tampered);
    EXPECT_NE(("\n" + refusals).find(std::string("\n") + tampering.check + ": "), std::string::npos)
        << tampering.name << " is refused by\n"
        << refusals;
  }
}

}  // namespace plenum::api
