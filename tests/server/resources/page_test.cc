// The web page as the service gives it, compared with the files of web/dist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <filesystem>
#include <memory>
#include <regex>
#include <thread>

#include "server/http.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace page_test {

using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kDist = test::SourceDir() / "web" / "dist";

class Page : public testing::Test {
 protected:
  Page() {
    HttpOptions options;
    options.catalog = bench_.catalog();
    options.port = 0;
    service_ = std::make_unique<HttpService>(options);
    thread_ = std::thread([this] { service_->Run(); });
    client_ = std::make_unique<httplib::Client>("127.0.0.1", service_->port());
  }
  ~Page() override {
    client_.reset();
    service_->Stop();
    thread_.join();
  }

  const Workbench bench_;
  std::unique_ptr<HttpService> service_;
  std::thread thread_;
  std::unique_ptr<httplib::Client> client_;
};

TEST_F(Page, IsServedAtTheTopAndMayOnlyTalkToItsService) {
  const auto page = client_->Get("/");
  ASSERT_EQ(page->status, 200);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page->get_header_value("Cache-Control"), "no-cache");
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_THAT(policy, StartsWith("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("connect-src 'self'"));
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(page->body, ReadAll(kDist / "index.html"));
}

TEST_F(Page, IsNotSentTwice) {
  const std::string etag = client_->Get("/")->get_header_value("ETag");
  ASSERT_FALSE(etag.empty());
  const auto again = client_->Get("/", {{"If-None-Match", etag}});
  EXPECT_EQ(again->status, 304);
  EXPECT_EQ(again->body, "");
  EXPECT_EQ(client_->Get("/", {{"If-None-Match", "\"other\""}})->status, 200);
}

TEST_F(Page, FilesThatItNamesAreServedForeverAndByteForByte) {
  const std::string page = ReadAll(kDist / "index.html");
  const std::regex name(R"re((?:src|href)="(/[^"]+)")re");
  int files = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), name), end; it != end; ++it, ++files) {
    const std::string path = (*it)[1];
    const auto file = client_->Get(path);
    ASSERT_EQ(file->status, 200) << path;
    EXPECT_EQ(file->get_header_value("Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(file->body, ReadAll(kDist / path.substr(1))) << path;
    const std::string type = file->get_header_value("Content-Type");
    if (path.ends_with(".js")) {
      EXPECT_EQ(type, "text/javascript; charset=utf-8");
    }
    if (path.ends_with(".css")) {
      EXPECT_EQ(type, "text/css; charset=utf-8");
    }
    if (path.ends_with(".svg")) {
      EXPECT_EQ(type, "image/svg+xml");
    }
  }
  EXPECT_GE(files, 3);
}

TEST_F(Page, HasNoOtherFiles) {
  for (const char* path : {"/assets/none.js", "/assets/..%2Findex.html", "/index.html"}) {
    const auto missing = client_->Get(path);
    EXPECT_EQ(missing->status, 404) << path;
    EXPECT_EQ(missing->get_header_value("Content-Type"), "application/problem+json");
  }
}

}  // namespace page_test
}  // namespace plenum::server
