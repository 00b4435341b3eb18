// /v1/parts/{id}/documents of the real service.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <memory>
#include <random>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace documents_resource_test {

using api::Json;
using testing::HasSubstr;

constexpr char kAny[] = "application/octet-stream", kPdf[] = "application/pdf";

std::string AnyBytes(std::size_t size) {
  std::mt19937 random(34);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

class DocumentsOverHttp : public testing::Test {
 protected:
  DocumentsOverHttp() {
    Start();
    client_->Post("/v1/parts", NewFitting("f").dump(), "application/json");
  }
  // A new process on the same catalogue; the old one, if any, is killed.
  void Start() {
    serve_.reset();
    serve_ = std::make_unique<ServeProcess>(bench_.catalog());
    client_ = std::make_unique<httplib::Client>("127.0.0.1", serve_->port());
    client_->set_tcp_nodelay(true);
    client_->set_read_timeout(60);
  }
  static Json Body(const httplib::Result& result) {
    auto parsed = api::ParseJson(result ? result->body : "");
    return std::holds_alternative<Json>(parsed) ? std::get<Json>(parsed) : Json();
  }
  Json Get(const std::string& path) { return Body(client_->Get(path)); }
  httplib::Result Add(const std::string& bytes, const std::string& query = "link=sheet.pdf",
                      const char* type = kAny) {
    return client_->Post("/v1/parts/f/documents?" + query, bytes, type);
  }
  static std::string PathOf(const std::string& bytes) {
    return "/v1/parts/f/documents/" + catalog::Sha256(bytes);
  }
  static void ExpectRefused(const httplib::Result& result, int status, const std::string& why) {
    ASSERT_TRUE(result);
    EXPECT_EQ(result->status, status) << result->body;
    EXPECT_THAT(result->body, HasSubstr(why));
  }

  const Workbench bench_;
  std::unique_ptr<ServeProcess> serve_;
  std::unique_ptr<httplib::Client> client_;
};

TEST_F(DocumentsOverHttp, AFileComesBackByteForByteAlsoFromANewProcess) {
  const std::string bytes = AnyBytes(700'001), path = PathOf(bytes);
  const auto added = Add(bytes, "link=https%3A%2F%2Fexample.org%2Fbl%C3%A4tter%2Fv%20114.pdf%3Fa");
  ASSERT_EQ(added->status, 201) << added->body;
  EXPECT_EQ(added->get_header_value("Location"), path);
  const Json document = Body(added);
  EXPECT_EQ(document["link"], "https://example.org/blätter/v 114.pdf?a");
  EXPECT_EQ(document["sha256"], catalog::Sha256(bytes));
  EXPECT_EQ(document["file"], Json({{"media_type", kPdf}, {"bytes", 700'001}, {"href", path}}));
  Start();
  const auto got = client_->Get(path);
  ASSERT_EQ(got->status, 200);
  EXPECT_TRUE(got->body == bytes);
  EXPECT_EQ(got->get_header_value("Content-Type"), kPdf);
  EXPECT_EQ(got->get_header_value("ETag"), "\"" + catalog::Sha256(bytes) + "\"");
  // The client has decoded what stands there as UTF-8''v%20114.pdf.
  EXPECT_EQ(got->get_header_value("Content-Disposition"),
            "attachment; filename=\"v 114.pdf\"; filename*=UTF-8''v 114.pdf");
  EXPECT_EQ(got->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(got->get_header_value("Content-Security-Policy"), "default-src 'none'; sandbox");
  const auto known = client_->Get(path, {{"If-None-Match", got->get_header_value("ETag")}});
  EXPECT_EQ(known->status, 304);
  EXPECT_EQ(known->body, "");
  EXPECT_EQ(client_->Head(path)->get_header_value("Content-Length"), "700001");
  Json listed = document;
  listed.erase("catalogue_revision");
  EXPECT_EQ(Get("/v1/parts/f/documents")["documents"], Json::array({listed}));
  EXPECT_EQ(Get("/v1/parts/f")["documents"][0]["sha256"], catalog::Sha256(bytes));
}

TEST_F(DocumentsOverHttp, TheSameFileAgainChangesNothing) {
  ASSERT_EQ(Add("sheet")->status, 201);
  const Json head = Get("/v1/parts?limit=1")["catalogue_revision"];
  EXPECT_EQ(Add("sheet", "link=other.pdf")->status, 200);
  EXPECT_EQ(Get("/v1/parts?limit=1")["catalogue_revision"], head);
  EXPECT_EQ(Get("/v1/parts/f/documents")["documents"].size(), 1u);
}

TEST_F(DocumentsOverHttp, OlderRevisionsKeepTheirFiles) {
  const auto number = Body(Add("sheet"))["catalogue_revision"]["number"].dump();
  EXPECT_EQ(client_->Delete(PathOf("sheet"))->status, 204);
  EXPECT_EQ(client_->Delete(PathOf("sheet"))->status, 404);
  EXPECT_EQ(client_->Get(PathOf("sheet"))->status, 404);
  EXPECT_EQ(client_->Get(PathOf("sheet") + "?revision=" + number)->body, "sheet");
  EXPECT_EQ(Get("/v1/parts/f/documents?revision=" + number)["documents"].size(), 1u);
  EXPECT_EQ(Get("/v1/parts/f/history")["history"][0]["revision"]["what"], "remove a document of f");
  EXPECT_EQ(client_->Get("/v1/parts/f/documents?revision=99999")->status, 404);
}

TEST_F(DocumentsOverHttp, AnotherFileThanSaidIsRefused) {
  const std::string other = catalog::Sha256("other");
  ExpectRefused(Add("sheet", "link=s.pdf&sha256=" + other), 422, "must be that of the file");
  ASSERT_EQ(Add("sheet", "link=s.pdf&sha256=" + catalog::Sha256("sheet"))->status, 201);
  ExpectRefused(Add("more", ""), 422, "/link");
  ExpectRefused(Add("", "link=s.pdf"), 422, "must have 1 to 20971520 bytes");
  ExpectRefused(Add("more", "link=s.pdf&name=x"), 422, "/name");
  ExpectRefused(client_->Post("/v1/parts/g/documents?link=s", "more", kAny), 404, "no part");
  ExpectRefused(client_->Get("/v1/parts/g/documents"), 404, "no part");
  ExpectRefused(client_->Get("/v1/parts/f/documents/abc"), 404, "no document");
}

// What a browser would run in the name of the service, or any page may send unasked.
TEST_F(DocumentsOverHttp, PagesAndFormsAreNoDocuments) {
  for (const char* type : {"text/html", "image/svg+xml", "text/plain", "application/xhtml+xml",
                           "application/x-www-form-urlencoded"})
    ExpectRefused(Add("<script>", "link=s", type), 415, "Content-Type");
  ASSERT_EQ(Add("<script>", "link=page.html")->status, 201);
  EXPECT_EQ(client_->Get(PathOf("<script>"))->get_header_value("Content-Type"), kAny);
}

TEST_F(DocumentsOverHttp, AReferenceWithoutItsFileSaysSo) {
  Json part = NewFitting("f");
  part["documents"] = Json::array({{{"link", "run.csv"}, {"sha256", catalog::Sha256("run")}}});
  client_->Put("/v1/parts/f", {{"If-Match", "*"}}, part.dump(), "application/json");
  EXPECT_EQ(Get("/v1/parts/f/documents")["documents"][0]["file"], nullptr);
  ExpectRefused(client_->Get(PathOf("run")), 404, "is not kept");
  EXPECT_EQ(Add("run", "", "text/csv")->status, 201);
  EXPECT_EQ(client_->Get(PathOf("run"))->body, "run");
}

TEST_F(DocumentsOverHttp, TheLargestFileIsTakenAndALargerOneNamesTheLimit) {
  const Json limits = Get("/v1/limits")["limits"];
  ASSERT_EQ(limits["document_bytes_max"], 20 << 20);
  std::string bytes = AnyBytes(20 << 20);
  ASSERT_EQ(Add(bytes)->status, 201);
  EXPECT_TRUE(client_->Get(PathOf(bytes))->body == bytes);
  bytes += 'x';
  const auto refused = Add(bytes);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 413);
  EXPECT_EQ(Body(refused)["limit"], Json({{"name", "document_bytes_max"}, {"value", 20 << 20}}));
}

}  // namespace documents_resource_test
}  // namespace plenum::server
