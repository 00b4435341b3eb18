#include "api/json/problem_document.h"

#include <gtest/gtest.h>

#include "tests/api/support.h"

namespace plenum::api {
namespace problem_document_test {

TEST(ProblemDocument, ListsEveryError) {
  const Json document =
      ProblemDocument(422, Errors{{"/actuators/0/count", "must be ≥ 1"}, {"", "empty"}});
  EXPECT_EQ(document, Parse(R"({ "type": "about:blank", "title": "Unprocessable Content",
    "status": 422, "errors": [ {"pointer": "/actuators/0/count", "detail": "must be ≥ 1"},
                               {"pointer": "", "detail": "empty"} ] })"));
}

TEST(ProblemDocument, CountsWhatItLeavesOut) {
  const Json document = ProblemDocument(422, Errors(1234, {"/x", "unknown field"}));
  ASSERT_EQ(document["errors"].size(), 101u);
  EXPECT_EQ(document["errors"][100]["detail"], "1134 more errors");
}

TEST(ProblemDocument, SaysOneThingWithoutFields) {
  const Json document = ProblemDocument(404, "no job 7");
  EXPECT_EQ(document["detail"], "no job 7");
  EXPECT_EQ(document["title"], "Not Found");
  EXPECT_FALSE(document.contains("errors"));
}

TEST(Lines, AreForAPerson) {
  EXPECT_EQ(Lines({{"/a", "is required"}, {"", "not JSON"}}), "/a: is required\nnot JSON\n");
}

}  // namespace problem_document_test
}  // namespace plenum::api
