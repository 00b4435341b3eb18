#include "server/commands/documents/command_documents.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/catalogue/documents/part_files.h"
#include "api/catalogue/stores.h"
#include "server/call/reply.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"
#include "server/render/text/text_table.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

namespace fs = std::filesystem;
using catalog::Access;
using catalog::DocumentFiles;
using catalog::WriteStatus;

constexpr std::size_t kHashShown = 12;  // characters, which tell documents of a part apart

struct DocumentOptions {
  std::string catalog = catalog::DefaultCatalog();
  std::string id, file, link, hash;
  std::optional<std::int64_t> revision;
  bool json = false;
};

struct PartThen {
  catalog::Part part;
  catalog::Revision revision;
};

PartThen FindPart(const catalog::Store& store, const DocumentOptions& options) {
  const auto revision = options.revision ? store.FindRevision(*options.revision) : store.Head();
  if (!revision)
    throw BadInput("revision: the catalogue has no revision " + std::to_string(*options.revision));
  auto part = store.GetAt(options.id, revision->number);
  if (!part) throw BadInput("ID: no part has the id " + options.id);
  return {*std::move(part), *revision};
}

// The one document whose hash begins so.
catalog::Document FindHash(const catalog::Part& part, const std::string& begin) {
  std::vector<catalog::Document> found;
  for (const catalog::Document& one : part.documents)
    if (!one.sha256.empty() && one.sha256.starts_with(begin)) found.push_back(one);
  if (found.empty())
    throw BadInput("SHA256: " + part.id + " has no document whose hash begins with " + begin +
                   "; plenum catalog document list " + part.id + " lists them");
  for (const catalog::Document& one : found)
    if (one.sha256 != found.front().sha256)
      throw BadInput("SHA256: several documents have hashes that begin with " + begin +
                     "; give more of it");
  return found.front();
}

void ListDocumentsOf(const DocumentOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto [part, revision] = FindPart(store, options);
  const api::Json list = api::RenderDocuments(store, part, revision);
  if (options.json) return Print(Dump(list) + "\n");
  using enum Table::Align;
  Table table({{"link", kLeft}, {"bytes"}, {"type", kLeft}, {"sha256", kLeft}});
  for (const api::Json& one : list.at("documents")) {
    const api::Json& file = one.at("file");
    const bool kept = file.is_object();
    const std::string hash = one.at("sha256").get<std::string>().substr(0, kHashShown);
    table.Add({one.at("link").get<std::string>(), kept ? Grouped(file.at("bytes")) : "not kept",
               kept ? file.at("media_type").get<std::string>() : "–", hash.empty() ? "–" : hash});
  }
  Print(part.documents.empty() ? part.id + " has no documents\n" : table.Text());
}

void AddDocumentTo(const DocumentOptions& options) {
  std::error_code unknown;  // as for standard input
  if (const auto bytes = fs::file_size(options.file, unknown);
      !unknown && bytes > catalog::kFileBytesMax)
    throw BadInput("FILE: must have 1 to " + std::to_string(catalog::kFileBytesMax) +
                   " bytes, has " + std::to_string(bytes));
  const std::string content = ReadText(options.file);
  std::string link = options.link;
  if (link.empty() && options.file != "-") link = fs::path(options.file).filename().string();
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  const auto written = DocumentFiles::Add(
      store, options.id, {link, api::MediaTypeOf(link), content, options.hash}, CommandSignature());
  if (written.status == WriteStatus::kNotFound)
    throw BadInput("ID: no part has the id " + options.id);
  if (written.status != WriteStatus::kDone) Refuse(FieldErrors(written.errors));
  Print("added " + (link.empty() ? options.file : link) + " to " + options.id + ", sha256 " +
        catalog::Sha256(content) + "\n");
}

void GetDocumentOf(const DocumentOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto [part, revision] = FindPart(store, options);
  const catalog::Document document = FindHash(part, options.hash);
  const auto content = DocumentFiles::Content(store, document.sha256);
  if (!content)
    throw BadInput("SHA256: the file is not kept; plenum catalog document add " + part.id +
                   " FILE keeps it");
  if (options.file == "-") {
    std::fwrite(content->data(), 1, content->size(), stdout);
    return;
  }
  const std::string name = options.file.empty() ? api::FileNameOf(document) : options.file;
  if (fs::exists(name)) throw BadInput(name + ": is there already; --out names another file");
  std::ofstream file(name, std::ios::binary);
  file << *content;
  if (!file.flush()) throw BadInput(name + ": cannot be written");
  Print(name + ": " + std::to_string(content->size()) + " bytes, sha256 " + document.sha256 + "\n");
}

void RemoveDocumentOf(const DocumentOptions& options) {
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  const catalog::Document document = FindHash(FindPart(store, options).part, options.hash);
  const auto written =
      DocumentFiles::Remove(store, options.id, document.sha256, CommandSignature());
  if (written.status != WriteStatus::kDone) throw BadInput("the part was changed meanwhile");
  Print("removed " + document.link + " from " + options.id + "; plenum catalog undo " +
        std::to_string(written.revision.number) + " brings it back\n");
}

using DocumentTable = std::vector<Option>;

Command One(const char* name, const char* help, const char* example,
            void (*run)(const DocumentOptions&),
            const std::function<DocumentTable(DocumentOptions&)>& table) {
  auto options = std::make_shared<DocumentOptions>();
  DocumentTable all = table(*options);
  all.insert(all.begin(), CatalogOption(options->catalog));
  return {name, help, example, std::move(all), [options, run] {
            run(*options);
            return kAnswered;
          }};
}

Option PartOption(DocumentOptions& options) { return Argument("ID", "The part's id", &options.id); }
Option HashOption(DocumentOptions& options) {
  return Argument("SHA256", "Its hash, or the beginning of it, see list", &options.hash);
}
Option ThenOption(DocumentOptions& options) {
  return {"--revision", "As the part was in this revision", &options.revision, {.value_name = "N"}};
}

}  // namespace

Command DocumentCommand() {
  const auto list = [](DocumentOptions& options) -> DocumentTable {
    return {PartOption(options), ThenOption(options), JsonFlag(options.json)};
  };
  const auto add = [](DocumentOptions& options) -> DocumentTable {
    return {PartOption(options),
            Argument("FILE", "At most 20 MiB; - is standard input", &options.file),
            {"--link",
             "Where it was found; without it the file's name",
             &options.link,
             {.value_name = "LINK"}},
            {"--sha256",
             "What it must have; another file is refused",
             &options.hash,
             {.value_name = "HASH"}}};
  };
  const auto get = [](DocumentOptions& options) -> DocumentTable {
    return {PartOption(options),
            HashOption(options),
            {"--out",
             "Where to write it; without it its name, in this folder; - is standard output",
             &options.file,
             {.value_name = "FILE"}},
            ThenOption(options)};
  };
  const auto remove = [](DocumentOptions& options) -> DocumentTable {
    return {PartOption(options), HashOption(options)};
  };
  return {"document",
          "Data sheets and recordings of a part, with their files",
          "plenum catalog document list smc-vq110u-5m-m5",
          {},
          {},
          {One("list", "The documents of a part, and which files are kept",
               "plenum catalog document list smc-vq110u-5m-m5", ListDocumentsOf, list),
           One("add", "Adds a document and keeps its file",
               "plenum catalog document add smc-vq110u-5m-m5 examples/bottle_test_simulated.csv",
               AddDocumentTo, add),
           One("get", "Writes the file of a document",
               "plenum catalog document get smc-vq110u-5m-m5 6cfc9a8f4cf7", GetDocumentOf, get),
           One("remove", "Takes a document off a part; its file stays for older revisions",
               "plenum catalog document remove smc-vq110u-5m-m5 6cfc9a8f4cf7", RemoveDocumentOf,
               remove)}};
}

}  // namespace plenum::server
