// Writes that fail for want of space: a clear answer, nothing changed, and the service goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace full_disk_test {

using testing::HasSubstr;
using testing::IsEmpty;

// Adds parts with long notes until one is not acknowledged: how many were, and what the last got.
// At most 2000.
struct Filled {
  int acknowledged = 0;
  httplib::Result refused;
};
Filled AddUntilRefused(httplib::Client& client) {
  auto part = NewFitting("x");
  part["notes"] = std::string(3900, 'n');
  for (int i = 0;; ++i) {
    part["id"] = "full-" + std::to_string(i);
    auto added = client.Post("/v1/parts", part.dump(), "application/json");
    if (!added || added->status != 201 || i == 2000) return {i, std::move(added)};
  }
}

void ExpectInsufficientStorage(const httplib::Result& refused) {
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 507) << refused->body;
  EXPECT_EQ(refused->get_header_value("Content-Type"), "application/problem+json");
  EXPECT_THAT(refused->body, HasSubstr("nothing was changed"));
}

void ExpectWhole(const std::string& catalog, int acknowledged) {
  const catalog::Store store(catalog, catalog::Access::kRead);
  EXPECT_THAT(store.Check(), IsEmpty());
  for (int i = 0; i < acknowledged; ++i) {
    EXPECT_TRUE(store.Get("full-" + std::to_string(i))) << i;
  }
  EXPECT_FALSE(store.Get("full-" + std::to_string(acknowledged)));
}

TEST(FullDisk, ALimitOnFilesIsAnsweredWith507AndLeavesThingsWhole) {
  const Workbench bench;
  const auto size = std::filesystem::file_size(bench.catalog());
  ServeProcess serve(bench.catalog(), {.file_bytes_max = size + (200 << 10)});
  httplib::Client client("127.0.0.1", serve.port());
  client.set_tcp_nodelay(true);
  const auto [acknowledged, refused] = AddUntilRefused(client);
  ASSERT_GT(acknowledged, 10);
  ASSERT_LT(acknowledged, 2000);
  ExpectInsufficientStorage(refused);

  // Import, replace and delete as well; reading goes on.
  const std::string id = "/v1/parts/full-0";
  const auto csv = client.Get("/v1/parts/export?family=fitting");
  ASSERT_EQ(csv->status, 200);
  std::string other = csv->body;
  for (std::size_t at = 0; (at = other.find("nnnn", at)) != std::string::npos; at += 4)
    other.replace(at, 4, "mmmm");
  ExpectInsufficientStorage(client.Post("/v1/parts/import?family=fitting", other, "text/csv"));
  EXPECT_EQ(client.Get(id)->status, 200);
  EXPECT_EQ(client.Get("/v1/parts?family=valve")->status, 200);
  EXPECT_EQ(client.Get("/healthz")->status, 200);
  ExpectWhole(bench.catalog(), acknowledged);

  // With room again it writes again, in the same process.
  serve.LimitFiles(size + (64 << 20));
  auto part = NewFitting("full-after");
  EXPECT_EQ(client.Post("/v1/parts", part.dump(), "application/json")->status, 201);
  ExpectWhole(bench.catalog(), acknowledged);
  EXPECT_EQ(serve.End(SIGTERM), 0);
}

// The result is worth more than its place on disk, and the next service finds it again.
TEST(FullDisk, AJobThatEndsThereIsReadableAndDoneAgainAfterARestart) {
  const Workbench bench;
  std::string job;
  api::Json first;
  const auto when_ended = [&](httplib::Client& client) {
    for (;;) {
      const auto body = api::Json::parse(client.Get(job)->body);
      if (body["status"] != "queued" && body["status"] != "running") return body;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  };
  {
    ServeProcess serve(bench.catalog());
    httplib::Client client("127.0.0.1", serve.port());
    const std::string request = Example("crawler", 600.0).dump();
    job = client.Post("/v1/designs", request, "application/json")->get_header_value("Location");
    serve.LimitFiles(1);
    first = when_ended(client);
    EXPECT_EQ(first["status"], "done");
    ExpectInsufficientStorage(client.Post("/v1/designs", request, "application/json"));
    EXPECT_EQ(api::Json::parse(client.Get("/v1/designs")->body)["jobs"].size(), 1u);
    EXPECT_EQ(serve.End(SIGTERM), 0);
  }
  ServeProcess serve(bench.catalog());
  httplib::Client client("127.0.0.1", serve.port());
  const auto again = when_ended(client);
  EXPECT_EQ(again["status"], "done");
  EXPECT_TRUE(again["result"]["designs"] == first["result"]["designs"]);
}

// A disk of its own, with room for 1.5 MB beside the catalogue.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& place, std::uintmax_t catalog_bytes) : place_(place) {
    std::filesystem::create_directory(place_);
    const std::string size = "size=" + std::to_string(catalog_bytes + (1536 << 10));
    mounted_ = mount("tmpfs", place_.c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::filesystem::path place_;
  bool mounted_;
};

TEST(FullDisk, ADiskWithoutSpaceIsAnsweredWith507AndLeavesThingsWhole) {
  const Workbench bench;
  const SmallDisk disk(bench.Path("disk"), std::filesystem::file_size(bench.catalog()));
  if (!disk.mounted()) GTEST_SKIP() << "needs the right to mount a small disk";
  const auto catalog = bench.Path("disk") / "catalog.db";
  std::filesystem::copy_file(bench.catalog(), catalog);
  ServeProcess serve(catalog);
  httplib::Client client("127.0.0.1", serve.port());
  client.set_tcp_nodelay(true);
  const auto [acknowledged, refused] = AddUntilRefused(client);
  ASSERT_GT(acknowledged, 10);
  ASSERT_LT(acknowledged, 2000);
  ExpectInsufficientStorage(refused);
  EXPECT_EQ(client.Get("/v1/parts/full-0")->status, 200);
  ExpectWhole(catalog, acknowledged);
  // Backups and restores into the full disk are refused as cleanly.
  const auto backup = bench.Run("catalog backup '" + (bench.Path("disk") / "b.db").string() +
                                "' --catalog '" + catalog.string() + "'");
  EXPECT_EQ(backup.status, 2);
  EXPECT_THAT(backup.err, HasSubstr("full"));
  EXPECT_FALSE(std::filesystem::exists(bench.Path("disk") / "b.db"));
  ExpectWhole(catalog, acknowledged);
}

}  // namespace full_disk_test
}  // namespace plenum::server
