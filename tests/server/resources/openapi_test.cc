// The service against its own description: every route, every status.
#include "server/resources/openapi.h"

#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "api/describe/descriptions.h"
#include "catalog/fields/fields.h"
#include "fmu/unit_file.h"
#include "server/call/service_limits.h"
#include "server/resources/schemas/sweep_schemas.h"
#include "tests/server/resources/schema_check.h"
#include "tests/server/service.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace openapi_test {

using api::Json;

constexpr char kJson[] = "application/json", kProblem[] = "application/problem+json";

class Described : public testing::Test {
 protected:
  Described() : client_("127.0.0.1", service_.port()) {
    client_.set_keep_alive(true);
    client_.set_read_timeout(60);
    client_.set_url_encode(false);
    api_ = JsonOf(client_.Get("/openapi.json")->body);
  }

  // Where an installed catalogue will stand.
  static std::filesystem::path Seed() {
    return std::filesystem::path(testing::TempDir()) /
           ("plenum-openapi-" + std::to_string(getpid()) + ".db");
  }

  // One job and no queue.
  static HttpOptions Narrow() {
    HttpOptions options;
    options.jobs.workers = 1;
    options.jobs.queued_max = options.jobs.swept_queued_max = 0;
    options.docs = test::SourceDir() / "web" / "dist";  // any folder with an index.html
    options.seed = Seed();
    return options;
  }

  Json SchemaOf(const std::string& name) const {
    return Resolved(api_["components"]["schemas"][name], api_);
  }

  // Checks an answer against what the operation says of its status; gives its JSON.
  Json Check(const httplib::Result& result, const std::string& method, const std::string& path,
             int status) {
    seen_.insert(method + " " + path + " " + std::to_string(status));
    EXPECT_TRUE(result) << method << " " << path;
    if (!result) return {};
    EXPECT_EQ(result->status, status) << method << " " << path << " " << result->body;
    const Json responses = Resolved(api_["paths"][path][method]["responses"], api_);
    const std::string key = std::to_string(result->status);
    EXPECT_TRUE(responses.contains(key)) << method << " " << path << " says nothing of " << key;
    if (!responses.contains(key)) return {};
    const Json content = responses[key].value("content", Json::object());
    const std::string type = result->get_header_value("Content-Type");
    if (content.empty()) {
      EXPECT_EQ(result->body, "") << path;
      return {};
    }
    const auto found = content.begin().key();
    EXPECT_TRUE(found == "*/*" || type.starts_with(found)) << path << ": " << type;
    if (found != kJson && found != kProblem) return {};
    Json document = JsonOf(result->body);
    EXPECT_EQ(Violations(content.begin().value()["schema"], document), "") << method << path;
    return document;
  }

  Json Get(const std::string& path, const std::string& query, int status,
           const httplib::Headers& headers = {}, const std::string& id = "") {
    return Check(client_.Get(At(path, id) + query, headers), "get", path, status);
  }
  Json Post(const std::string& path, const std::string& body, int status,
            const httplib::Headers& headers = {}, const std::string& query = "",
            const std::string& id = "") {
    return Check(client_.Post(At(path, id) + query, headers, body, kJson), "post", path, status);
  }
  static std::string At(std::string path, const std::string& id) {
    for (const std::string variable : {"{id}", "{path}"})
      if (const auto at = path.find(variable); at != std::string::npos)
        return path.replace(at, variable.size(), id);
    return path;
  }

  // The documents of a part that is there.
  void DocumentsOf(const std::string& part, const std::string& id) {
    const std::string all = part + "/documents", one = all + "/{sha256}";
    const std::string of_part = "/v1/parts/" + id + "/documents";
    const std::string file = of_part + "/" + catalog::Sha256("sheet");
    const auto post = [&](const std::string& at, int status) {
      Check(client_.Post(at, "sheet", "application/pdf"), "post", all, status);
    };
    post(of_part + "?link=sheet.pdf", 201);
    post(of_part + "?link=sheet.pdf", 200);
    post(of_part + "?sha256=0", 422);
    post("/v1/parts/none/documents?link=s", 404);
    Get(all, "", 200, {}, id);
    Get(all, "", 404, {}, "none");
    Get(all, "?revision=x", 422, {}, id);
    const auto get = [&](const std::string& at, const httplib::Headers& headers, int status) {
      Check(client_.Get(at, headers), "get", one, status);
    };
    get(file, {}, 200);
    const auto tag = client_.Get(file)->get_header_value("ETag");
    get(file, {{"If-None-Match", tag}, kClose}, 304);
    get(of_part + "/0", {}, 404);
    get(file + "?revision=x", {}, 422);
    const auto remove = [&](const std::string& at, int status) {
      Check(client_.Delete(at), "delete", one, status);
    };
    remove(file + "?x=1", 422);
    remove(file, 204);
    remove(file, 404);
  }

  Service service_{Narrow()};
  httplib::Client client_;
  Json api_;
  std::set<std::string> seen_;
};

TEST_F(Described, EveryRouteOfTheTable) {
  std::set<std::string> routes, described;
  const Json table = JsonOf(client_.Get("/v1")->body);
  for (const Json& route : table["routes"])
    routes.insert(route["method"].get<std::string>() + " " + route["path"].get<std::string>());
  for (const auto& [path, methods] : api_["paths"].items())
    for (const auto& [method, operation] : methods.items()) {
      std::string upper = method;
      for (char& c : upper) c = static_cast<char>(std::toupper(c));
      described.insert(upper.append(" ").append(path));
    }
  EXPECT_EQ(routes, described);
  EXPECT_EQ(api_["openapi"], "3.1.0");
}

TEST_F(Described, RefusesWhatDoesNotFit) {
  Json wrong = api::ExampleRequirements();
  wrong["duty"]["frequency_hz"] = 101;
  EXPECT_NE(Violations(SchemaOf("Requirements"), wrong), "");
  EXPECT_NE(Violations(SchemaOf("StoredPart"), api::ExamplePart()), "");  // has no origin
}

TEST_F(Described, ItsExamplesAreValidAndTaken) {
  for (const auto& [path, methods] : api_["paths"].items()) {
    if (!methods.contains("post") || !methods["post"].contains("requestBody")) continue;
    const Json content = methods["post"]["requestBody"]["content"];
    if (!content.contains(kJson) || !content[kJson].contains("example")) continue;  // files
    const Json example = content[kJson]["example"];
    EXPECT_EQ(Violations(Resolved(content[kJson]["schema"], api_), example), "") << path;
    const std::string query =
        path == "/v1/designs" || path == "/v1/sweeps" ? "?validate_only=true" : "";
    const auto result = client_.Post(path + query, example.dump(), kJson);
    if (path == "/v1/fmus" && !fmu::MakesUnits()) continue;
    EXPECT_TRUE(result->status < 300 || result->status == 429) << path << result->body;
  }
}

TEST_F(Described, TheProjectsExamplesFit) {
  for (const char* name : {"exosuit", "crawler", "gripper"}) {
    const auto file = test::SourceDir() / "examples" / (std::string(name) + ".json");
    EXPECT_EQ(Violations(SchemaOf("Requirements"), JsonOf(ReadAll(file))), "") << name;
  }
  const auto file = test::SourceDir() / "examples" / "simulation_effects.json";
  EXPECT_EQ(Violations(SchemaOf("Simulation"), JsonOf(ReadAll(file))), "");
}

TEST_F(Described, TheCataloguesPartsFit) {
  const Json schema = SchemaOf("StoredPart");
  for (const catalog::Family& family : catalog::Families()) {
    const Json page =
        JsonOf(client_.Get("/v1/parts?limit=5&family=" + std::string(family.name))->body);
    EXPECT_FALSE(page["parts"].empty()) << family.name;
    for (const Json& part : page["parts"]) {
      EXPECT_EQ(Violations(schema, part), "") << part["id"];
    }
  }
}

TEST_F(Described, EveryStatusOfEveryRoute) {
  const std::string wait = "wait=300";
  for (const auto& [path, example] :
       {std::pair{std::string("/v1/designs"), api::ExampleRequirements()},
        std::pair{std::string("/v1/sweeps"), ExampleSweep()},
        std::pair{std::string("/v1/diagnoses"), api::ExampleMeasurement()}}) {
    Post(path, "{", 400);
    Post(path, "{}", 422);
    Post(path, example.dump(), 429);  // there is no queue
    Get(path, "", 200);
    Get(path + "/{id}", "", 404, {}, "none");
    Check(client_.Delete(path + "/none"), "delete", path + "/{id}", 404);
    if (path == "/v1/sweeps") continue;
    Get(path + "/{id}/events", "", 404, {}, "none");
    Post(path + "/{id}/again", "", 404, {}, "none");
  }
  Get("/v1/sweeps/{id}/table", "", 404, {}, "none");
  Get("/v1/sweeps/{id}/table", "?format=xls", 422, {}, "none");
  // At once.
  for (const auto& [path, example] :
       {std::pair{std::string("/v1/simulations"), api::ExampleSimulation()},
        std::pair{std::string("/v1/evaluations"), api::ExampleEvaluation()},
        std::pair{std::string("/v1/fmus"), api::ExampleEvaluation()},
        std::pair{std::string("/v1/measurements"), api::ExampleRecording()},
        std::pair{std::string("/v1/maps"), api::ExampleMap()}}) {
    const bool made = fmu::MakesUnits() || path != "/v1/fmus";
    Post(path, example.dump(), made ? 200 : 422);
    if (!made) seen_.insert("post " + path + " 200");
    Post(path, "[", 400);
    Post(path, "[]", 422);
  }
  // Parts.
  const std::string part = "/v1/parts/{id}", id = "my-pack";
  Json heavier = api::ExamplePart();
  heavier["mass_kg"] = 0.3;
  Post("/v1/parts", api::ExamplePart().dump(), 201);
  Post("/v1/parts", api::ExamplePart().dump(), 409);
  Post("/v1/parts", "{", 400);
  Post("/v1/parts", "{}", 422);
  Get("/v1/parts", "?limit=3&facets=true", 200);
  Get("/v1/parts", "?limit=0", 422);
  Get("/v1/parts", "?revision=1000000", 404);
  const auto list_tag = client_.Get("/v1/parts?limit=3")->get_header_value("ETag");
  Get("/v1/parts", "?limit=3", 304, {{"If-None-Match", list_tag}, kClose});
  Get(part, "", 200, {}, id);
  Get(part, "", 404, {}, "none");
  Get(part, "?revision=x", 422, {}, id);
  const auto tag = client_.Get("/v1/parts/" + id)->get_header_value("ETag");
  Get(part, "", 304, {{"If-None-Match", tag}, kClose}, id);
  Get(part + "/protocol", "?sampling_hz=20", 200, {}, id);
  Get(part + "/protocol", "", 404, {}, "none");
  Get(part + "/protocol", "?bottle_l=0", 422, {}, id);
  Get(part + "/history", "", 200, {}, id);
  Get(part + "/history", "", 404, {}, "none");
  Get(part + "/history", "?limit=0", 422, {}, id);
  const auto put = [&](const std::string& at, const std::string& body, const std::string& match,
                       int status) {
    const httplib::Headers headers =
        match.empty() ? httplib::Headers{} : httplib::Headers{{"If-Match", match}};
    Check(client_.Put("/v1/parts/" + at, headers, body, kJson), "put", part, status);
  };
  put(id, "{", tag, 400);
  put(id, "{}", tag, 422);
  put(id, heavier.dump(), "", 412);
  Json unknown = heavier;
  unknown["id"] = "none";
  put("none", unknown.dump(), "*", 404);
  put(id, heavier.dump(), tag, 200);
  const auto remove = [&](const std::string& at, const std::string& match, int status) {
    const httplib::Headers headers = {{"If-Match", match}};
    Check(client_.Delete("/v1/parts/" + at, headers), "delete", part, status);
  };
  remove(id, tag, 412);
  remove("none", "*", 404);
  DocumentsOf(part, id);
  remove(id, "*", 204);
  Get("/v1/parts", "?q=valve&priced=true&estimated_share_max=0.5", 200);
  Get("/v1/parts/compare", "?ids=co2-1,co2-1", 422);
  Get("/v1/parts/compare", "?ids=none,none-too", 404);
  const Json two = JsonOf(client_.Get("/v1/parts?limit=2")->body)["parts"];
  const auto id_of = [&](std::size_t i) { return two[i]["id"].get<std::string>(); };
  Get("/v1/parts/compare", "?ids=" + id_of(0) + "," + id_of(1), 200);
  Get("/v1/parts/check", "", 200);
  Get("/v1/parts/check", "?family=battery", 422);
  Get("/v1/parts/export", "?family=battery", 200);
  Get("/v1/parts/export", "", 422);
  const auto csv = client_.Get("/v1/parts/export?family=battery")->body;
  Check(client_.Post("/v1/parts/import?family=battery", csv, "text/csv"), "post",
        "/v1/parts/import", 200);
  Check(client_.Post("/v1/parts/import?family=battery", "x", "text/csv"), "post",
        "/v1/parts/import", 422);
  Get("/v1/revisions", "?limit=2", 200);
  Get("/v1/revisions", "?limit=-2", 422);
  const Json revisions = JsonOf(client_.Get("/v1/revisions?limit=3")->body)["revisions"];
  const auto number = [&](std::size_t i) { return revisions[i]["number"].dump(); };
  Get("/v1/revisions/{id}", "?limit=1", 200, {}, number(0));
  Get("/v1/revisions/{id}", "?limit=0", 422, {}, number(0));
  Get("/v1/revisions/{id}", "", 404, {}, "x");
  const std::string undo = "/v1/revisions/{id}/undo";
  Post(undo, "", 409, {}, "", number(1));  // superseded by the removal
  Post(undo, "", 200, {{"Idempotency-Key", "k"}}, "", number(0));
  Post(undo, "", 422, {{"Idempotency-Key", "k"}}, "", number(1));
  Post(undo, "", 404, {}, "", "1000000");
  const std::string update = "/v1/catalog/update";
  Post(update, "", 404);
  std::filesystem::copy_file(test::SourceDir() / "catalog.db", Seed());
  Post(update, "", 200, {}, "?dry_run=true");
  Post(update, "", 422, {}, "?dry_run=perhaps");
  std::filesystem::remove(Seed());
  // Models.
  const Json model = {{"name", "bench"}, {"model", api::ExampleModel()}};
  Post("/v1/models", model.dump(), 201);
  Post("/v1/models", "", 400);
  Post("/v1/models", "{}", 422);
  Get("/v1/models", "", 200);
  Get("/v1/models/{id}", "", 200, {}, "bench");
  Get("/v1/models/{id}", "", 404, {}, "none");
  // The rest.
  for (const char* path : {"/v1", "/v1/families", "/v1/limits", "/v1/queue", "/healthz", "/metrics",
                           "/openapi.json", "/openapi", "/"})
    Get(path, "", 200);
  Get("/readyz", "", 200);
  const std::filesystem::path catalog = service_.bench().catalog();
  std::filesystem::rename(catalog, catalog.string() + ".away");
  Get("/readyz", "", 503);
  std::filesystem::rename(catalog.string() + ".away", catalog);
  Get("/", "", 304, {{"If-None-Match", client_.Get("/")->get_header_value("ETag")}, kClose});
  const auto page = client_.Get("/")->body;
  const auto at = page.find("/assets/");
  ASSERT_NE(at, std::string::npos);
  Get("/assets/{id}", "", 200, {}, page.substr(at + 8, page.find('"', at) - at - 8));
  Get("/assets/{id}", "", 404, {}, "none");
  Get("/docs", "", 308);
  const std::string docs = "/docs/{path}";
  Get(docs, "", 200, {}, "index.html");
  Get(docs, "", 304, {{"If-None-Match", client_.Get("/docs/")->get_header_value("ETag")}, kClose});
  Get(docs, "", 404, {}, "none.html");

  // With a queue.
  {
    Service open;
    httplib::Client client("127.0.0.1", open.port());
    client.set_read_timeout(320);
    Check(client.Get("/readyz"), "get", "/readyz", 200);
    for (const auto& [path, example] :
         {std::pair{std::string("/v1/designs"), api::ExampleRequirements()},
          std::pair{std::string("/v1/sweeps"), ExampleSweep()},
          std::pair{std::string("/v1/diagnoses"), api::ExampleMeasurement()}}) {
      const Json answer =
          Check(client.Post(path, {{"Prefer", wait}}, example.dump(), kJson), "post", path, 200);
      if (path == "/v1/diagnoses") {
        const Json from = {{"schema", "simulation/1"}, {"from", answer}, {"run", "r1"}};
        Check(client.Post("/v1/simulations", from.dump(), kJson), "post", "/v1/simulations", 200);
      }
      const Json job = Check(client.Post(path, example.dump(), kJson), "post", path, 202);
      const std::string one = path + "/" + job["id"].get<std::string>();
      Check(client.Get(one), "get", path + "/{id}", 200);
      if (path == "/v1/sweeps") Check(client.Get(one + "/table"), "get", path + "/{id}/table", 200);
      Check(client.Delete(one), "delete", path + "/{id}", 200);
      if (path == "/v1/sweeps") continue;
      Check(client.Get(one + "/events"), "get", path + "/{id}/events", 200);
      // A job that is cancelled before it is done can be asked for again, one that is done not.
      const auto again = [&, path = path](const std::string& job_path, int expected) {
        Check(client.Post(job_path + "/again", "", kJson), "post", path + "/{id}/again", expected);
      };
      for (std::string ended = one;;) {
        client.Get(ended + "/events");  // until the job has ended
        const auto etag = client.Get(ended)->get_header_value("ETag");
        Check(client.Get(ended, {{"If-None-Match", etag}, kClose}), "get", path + "/{id}", 304);
        if (JsonOf(client.Get(ended)->body)["status"] == "cancelled") {
          again(ended, 202);
          client.Get(ended + "/events");
          again(ended, 409);
          break;
        }
        ended = client.Post(path, example.dump(), kJson)->get_header_value("Location");
        client.Delete(ended);
      }
    }
  }

  // Too much at a time cannot be brought about by one client; units: results_test.cc.
  std::set<std::string> missing;
  for (const auto& [path, methods] : api_["paths"].items())
    for (const auto& [method, operation] : methods.items())
      for (const auto& [status, response] : operation["responses"].items()) {
        std::string name = method;
        name.append(" ").append(path).append(" ").append(status);
        static const std::set<std::string> kJobs = {"/v1/designs", "/v1/diagnoses", "/v1/sweeps"};
        const bool elsewhere = (status == "429" && !kJobs.contains(path)) || path.ends_with("/fmu");
        if (status != "default" && !elsewhere && !seen_.contains(name)) missing.insert(name);
      }
  EXPECT_EQ(missing, std::set<std::string>());
}

TEST_F(Described, TheDocsLoadNothingFromElsewhere) {
  const auto page = client_.Get("/openapi");
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_TRUE(policy.starts_with("default-src 'none'; connect-src 'self'")) << policy;
  EXPECT_EQ(page->body.find("://"), std::string::npos);
}

}  // namespace openapi_test
}  // namespace plenum::server
