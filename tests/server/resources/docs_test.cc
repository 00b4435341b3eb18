// The documentation below /docs/: the files of one folder and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <filesystem>
#include <string>

#include "server/resources/pages/docs_resource.h"
#include "tests/server/service.h"

namespace plenum::server {
namespace docs_test {

using testing::HasSubstr;
using testing::StartsWith;

constexpr char kSecret[] = "not for readers";

class Docs : public testing::Test {
 protected:
  Docs() : service_(WithDocs()), client_("127.0.0.1", service_.port()) {
    client_.set_url_encode(false);
  }

  HttpOptions WithDocs() {
    std::filesystem::create_directories(bench_.Path("docs/guide"));
    bench_.Write("docs/index.html", "<title>docs</title>");
    bench_.Write("docs/guide/index.html", "<title>guide</title>");
    bench_.Write("docs/guide/look.css", "p { }");
    bench_.Write("docs/search.js", "find()");
    bench_.Write("docs/picture.svg", "<svg/>");
    bench_.Write("docs/.hidden", kSecret);
    bench_.Write("secret.html", kSecret);
    std::filesystem::create_symlink(bench_.Path("secret.html"), bench_.Path("docs/link.html"));
    HttpOptions options;
    options.docs = bench_.Path("docs");
    return options;
  }

  const Workbench bench_;
  Service service_;
  httplib::Client client_;
};

TEST_F(Docs, AreTheFilesOfTheFolderWithTheirTypes) {
  for (const auto& [path, type, text] :
       {std::tuple("/docs/", "text/html; charset=utf-8", "<title>docs</title>"),
        std::tuple("/docs/index.html", "text/html; charset=utf-8", "<title>docs</title>"),
        std::tuple("/docs/guide/", "text/html; charset=utf-8", "<title>guide</title>"),
        std::tuple("/docs/guide/look.css", "text/css; charset=utf-8", "p { }"),
        std::tuple("/docs/search.js?q=x", "text/javascript; charset=utf-8", "find()"),
        std::tuple("/docs/picture.svg", "image/svg+xml", "<svg/>")}) {
    const auto file = client_.Get(path);
    EXPECT_EQ(file->status, 200) << path;
    EXPECT_EQ(file->get_header_value("Content-Type"), type) << path;
    EXPECT_EQ(file->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(file->body, text) << path;
  }
}

TEST_F(Docs, RunOnlyScriptsOfTheirOwnAndAskNobodyElse) {
  const auto page = client_.Get("/docs/");
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_THAT(policy, StartsWith("default-src 'none'; script-src 'self';"));
  EXPECT_THAT(policy, HasSubstr("connect-src 'self'"));
}

TEST_F(Docs, AreNotSentTwiceAndAnewOnceTheyAreBuiltAnew) {
  const std::string etag = client_.Get("/docs/")->get_header_value("ETag");
  ASSERT_FALSE(etag.empty());
  const auto again = client_.Get("/docs/", {{"If-None-Match", etag}});
  EXPECT_EQ(again->status, 304);
  EXPECT_EQ(again->body, "");
  bench_.Write("docs/index.html", "<title>new</title>");
  const auto changed = client_.Get("/docs/", {{"If-None-Match", etag}});
  EXPECT_EQ(changed->status, 200);
  EXPECT_EQ(changed->body, "<title>new</title>");
}

TEST_F(Docs, LeadOutOfTheirFolderOnNoPath) {
  const std::string file = bench_.Path("secret.html");
  for (const std::string& path :
       {std::string("/docs/../secret.html"), std::string("/docs/..%2Fsecret.html"),
        std::string("/docs/%2e%2e/secret.html"), std::string("/docs/guide/../../secret.html"),
        std::string("/docs/guide/%2E%2E%2F%2E%2E%2Fsecret.html"), "/docs/" + file, "/docs//" + file,
        std::string("/docs/link.html"), std::string("/docs/.hidden"),
        std::string("/docs/./index.html"), std::string("/docs/guide//look.css"),
        std::string("/docs/..%5Csecret.html"), std::string("/docs/index.html%00.css"),
        std::string("/docs/guide"), std::string("/docs/none.html")}) {
    const auto refused = client_.Get(path);
    ASSERT_TRUE(refused) << path;
    EXPECT_GE(refused->status, 400) << path;
    EXPECT_LT(refused->status, 500) << path;
    EXPECT_EQ(refused->body.find(kSecret), std::string::npos) << path;
  }
}

TEST_F(Docs, AreFoundWithoutTheLastStroke) {
  const auto moved = client_.Get("/docs");
  EXPECT_EQ(moved->status, 308);
  EXPECT_EQ(moved->get_header_value("Location"), "/docs/");
}

TEST(NoDocs, SayHowToGetThem) {
  Service service;
  const auto missing = httplib::Client("127.0.0.1", service.port()).Get("/docs/");
  EXPECT_EQ(missing->status, 404);
  EXPECT_THAT(missing->body, HasSubstr("docs/build.sh"));
  const Workbench bench;
  const auto named = bench.Run("serve --docs nowhere");
  EXPECT_EQ(named.status, 2);
  EXPECT_THAT(named.err, HasSubstr("nowhere has no index.html"));
}

}  // namespace docs_test
}  // namespace plenum::server
