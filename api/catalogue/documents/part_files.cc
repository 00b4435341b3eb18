#include "api/catalogue/documents/part_files.h"

#include <algorithm>
#include <optional>

#include "api/catalogue/part_document.h"

namespace plenum::api {
namespace {

constexpr std::size_t kFileNameBytesMax = 120;

struct NamedType {
  std::string_view end, type;
};
constexpr NamedType kTypes[] = {
    {".pdf", "application/pdf"},
    {".csv", "text/csv"},
    {".tsv", "text/tab-separated-values"},
    {".json", "application/json"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".jpeg", "image/jpeg"},
    {".zip", "application/zip"},
    {".xlsx", "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"},
    {"", kAnyMediaType}};

// Without what an address has behind its path.
std::string_view PathOf(std::string_view link) {
  if (link.find("://") == std::string_view::npos) return link;
  return link.substr(0, link.find_first_of("?#"));
}

char LowerOf(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool EndsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() &&
         std::equal(end.begin(), end.end(), text.end() - static_cast<std::ptrdiff_t>(end.size()),
                    [](char a, char b) { return a == LowerOf(b); });
}

}  // namespace

const std::vector<std::string_view>& DocumentTypes() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names;
    for (const NamedType& one : kTypes)
      if (std::find(names.begin(), names.end(), one.type) == names.end()) names.push_back(one.type);
    return names;
  }();
  return kNames;
}

std::string MediaTypeOf(const std::string& link) {
  const std::string_view path = PathOf(link);
  return std::string(std::find_if(std::begin(kTypes), std::end(kTypes), [&](const NamedType& one) {
                       return EndsWith(path, one.end);
                     })->type);
}

std::string FileNameOf(const catalog::Document& document) {
  std::string_view word = PathOf(document.link);
  word = word.substr(word.find_last_of("/\\") + 1);
  std::string name;
  for (const char c : word)
    name += static_cast<unsigned char>(c) < 0x20 ||
                    std::string_view("\"*:<>?|\x7F").find(c) != std::string_view::npos
                ? '_'
                : c;
  if (name.size() > kFileNameBytesMax || name.find_first_not_of(". ") == std::string::npos)
    return document.sha256;
  return name;
}

Json RenderDocument(const catalog::Store& store, const std::string& id,
                    const catalog::Document& document) {
  const auto file =
      document.sha256.empty() ? std::nullopt : catalog::DocumentFiles::Find(store, document.sha256);
  Json rendered = {{"link", document.link}, {"sha256", document.sha256}, {"file", nullptr}};
  if (file)
    rendered["file"] = {{"media_type", file->media_type},
                        {"bytes", file->bytes},
                        {"href", "/v1/parts/" + id + "/documents/" + file->sha256}};
  return rendered;
}

Json RenderDocuments(const catalog::Store& store, const catalog::Part& part,
                     const catalog::Revision& revision) {
  Json list = Json::array();
  for (const catalog::Document& document : part.documents)
    list.push_back(RenderDocument(store, part.id, document));
  return {{"id", part.id},
          {"documents", std::move(list)},
          {"catalogue_revision", RenderRevisionName(revision)}};
}

}  // namespace plenum::api
