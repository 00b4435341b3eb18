// The catalogue of a service follows the one that was installed with the program.
#include <gtest/gtest.h>
#include <httplib.h>

#include <filesystem>
#include <string>

#include "api/catalogue/stores.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace seed_test {

using api::Json;

constexpr char kJson[] = "application/json";
constexpr char kUpdate[] = "/v1/catalog/update";

class InstalledCatalogue : public testing::Test {
 protected:
  InstalledCatalogue() : service_(WithSeed()), client_("127.0.0.1", service_.port()) {}

  HttpOptions WithSeed() {
    HttpOptions options;
    options.seed = bench_.Path("installed.db");
    return options;
  }
  // The catalogue of a newer package: one part less, one heavier, one more.
  void Install() {
    std::filesystem::copy_file(bench_.catalog(), bench_.Path("installed.db"));
    catalog::Store store(bench_.Path("installed.db"), catalog::Access::kWrite);
    std::vector<catalog::Part> parts = store.List("fitting");
    ASSERT_GE(parts.size(), 3u);
    gone_ = parts[0].id;
    heavier_ = parts[1].id;
    catalog::Part added = parts[2];
    added.id = "fitting-of-the-newer-package";
    std::vector<catalog::Part> all = store.List();
    std::erase_if(all, [&](const catalog::Part& part) { return part.id == gone_; });
    for (catalog::Part& part : all)
      if (part.id == heavier_) part.numbers.at("mass_kg").value = 0.123;
    all.push_back(added);
    store.ReplaceSeed(all);
  }
  Json Update(const std::string& query = "") {
    const auto reply = client_.Post(kUpdate + query, "", kJson);
    EXPECT_EQ(reply->status, 200) << reply->body;
    return JsonOf(reply->body);
  }
  Json Head() {
    return JsonOf(client_.Get("/v1/revisions?limit=1")->body)["revisions"][0]["number"];
  }
  int StatusOf(const std::string& id) { return client_.Get("/v1/parts/" + id)->status; }

  const Workbench bench_;
  Service service_;
  httplib::Client client_;
  std::string gone_, heavier_;
};

TEST_F(InstalledCatalogue, IsLookedAtByADryRunAndTakenOverAsOneRevision) {
  Install();
  const Json head = Head();
  const Json plan = Update("?dry_run=true");
  EXPECT_EQ(plan["added"], Json::array({"fitting-of-the-newer-package"}));
  EXPECT_EQ(plan["replaced"], Json::array({heavier_}));
  EXPECT_EQ(plan["removed"], Json::array({gone_}));
  EXPECT_EQ(plan["kept"], Json::array());
  EXPECT_EQ(Head(), head);
  EXPECT_EQ(StatusOf(gone_), 200);

  const Json update = Update();
  EXPECT_EQ(update["added"], plan["added"]);
  EXPECT_EQ(update["revision"]["number"], Head());
  EXPECT_EQ(StatusOf(gone_), 404);
  EXPECT_EQ(StatusOf("fitting-of-the-newer-package"), 200);
  EXPECT_EQ(JsonOf(client_.Get("/v1/parts/" + heavier_)->body)["mass_kg"], 0.123);

  const Json again = Update();
  EXPECT_EQ(again["added"], Json::array());
  EXPECT_EQ(again["revision"]["number"], update["revision"]["number"]);

  const std::string number = update["revision"]["number"].dump();
  EXPECT_EQ(client_.Post("/v1/revisions/" + number + "/undo", "", kJson)->status, 200);
  EXPECT_EQ(StatusOf(gone_), 200);
}

TEST_F(InstalledCatalogue, LeavesWhatWasChangedHere) {
  Install();
  auto mine = JsonOf(client_.Get("/v1/parts/" + heavier_)->body);
  mine["mass_kg"] = 0.456;
  ASSERT_EQ(client_.Put("/v1/parts/" + heavier_, {{"If-Match", "*"}}, mine.dump(), kJson)->status,
            200);
  EXPECT_EQ(Update()["kept"], Json::array({heavier_}));
  EXPECT_EQ(JsonOf(client_.Get("/v1/parts/" + heavier_)->body)["mass_kg"], 0.456);
}

TEST_F(InstalledCatalogue, MayBeMissing) {
  EXPECT_EQ(client_.Post(kUpdate, "", kJson)->status, 404);
  EXPECT_EQ(client_.Post(std::string(kUpdate) + "?dry_run=perhaps", "", kJson)->status, 422);
}

}  // namespace seed_test
}  // namespace plenum::server
