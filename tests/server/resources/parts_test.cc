// /v1/parts and /v1/revisions of the real service.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <random>
#include <set>
#include <thread>

#include "api/json/json.h"
#include "tests/server/raw.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace parts_test {

using api::Json;
using testing::HasSubstr;

constexpr char kJson[] = "application/json";

class PartsOverHttp : public testing::Test {
 protected:
  PartsOverHttp() { Start(); }

  // A new process on the same catalogue; the old one, if any, is killed.
  void Start() {
    serve_.reset();
    serve_ = std::make_unique<ServeProcess>(bench_.catalog());
    client_ = std::make_unique<httplib::Client>("127.0.0.1", serve_->port());
    client_->set_tcp_nodelay(true);
  }

  static Json Body(const httplib::Result& result) {
    auto parsed = api::ParseJson(result ? result->body : "");
    return std::holds_alternative<Json>(parsed) ? std::get<Json>(parsed) : Json();
  }
  Json Get(const std::string& path) { return Body(client_->Get(path)); }
  httplib::Result Add(const Json& part, const httplib::Headers& headers = {}) {
    return client_->Post("/v1/parts", headers, part.dump(), kJson);
  }
  // Posts a table until its answer has a status that will do, at most 200 times; the last answer.
  httplib::Result PostUntil(const std::string& path, const std::string& table,
                            const std::function<bool(int status)>& will_do) {
    auto result = client_->Post(path, table, "text/csv");
    for (int i = 1; i < 200 && !(result && will_do(result->status)); ++i)
      result = client_->Post(path, table, "text/csv");
    return result;
  }
  static Json Fitting(const std::string& id, double mass_kg) {
    Json part = NewFitting(id);
    part["mass_kg"] = mass_kg;
    return part;
  }

  const Workbench bench_;
  std::unique_ptr<ServeProcess> serve_;
  std::unique_ptr<httplib::Client> client_;
};

TEST_F(PartsOverHttp, FiltersSortsAndCounts) {
  const Json page =
      Get("/v1/parts?family=battery&mass_kg_min=0.1&mass_kg_max=0.3&sort=-mass_kg"
          "&facets=true&limit=1000");
  ASSERT_GT(page["total"].get<int>(), 5);
  double last = 0.3;
  for (const Json& part : page["parts"]) {
    EXPECT_EQ(part["family"], "battery");
    EXPECT_LE(part["mass_kg"], last);
    EXPECT_GE(part["mass_kg"], 0.1);
    last = part["mass_kg"];
  }
  EXPECT_EQ(page["facets"]["texts"]["family"]["battery"], page["total"]);
  EXPECT_EQ(page["facets"]["numbers"]["mass_kg"]["count"], page["total"]);
  EXPECT_EQ(page["facets"]["numbers"]["mass_kg"]["min"], last);
  EXPECT_EQ(client_->Get("/v1/parts?family=battery&coil_power_w_max=1")->status, 422);
  EXPECT_EQ(client_->Get("/v1/parts?mass_kg_max=light")->status, 422);
}

TEST_F(PartsOverHttp, PagesStayThoseOfOneRevisionWhileOthersWrite) {
  const Json all = Get("/v1/parts?family=fitting&sort=-mass_kg&limit=1000");
  std::vector<std::string> expected, paged;
  for (const Json& part : all["parts"]) expected.push_back(part["id"]);
  std::string cursor;
  for (int i = 0; i < 100; ++i) {
    const Json page = Get("/v1/parts?family=fitting&sort=-mass_kg&limit=9&cursor=" + cursor);
    ASSERT_TRUE(page.contains("parts")) << page;
    for (const Json& part : page["parts"]) paged.push_back(part["id"]);
    EXPECT_EQ(page["catalogue_revision"], all["catalogue_revision"]);
    if (page["next_cursor"].is_null()) break;
    cursor = page["next_cursor"];
    // Before, at and behind the page; and the part that the cursor names goes.
    ASSERT_EQ(Add(Fitting("new-" + std::to_string(i), 0.001 * (i + 1)))->status, 201);
    const std::string last = page["parts"].back()["id"];
    ASSERT_EQ(client_->Delete("/v1/parts/" + last, {{"If-Match", "*"}})->status, 204);
  }
  EXPECT_EQ(paged, expected);
  EXPECT_EQ(client_->Get("/v1/parts?cursor=99999.x")->status, 404);
}

TEST_F(PartsOverHttp, ListsAndPartsHaveStrongTags) {
  const std::string list = "/v1/parts?family=tubing";
  const auto first = client_->Get(list);
  const auto tag = first->get_header_value("ETag");
  EXPECT_THAT(tag, testing::MatchesRegex("\"[0-9a-f]{32}\""));
  EXPECT_EQ(client_->Get(list, {{"If-None-Match", tag}})->status, 304);
  EXPECT_EQ(client_->Get(list, {{"If-None-Match", "\"x\", W/" + tag}})->status, 304);
  EXPECT_EQ(client_->Get(list, {{"If-None-Match", "\"x\""}})->status, 200);
  ASSERT_EQ(Add(NewFitting("f"))->status, 201);
  EXPECT_EQ(client_->Get(list, {{"If-None-Match", tag}})->status, 200);  // another revision
  EXPECT_EQ(client_->Get("/v1/parts/f")->get_header_value("ETag"),
            client_->Get("/v1/parts/f")->get_header_value("ETag"));
}

TEST_F(PartsOverHttp, ReplaceAndDeleteNeedTheTagOfWhatIsThere) {
  const auto added = Add(NewFitting("f"));
  const auto tag = added->get_header_value("ETag");
  const auto put = [&](const httplib::Headers& headers, double mass) {
    return client_->Put("/v1/parts/f", headers, Fitting("f", mass).dump(), kJson);
  };
  EXPECT_EQ(put({}, 0.1)->status, 412);
  EXPECT_EQ(put({{"If-Match", "W/" + tag}}, 0.1)->status, 412);
  EXPECT_EQ(client_->Delete("/v1/parts/f")->status, 412);
  EXPECT_EQ(client_->Delete("/v1/parts/f", {{"If-Match", "\"0\""}})->status, 412);
  EXPECT_EQ(put({{"If-Match", "\"0,*,0\""}}, 0.1)->status, 412);  // one tag, with commas
  EXPECT_EQ(put({{"If-Match", "*, \"0\""}}, 0.1)->status, 412);   // * stands alone
  EXPECT_EQ(put({{"If-Match", "\"0\", " + tag}}, 0.1)->status, 200);
  EXPECT_EQ(put({{"If-Match", tag}}, 0.2)->status, 412);
  EXPECT_EQ(Get("/v1/parts/f")["mass_kg"], 0.1);
  EXPECT_EQ(client_->Delete("/v1/parts/f", {{"If-Match", tag}})->status, 412);
  const auto now = client_->Get("/v1/parts/f")->get_header_value("ETag");
  EXPECT_EQ(client_->Delete("/v1/parts/f", {{"If-Match", now}})->status, 204);
  EXPECT_EQ(client_->Delete("/v1/parts/f", {{"If-Match", now}})->status, 404);
}

TEST_F(PartsOverHttp, ARepeatedPostActsOnceAlsoAfterARestart) {
  const httplib::Headers key = {{"Idempotency-Key", "one"}};
  const auto first = Add(NewFitting("f"), key);
  ASSERT_EQ(first->status, 201);
  const Json revision = Get("/v1/parts?limit=1")["catalogue_revision"];
  for (int i = 0; i < 2; ++i) {
    const auto again = Add(NewFitting("f"), key);
    EXPECT_EQ(again->status, 201) << again->body;
    EXPECT_EQ(again->body, first->body);
    for (const char* header : {"ETag", "Location", "Catalogue-Revision"})
      EXPECT_EQ(again->get_header_value(header), first->get_header_value(header)) << header;
    Start();
  }
  EXPECT_EQ(Get("/v1/parts?limit=1")["catalogue_revision"], revision);
  EXPECT_EQ(Add(NewFitting("g"), key)->status, 422);  // the key stands for f
  EXPECT_EQ(Add(NewFitting("f"))->status, 409);
  EXPECT_EQ(Add(NewFitting("g"), {{"Idempotency-Key", std::string(256, 'k')}})->status, 400);
  // The same body for another resource is another request.
  EXPECT_EQ(
      client_->Post("/v1/parts/import?family=fitting", key, NewFitting("f").dump(), "text/csv")
          ->status,
      422);
}

// Sends the same request from eight connections at once.
template <typename Send>
std::vector<std::pair<int, std::string>> AtOnce(int port, const Send& send) {
  std::vector<std::pair<int, std::string>> answers(8);
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& answer : answers)
    threads.emplace_back([&] {
      httplib::Client client("127.0.0.1", port);
      const httplib::Result result = send(client);
      if (result) answer = {result->status, result->body};
    });
  for (auto& thread : threads) thread.join();
  std::sort(answers.begin(), answers.end());
  return answers;
}

TEST_F(PartsOverHttp, OfRequestsWithOneKeyAtOnceOneActsAndAllAnswerAlike) {
  const auto answers = AtOnce(serve_->port(), [](httplib::Client& client) {
    return client.Post("/v1/parts", {{"Idempotency-Key", "at once"}}, NewFitting("f").dump(),
                       kJson);
  });
  EXPECT_EQ(answers.front().first, 201);
  EXPECT_EQ(answers.front(), answers.back());
  EXPECT_EQ(Get("/v1/parts/f/history")["history"].size(), 1u);
}

TEST_F(PartsOverHttp, OfReplacementsWithOneTagAtOnceOneIsDone) {
  const auto tag = Add(NewFitting("f"))->get_header_value("ETag");
  std::atomic<int> grams = 10;
  const auto answers = AtOnce(serve_->port(), [&](httplib::Client& client) {
    return client.Put("/v1/parts/f", {{"If-Match", tag}}, Fitting("f", ++grams / 1000.0).dump(),
                      kJson);
  });
  EXPECT_EQ(answers[0].first, 200);
  for (std::size_t i = 1; i < answers.size(); ++i) EXPECT_EQ(answers[i].first, 412);
  EXPECT_EQ(Get("/v1/parts/f/history")["history"].size(), 2u);
}

TEST_F(PartsOverHttp, CommandsAndTheServiceWriteToOneCatalogue) {
  std::thread commands([&] {
    for (int i = 0; i < 10; ++i)
      EXPECT_EQ(bench_.Run("catalog add -", NewFitting("c" + std::to_string(i)).dump()).status, 0);
  });
  for (int i = 0; i < 40; ++i) EXPECT_EQ(Add(NewFitting("h" + std::to_string(i)))->status, 201);
  commands.join();
  EXPECT_EQ(Get("/v1/parts?family=fitting&manufacturer=bench&limit=100")["total"], 50);
  EXPECT_EQ(bench_.Run("catalog check").status, 0);
}

TEST_F(PartsOverHttp, ARepeatedImportAnswersAsTheFirst) {
  const std::string csv =
      "id,manufacturer,part_number,internal_volume_ml,mass_kg,body_volume_ml,"
      "pressure_max_kpa_gauge\nmine,me,bottle,0.5 L,350 g,600,6 bar\n";
  const std::string path = "/v1/parts/import?family=reservoir";
  const Json would = Body(client_->Post(path + "&dry_run=true", csv, "text/csv"));
  EXPECT_EQ(would["added"], Json::array({"mine"}));
  EXPECT_EQ(would["dry_run"], true);
  EXPECT_EQ(client_->Get("/v1/parts/mine")->status, 404);

  const httplib::Headers key = {{"Idempotency-Key", "two"}, {"From", "ann@example.org"}};
  const auto first = client_->Post(path, key, csv, "text/csv");
  ASSERT_EQ(first->status, 200) << first->body;
  EXPECT_EQ(Body(first)["added"], Json::array({"mine"}));
  EXPECT_EQ(Get("/v1/parts/mine")["mass_kg"], 0.35);
  EXPECT_EQ(Get("/v1/parts/mine")["pressure_max_kpa_gauge"], 600.0);
  ASSERT_EQ(client_->Delete("/v1/parts/mine", {{"If-Match", "*"}})->status, 204);
  Start();
  const auto again = client_->Post(path, key, csv, "text/csv");
  EXPECT_EQ(again->body, first->body);
  EXPECT_EQ(client_->Get("/v1/parts/mine")->status, 404);  // it was not imported a second time
}

TEST_F(PartsOverHttp, ImportNamesRowAndColumnAndWritesNothing) {
  const std::string csv =
      "id,manufacturer,part_number,internal_volume_ml,mass_kg,body_volume_ml,"
      "pressure_max_kpa_gauge\nok,me,bottle,500,1,600,600\n"
      "bad,me,bottle,500,1 metre,600,600\n"
      "festo-veaa-b-3-d11,me,bottle,500,1,600,600\n";
  const std::string path = "/v1/parts/import?family=reservoir";
  const Json problem = Body(client_->Post(path, csv, "text/csv"));
  EXPECT_EQ(problem["errors"][0]["pointer"], "/3/mass_kg");
  EXPECT_THAT(std::string(problem["errors"][0]["detail"]), HasSubstr("\"1 metre\""));
  std::string taken = csv;
  taken.erase(taken.find("bad,"), taken.find("festo") - taken.find("bad,"));
  for (const char* dry : {"", "&dry_run=true"}) {
    const auto refused = client_->Post(path + dry, taken, "text/csv");
    EXPECT_EQ(refused->status, 422);
    EXPECT_EQ(Body(refused)["errors"][0]["pointer"], "/3/id");
  }
  EXPECT_EQ(client_->Get("/v1/parts/ok")->status, 404);
  EXPECT_EQ(client_->Post(path + "&dry_run=maybe", csv, "text/csv")->status, 422);
}

TEST_F(PartsOverHttp, TablesMayBeLongerThanOtherBodiesAndHaveLimitsOfTheirOwn) {
  const Json limits = Get("/v1/limits")["limits"];
  const std::size_t body = limits["body_bytes_max"], import = limits["import_bytes_max"];
  const std::string path = "/v1/parts/import?family=tubing";
  // Rows that are long and wrong: what is wrong with them says that all of them arrived.
  std::string table = "id,manufacturer,notes\n";
  while (table.size() <= body) table += "No Id,m," + std::string(50'000, 'n') + "\n";
  const auto read = client_->Post(path, table, "text/csv");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->status, 422);
  const Json errors = Body(read)["errors"];
  EXPECT_EQ(errors.size(), 100u);
  EXPECT_EQ(errors[0]["pointer"], "/2/id");
  EXPECT_THAT(std::string(errors[99]["detail"]), HasSubstr("more errors"));

  const auto limit_of = [&](const httplib::Result& result, int status) {
    EXPECT_TRUE(result);
    if (!result) return std::string();
    EXPECT_EQ(result->status, status) << result->body;
    return Body(result)["limit"].value("name", "");
  };
  EXPECT_EQ(limit_of(client_->Post("/v1/parts", table, kJson), 413), "body_bytes_max");
  EXPECT_EQ(limit_of(client_->Post("/v1/parts/imports", table, "text/csv"), 413), "body_bytes_max");
  const std::string rows(limits["import_rows_max"].get<std::size_t>() + 1, '\n');
  EXPECT_EQ(limit_of(client_->Post(path, rows, "text/csv"), 413), "import_rows_max");
  const std::string whole(import + 1, 'x');
  EXPECT_EQ(limit_of(client_->Post(path, whole, "text/csv"), 413), "import_bytes_max");

  // One such table at a time; the next may come when the first is answered or given up.
  const std::string head =
      "POST " + path + " HTTP/1.1\r\nHost: localhost\r\n" +
      "Content-Type: text/csv\r\nContent-Length: " + std::to_string(table.size()) + "\r\n\r\n";
  {
    Raw first(serve_->port());
    first.Send(head);
    // Until the head of the first has been read.
    const auto second = PostUntil(path, table, [](int status) { return status == 429; });
    EXPECT_EQ(limit_of(second, 429), "large_imports_max");
    EXPECT_EQ(client_->Get("/healthz")->status, 200);
  }
  const auto after = PostUntil(path, table, [](int status) { return status != 429; });
  EXPECT_EQ(after->status, 422);
}

TEST_F(PartsOverHttp, HistoryTellsAndUndoTakesBack) {
  const Json before = Get("/v1/parts?limit=1")["catalogue_revision"];
  ASSERT_EQ(Add(NewFitting("f"), {{"From", "ann@example.org"}})->status, 201);
  ASSERT_EQ(
      client_->Put("/v1/parts/f", {{"If-Match", "*"}}, Fitting("f", 0.2).dump(), kJson)->status,
      200);
  const Json history = Get("/v1/parts/f/history")["history"];
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[0]["revision"]["who"], "http");
  EXPECT_EQ(history[0]["before"]["mass_kg"], 0.003);
  EXPECT_EQ(history[0]["after"]["mass_kg"], 0.2);
  EXPECT_EQ(history[1]["revision"]["who"], "ann@example.org");
  EXPECT_EQ(history[1]["revision"]["what"], "add f");
  EXPECT_EQ(history[1]["before"], nullptr);
  const auto number = [&](int i) { return history[i]["revision"]["number"].dump(); };
  EXPECT_EQ(Get("/v1/parts/f?revision=" + number(1))["mass_kg"], 0.003);
  EXPECT_EQ(client_->Get("/v1/parts/f?revision=0")->status, 404);
  EXPECT_EQ(client_->Get("/v1/parts/f?revision=999")->status, 404);
  const Json page = Get("/v1/parts/f/history?limit=1");
  EXPECT_EQ(page["next_cursor"], number(0));
  EXPECT_EQ(Get("/v1/parts/f/history?limit=1&cursor=" + number(0))["history"][0], history[1]);

  const auto undo = [&](const std::string& revision) {
    return client_->Post("/v1/revisions/" + revision + "/undo", "", kJson);
  };
  EXPECT_EQ(undo(number(1))->status, 409);  // f was replaced since
  ASSERT_EQ(undo(number(0))->status, 200);
  EXPECT_EQ(Get("/v1/parts/f")["mass_kg"], 0.003);
  ASSERT_EQ(undo(number(1))->status, 200);  // it is again as it was after that revision
  EXPECT_EQ(client_->Get("/v1/parts/f")->status, 404);
  EXPECT_EQ(Get("/v1/parts/f/history")["history"].size(), 4u);
  EXPECT_EQ(Get("/v1/parts?limit=1")["catalogue_revision"]["hash"], before["hash"]);
  EXPECT_EQ(undo("999")->status, 404);
  EXPECT_EQ(undo("x")->status, 404);
  EXPECT_EQ(client_->Get("/v1/parts/never/history")->status, 404);

  const Json revisions = Get("/v1/revisions?limit=2");
  EXPECT_EQ(revisions["revisions"][0]["what"], "undo " + number(1));
  const Json one = Get("/v1/revisions/" + number(0));
  EXPECT_EQ(one["changes"][0]["id"], "f");
  EXPECT_EQ(one["changes"][0]["before"]["mass_kg"], 0.003);
  EXPECT_EQ(one["next_cursor"], Json());
  EXPECT_EQ(client_->Get("/v1/revisions/999")->status, 404);
}

TEST_F(PartsOverHttp, AnyBytesInAQueryGetAnAnswer) {
  std::mt19937 random(61);
  const std::string good = "family=valve&mass_kg_max=0.1&sort=-mass_kg&limit=3&cursor=";
  for (int i = 0; i < 300; ++i) {
    std::string query = good;
    for (int n = 0; n < 4; ++n) {
      const std::size_t at = random() % query.size();
      switch (random() % 3) {
        case 0:
          query[at] = static_cast<char>(33 + random() % 94);
          break;
        case 1:
          query.insert(at, random() % 2 == 0 ? "%00" : "%ff%");
          break;
        default:
          query.erase(at, 2);
      }
    }
    const auto result = client_->Get("/v1/parts?" + query);
    ASSERT_TRUE(result) << query;
    // 400: a second question mark, which the HTTP library refuses itself.
    EXPECT_THAT(result->status, testing::AnyOf(200, 400, 404, 422)) << query;
    EXPECT_TRUE(Body(result).is_object()) << query;
  }
  EXPECT_EQ(client_->Get("/healthz")->status, 200);
}

TEST_F(PartsOverHttp, ARestoreUnderTheRunningServiceIsSeenAtOnce) {
  ASSERT_EQ(Add(NewFitting("kept"))->status, 201);
  ASSERT_EQ(bench_.Run("catalog backup copy.db").status, 0);
  ASSERT_EQ(Add(NewFitting("later"))->status, 201);
  const Json later = Get("/v1/parts?limit=1")["catalogue_revision"];
  ASSERT_EQ(bench_.Run("catalog restore copy.db").status, 0);
  EXPECT_EQ(client_->Get("/v1/parts/later")->status, 404);
  EXPECT_EQ(client_->Get("/v1/parts/kept")->status, 200);
  ASSERT_EQ(Add(NewFitting("other"))->status, 201);
  const Json now = Get("/v1/parts?family=fitting&limit=1000");
  EXPECT_EQ(now["catalogue_revision"]["number"], later["number"]);
  EXPECT_NE(now["catalogue_revision"]["hash"], later["hash"]);
  std::set<std::string> ids;
  for (const Json& part : now["parts"]) ids.insert(part["id"]);
  EXPECT_TRUE(ids.contains("other") && !ids.contains("later"));
}

}  // namespace parts_test
}  // namespace plenum::server
