#include "server/resources/pages/docs_resource.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "server/call/entity_tag.h"

namespace plenum::server {
namespace {

namespace fs = std::filesystem;

constexpr char kFirstPage[] = "index.html";
// The theme sets colours by styles in its pages; scripts stand in files of their own
// (docs/conf.py).
constexpr char kDocsPolicy[] =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' "
    "data:; font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'self'; "
    "frame-ancestors 'none'";

constexpr std::pair<std::string_view, const char*> kTypes[] = {
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".txt", "text/plain; charset=utf-8"},
    {".csv", "text/csv; charset=utf-8"},
    {".ipynb", "application/x-ipynb+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"}};

const char* DocsContentType(std::string_view path) {
  const auto* type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                  [&](const auto& one) { return path.ends_with(one.first); });
  return type == std::end(kTypes) ? "application/octet-stream" : type->second;
}

// Of a name in a path: neither empty nor hidden, "." and ".." among these, and of one name only.
bool IsName(std::string_view name) {
  return !name.empty() && name.front() != '.' &&
         name.find_first_of(std::string_view("\\:\0", 3)) == std::string_view::npos;
}

bool IsPath(std::string_view path) {
  for (;;) {
    const auto end = path.find('/');
    if (!IsName(path.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    path.remove_prefix(end + 1);
  }
}

// The file in full, links resolved; nothing where it is none or lies outside of the folder.
std::optional<fs::path> Find(const fs::path& folder, std::string path) {
  if (path.empty() || path.ends_with('/')) path += kFirstPage;
  if (!IsPath(path)) return std::nullopt;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return std::nullopt;
  const fs::path file = fs::canonical(root / path, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  const auto differs = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return differs.first == root.end() ? std::optional(file) : std::nullopt;
}

std::optional<std::string> ReadFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return in ? std::optional(std::move(bytes)) : std::nullopt;
}

fs::path Program() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

Reply Missing(const fs::path& folder, const Call& call) {
  std::error_code ignored;
  if (fs::exists(folder / kFirstPage, ignored))
    return ProblemReply(404,
                        "the documentation has no page " + call.path + "; it begins at /docs/");
  return ProblemReply(404,
                      "there is no documentation beside this program: docs/build.sh builds it in a "
                      "checkout, the package plenum brings it, plenum serve --docs DIR names it");
}

}  // namespace

fs::path DocsFolder() {
  const fs::path above = Program().parent_path().parent_path();
  if (above.filename() == "build") return above / "docs" / "html";
  std::error_code ignored;
  const fs::path beside = above / "share" / "plenum" / "docs";
  return fs::exists(beside, ignored) ? beside : fs::path("/usr/share/plenum/docs");
}

Reply GetDocs(const fs::path& folder, const Call& call) {
  const auto file = Find(folder, call.argument);
  auto bytes = file ? ReadFile(*file) : std::nullopt;
  if (!bytes) return Missing(folder, call);
  const std::string etag = ETag(*bytes);
  const bool known = IsKnown(call, etag);
  return {known ? 304 : 200,
          DocsContentType(file->native()),
          known ? std::string() : *std::move(bytes),
          {{"ETag", etag},
           {"Cache-Control", "no-cache"},
           {"X-Content-Type-Options", "nosniff"},
           {"Referrer-Policy", "no-referrer"},
           {"Content-Security-Policy", kDocsPolicy}},
          {}};
}

Reply RedirectToDocs(const Call&) {
  return {308, "text/plain; charset=utf-8", "", {{"Location", "/docs/"}}, {}};
}

}  // namespace plenum::server
