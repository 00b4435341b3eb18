// A search runs on one thread; the service runs several at a time. However many there are, each
// gives what it gives alone, to the last byte of its document.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace threads_test {

Json Example(const std::string& name) {
  const std::filesystem::path root = test::SourceDir();
  std::ifstream file(root / "examples" / (name + ".json"));
  Json request = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
  request["ranking"] = {{"count", 4}, {"time_limit_s", 300}, {"proof", true}};
  return request;
}

TEST(Threads, GiveTheSameDocumentsHoweverManyThereAre) {
  const std::filesystem::path root = test::SourceDir();
  const auto parts = catalog::Store(root / "catalog.db", catalog::Access::kRead).List();
  std::vector<Json> requests{Example("gripper"), Example("exosuit"), Example("exosuit")};
  for (std::size_t i : {1, 2}) requests[i]["ranking"]["count"] = 4;
  // Made-to-measure reservoirs, so that the solvers run too.
  requests[2]["supply"]["configurations"] = {"compressor"};
  requests[2]["objective"] = {{"minimize", "volume_l"}};
  const auto answer = [&](std::size_t which) {
    const auto parsed = std::get<DesignRequest>(ParseRequirements(requests[which], parts));
    Json document = AnswerRequest(parsed, {}, parts);
    document.erase("seconds");
    return document.dump();
  };
  std::vector<std::string> alone;
  for (std::size_t i = 0; i < requests.size(); ++i) alone.push_back(answer(i));
  for (std::size_t count : {2, 4, 7}) {
    std::vector<std::string> documents(count);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i)
      threads.emplace_back([&, i] { documents[i] = answer(i % requests.size()); });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_TRUE(documents[i] == alone[i % requests.size()]) << i << " of " << count;
  }
}

}  // namespace threads_test
}  // namespace plenum::api
