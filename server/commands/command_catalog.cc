#include <algorithm>
#include <cstdio>
#include <memory>

#include "api/catalogue/part_document.h"
#include "api/catalogue/part_query.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/call/reply.h"
#include "server/commands/catalog_keeping.h"
#include "server/commands/command_options.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/input.h"
#include "server/render/text_catalog.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

using catalog::Access;
using catalog::WriteStatus;

using Options = std::shared_ptr<CatalogOptions>;

void CheckFamily(const std::string& family) {
  if (catalog::FindFamily(family) == nullptr) {
    throw BadInput("family: must be one of " + FamilyNames() + ", not \"" + family + "\"");
  }
}

// The revision that --revision names, or the newest.
catalog::Revision RevisionOrHead(const catalog::Store& store,
                                 const std::optional<std::int64_t>& number) {
  if (!number) return store.Head();
  const auto revision = store.FindRevision(*number);
  if (!revision) {
    throw BadInput("revision: the catalogue has no revision " + std::to_string(*number));
  }
  return *revision;
}

api::PartQuery ListQuery(const CatalogOptions& options) {
  std::multimap<std::string, std::string> query;
  if (!options.family.empty()) query.emplace("family", options.family);
  if (!options.sort.empty()) query.emplace("sort", options.sort);
  for (const auto& filter : options.filters) {
    const auto equals = filter.find('=');
    if (equals == std::string::npos) {
      throw BadInput("--where: must be FIELD=VALUE, FIELD_min=VALUE or FIELD_max=VALUE, not \"" +
                     filter + "\"");
    }
    query.emplace(filter.substr(0, equals), filter.substr(equals + 1));
  }
  const auto parsed = ValueOrRefuse(api::ParsePartQuery(query));
  for (const char* of_pages : {"limit", "cursor", "facets", "revision"}) {
    if (query.count(of_pages) > 0) {
      throw BadInput(std::string("--where: ") + of_pages + " is not a field");
    }
  }
  return parsed;
}

void List(const CatalogOptions& options) {
  if (!options.family.empty()) CheckFamily(options.family);
  if (options.csv && options.family.empty()) {
    throw BadInput("--csv: needs a family, one of " + FamilyNames());
  }
  const auto query = ListQuery(options);
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto revision = RevisionOrHead(store, options.revision);
  const auto all = store.ListAt(revision.number);
  std::vector<catalog::Part> parts;
  for (const auto* part : api::Select(query, api::PartTable(all))) parts.push_back(*part);
  if (options.csv) return Print(catalog::WriteCsv(options.family, parts));
  if (!options.json) return Print(PartsText(parts));
  api::Json list = api::Json::array();
  for (const auto& part : parts) list.push_back(api::RenderPart(part));
  Print(Dump({{"parts", list}, {"catalogue_revision", api::RenderRevisionName(revision)}}) + "\n");
}

void Show(const CatalogOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto revision = RevisionOrHead(store, options.revision);
  const auto part = store.GetAt(options.id, revision.number);
  if (!part) {
    throw BadInput("ID: no part has the id " + options.id +
                   (options.revision ? " in revision " + std::to_string(revision.number) : ""));
  }
  Print(options.json ? Dump(api::RenderPart(*part), 2) + "\n" : PartText(*part));
}

void Add(const CatalogOptions& options) {
  const auto part = ValueOrRefuse(api::ParsePart(ReadJson(options.file)));
  const auto written = OpenCatalog(options.catalog, Access::kWrite).Add(part, CommandSignature());
  if (written.status == WriteStatus::kExists) {
    throw BadInput("/id: " + part.id + " is taken; choose another id or remove that part first");
  }
  if (written.status == WriteStatus::kInvalid) Refuse(FieldErrors(written.errors));
  Print("added " + part.id + "\n");
}

void Remove(const CatalogOptions& options) {
  const auto written =
      OpenCatalog(options.catalog, Access::kWrite).Remove(options.id, CommandSignature());
  if (written.status == WriteStatus::kNotFound) {
    throw BadInput("ID: no part has the id " + options.id);
  }
  Print("removed " + options.id + "\n");
}

void Import(const CatalogOptions& options) {
  const auto text = ReadText(options.file);
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  if (const auto wrong = CheckCsv(options.family, text); !wrong.empty()) Refuse(wrong);
  const auto result = ImportCsv(store, options.family, text, options.dry_run, CommandSignature());
  if (!result.errors.empty()) Refuse(result.errors);
  if (options.json) return Print(Dump(ToJson(result, options.dry_run)) + "\n");
  const auto& plan = result.plan;
  Print((options.dry_run ? "would add " : "added ") + std::to_string(plan.added.size()) +
        ", replace " + std::to_string(plan.replaced.size()) + ", leave " +
        std::to_string(plan.unchanged.size()) + " unchanged\n");
}

void Export(const CatalogOptions& options) {
  CheckFamily(options.family);
  const auto parts = OpenCatalog(options.catalog, Access::kRead).List(options.family);
  Print(catalog::WriteCsv(options.family, parts));
}

class CatalogCommands {
 public:
  CatalogCommands(CLI::App& app, int& status)
      : group_(*app.add_subcommand("catalog", "The parts catalogue")), status_(status) {
    group_.require_subcommand(1);
  }

  CLI::App& Add(const char* name, const char* description, int (*run)(const CatalogOptions&)) {
    options_ = std::make_shared<CatalogOptions>();
    auto* command = group_.add_subcommand(name, description);
    AddCatalogOption(*command, options_->catalog);
    command->callback([options = options_, run, &status = status_] { status = run(*options); });
    return *command;
  }
  // Of the command added last.
  CatalogOptions& options() { return *options_; }

 private:
  CLI::App& group_;
  int& status_;
  Options options_;
};

template <void (*run)(const CatalogOptions&)>
int Answered(const CatalogOptions& options) {
  run(options);
  return kAnswered;
}

void AddRevision(CLI::App& command, CatalogOptions& options) {
  command.add_option("--revision", options.revision, "As the catalogue was in this revision")
      ->type_name("N");
}

}  // namespace

void AddCatalogCommand(CLI::App& app, int& status) {
  CatalogCommands commands(app, status);
  auto& list = commands.Add("list", "The parts, of one family or all", Answered<List>);
  list.add_option("FAMILY", commands.options().family, "One of " + FamilyNames())->type_name("");
  list.add_option("--where", commands.options().filters,
                  "FIELD=VALUE, FIELD_min=VALUE or FIELD_max=VALUE; may be repeated")
      ->type_name("FILTER");
  list.add_option("--sort", commands.options().sort, "Field; -FIELD for the opposite order")
      ->type_name("FIELD");
  AddRevision(list, commands.options());
  AddJsonFlag(list, commands.options().json);
  list.add_flag("--csv", commands.options().csv, "CSV, as import takes it")->excludes("--json");

  auto& show = commands.Add("show", "One part with the source of every number", Answered<Show>);
  show.add_option("ID", commands.options().id, "Its id")->required()->type_name("");
  AddRevision(show, commands.options());
  AddJsonFlag(show, commands.options().json);

  auto& history =
      commands.Add("history", "Changes of a part, or all writes", Answered<ShowHistory>);
  history.add_option("ID", commands.options().id, "A part's id; all writes without")->type_name("");
  history.add_option("--limit", commands.options().limit, "Newest N")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  AddJsonFlag(history, commands.options().json);

  auto& undo = commands.Add("undo", "Takes the changes of a revision back", Answered<UndoWrite>);
  undo.add_option("REVISION", commands.options().revision, "Its number, see history")
      ->required()
      ->type_name("");

  auto& add = commands.Add("add", "Adds a part", Answered<Add>);
  AddFile(add, commands.options().file, "JSON as show --json prints it; - is standard input");

  auto& remove = commands.Add("remove", "Removes a part", Answered<Remove>);
  remove.add_option("ID", commands.options().id, "Its id")->required()->type_name("");

  auto& import = commands.Add("import", "Adds and replaces parts from CSV", Answered<Import>);
  import.add_option("FAMILY", commands.options().family, "One of " + FamilyNames())
      ->required()
      ->type_name("");
  AddFile(import, commands.options().file, "CSV; - is standard input");
  import.add_flag("--dry-run", commands.options().dry_run, "Says what it would do");
  AddJsonFlag(import, commands.options().json);

  auto& write = commands.Add("export", "Parts of a family as CSV", Answered<Export>);
  write.add_option("FAMILY", commands.options().family, "One of " + FamilyNames())
      ->required()
      ->type_name("");

  auto& backup =
      commands.Add("backup", "Copies the catalogue while it is in use", Answered<BackupCatalog>);
  AddFile(backup, commands.options().file, "The copy; replaced if there is one");

  auto& restore = commands.Add("restore", "Puts parts and history of a copy in place",
                               Answered<RestoreCatalog>);
  AddFile(restore, commands.options().file, "The copy");

  auto& check = commands.Add("check", "Checks the file, every row, the history and odd numbers",
                             CheckCatalog);
  AddJsonFlag(check, commands.options().json);
}

}  // namespace plenum::server
