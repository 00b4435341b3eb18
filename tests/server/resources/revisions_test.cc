// /v1/revisions of the real service.
#include <gtest/gtest.h>
#include <httplib.h>

#include <set>
#include <string>

#include "tests/server/service.h"

namespace plenum::server {
namespace revisions_test {

using api::Json;

TEST(Revisions, ALargeWriteIsReadInPages) {
  const Service service;
  httplib::Client client("127.0.0.1", service.port());
  const auto get = [&](const std::string& path) { return JsonOf(client.Get(path)->body); };
  std::string csv =
      "id,manufacturer,part_number,tube_outer_diameter_mm,sonic_conductance_dm3_per_s_bar,"
      "critical_ratio,mass_kg,body_volume_ml,pressure_max_kpa_gauge,thread\n";
  std::set<std::string> ids;
  for (int i = 0; i < 250; ++i) {
    ids.insert("row" + std::to_string(i));
    csv += "row" + std::to_string(i) + ",maker,F1,4,0.31,0.4,0.001,0.7,800,M5\n";
  }
  ASSERT_EQ(client.Post("/v1/parts/import?family=fitting", csv, "text/csv")->status, 200);
  const Json newest = get("/v1/revisions?limit=1")["revisions"][0];
  const std::string path = "/v1/revisions/" + newest["number"].dump();
  EXPECT_EQ(get(path)["changes"].size(), 100u);  // however many it changed
  std::set<std::string> seen;
  std::string cursor;
  do {
    const Json page = get(path + "?limit=90&cursor=" + cursor);
    EXPECT_EQ(page["hash"], newest["hash"]);
    for (const Json& change : page["changes"]) {
      EXPECT_EQ(change["before"], Json());
      EXPECT_TRUE(seen.insert(change["id"].get<std::string>()).second);
    }
    cursor = page["next_cursor"].is_null() ? "" : page["next_cursor"].get<std::string>();
  } while (!cursor.empty());
  EXPECT_EQ(seen, ids);
  EXPECT_EQ(client.Get(path + "?limit=0")->status, 422);
}

}  // namespace revisions_test
}  // namespace plenum::server
