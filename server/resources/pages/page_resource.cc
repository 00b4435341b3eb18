#include "server/resources/pages/page_resource.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "api/catalogue/stores.h"
#include "server/resources/pages/page_files.h"

namespace plenum::server {
namespace {

constexpr char kPagePolicy[] =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const PageFile* Find(std::string_view path) {
  const auto files = PageFiles();
  const auto file = std::find_if(files.begin(), files.end(),
                                 [&](const PageFile& other) { return other.path == path; });
  return file == files.end() ? nullptr : &*file;
}

const char* PageContentType(std::string_view path) {
  if (path.ends_with(".html")) return "text/html; charset=utf-8";
  if (path.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (path.ends_with(".css")) return "text/css; charset=utf-8";
  if (path.ends_with(".json")) return "application/json";
  if (path.ends_with(".svg")) return "image/svg+xml";
  return "application/octet-stream";
}

// The bytes are those of the program itself, which all answers share.
Bytes BytesOf(const PageFile& file) {
  static std::mutex mutex;
  static std::map<std::string_view, Bytes> known;
  const std::lock_guard lock(mutex);
  Bytes& bytes = known[file.path];
  if (!bytes) bytes = std::make_shared<const std::string>(file.bytes);
  return bytes;
}

Reply FileReply(const PageFile& file, const char* cache_control) {
  Reply reply{200,
              PageContentType(file.path),
              "",
              {{"Cache-Control", cache_control},
               {"X-Content-Type-Options", "nosniff"},
               {"Referrer-Policy", "no-referrer"},
               {"Content-Security-Policy", kPagePolicy}},
              {}};
  reply.tail = {BytesOf(file)};
  return reply;
}

}  // namespace

Reply GetPage(const Call& call) {
  const PageFile* page = Find("/index.html");
  if (page == nullptr) return ProblemReply(404, "this program was built without its web page");
  Reply reply = FileReply(*page, "no-cache");
  const std::string etag = '"' + catalog::Sha256(page->bytes).substr(0, 32) + '"';
  reply.headers.emplace_back("ETag", etag);
  if (call.header("If-None-Match") == etag) {
    reply.status = 304;
    reply.tail.clear();
  }
  return reply;
}

Reply GetAsset(const Call& call) {
  const PageFile* file = Find("/assets/" + call.argument);
  if (file == nullptr) return ProblemReply(404, "the page has no file " + call.path);
  return FileReply(*file, "public, max-age=31536000, immutable");
}

}  // namespace plenum::server
