// Two groups in turns on one compressor: proved, not merely found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace crawler_test {

TEST(Crawler, IsProvedOptimal) {
  const std::filesystem::path root = test::SourceDir();
  const auto parts = catalog::Store(root / "catalog.db", catalog::Access::kRead).List();
  std::ifstream file(root / "examples/crawler.json");
  Json request = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
  request["ranking"] = {{"count", 3}, {"time_limit_s", 200}};
  const auto parsed = std::get<DesignRequest>(ParseRequirements(request, parts));
  const Json answer = AnswerRequest(parsed, {}, parts);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(answer["proof"]["undecided"], 0);
  ASSERT_EQ(answer["designs"].size(), 3u);
  EXPECT_EQ(answer["designs"][0]["performance"]["groups"].size(), 2u);
}

}  // namespace crawler_test
}  // namespace plenum::api
