#include <algorithm>
#include <cstdio>
#include <memory>

#include "api/services.h"
#include "server/command_options.h"
#include "server/commands.h"
#include "server/exit_status.h"
#include "server/import_parts.h"
#include "server/input.h"
#include "server/reply.h"
#include "server/text_catalog.h"

namespace plenum::server {
namespace {

using catalog::Access;
using catalog::WriteStatus;

struct CatalogOptions {
  std::string catalog = "catalog.db";
  std::string family, file, id;
  bool json = false, csv = false, dry_run = false;
};
using Options = std::shared_ptr<CatalogOptions>;

void Print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void CheckFamily(const std::string& family) {
  if (catalog::FindFamily(family) == nullptr) {
    throw BadInput("family: must be one of " + FamilyNames() + ", not \"" + family + "\"");
  }
}

void List(const CatalogOptions& options) {
  std::optional<std::string> family;
  if (!options.family.empty()) family = options.family;
  if (family) CheckFamily(*family);
  if (options.csv && !family) throw BadInput("--csv: needs a family, one of " + FamilyNames());
  const auto parts = OpenCatalog(options.catalog, Access::kRead).List(family);
  if (options.csv) return Print(catalog::WriteCsv(*family, parts));
  if (!options.json) return Print(PartsText(parts));
  api::Json list = api::Json::array();
  for (const auto& part : parts) list.push_back(api::RenderPart(part));
  Print(Dump({{"parts", list}}) + "\n");
}

void Show(const CatalogOptions& options) {
  const auto part = OpenCatalog(options.catalog, Access::kRead).Get(options.id);
  if (!part) throw BadInput("ID: no part has the id " + options.id);
  Print(options.json ? Dump(api::RenderPart(*part), 2) + "\n" : PartText(*part));
}

void Add(const CatalogOptions& options) {
  const auto part = ValueOrRefuse(api::ParsePart(ReadJson(options.file)));
  const auto written = OpenCatalog(options.catalog, Access::kWrite).Add(part);
  if (written.status == WriteStatus::kExists) {
    throw BadInput("/id: " + part.id + " is taken; choose another id or remove that part first");
  }
  if (written.status == WriteStatus::kInvalid) Refuse(FieldErrors(written.errors));
  Print("added " + part.id + "\n");
}

void Remove(const CatalogOptions& options) {
  const auto written = OpenCatalog(options.catalog, Access::kWrite).Remove(options.id);
  if (written.status == WriteStatus::kNotFound) {
    throw BadInput("ID: no part has the id " + options.id);
  }
  Print("removed " + options.id + "\n");
}

void Import(const CatalogOptions& options) {
  const auto text = ReadText(options.file);
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  const auto result = ImportCsv(store, options.family, text, options.dry_run);
  if (!result.errors.empty()) Refuse(result.errors);
  if (options.json) return Print(Dump(ToJson(result)) + "\n");
  Print((options.dry_run ? "would add " : "added ") + std::to_string(result.added.size()) +
        ", replace " + std::to_string(result.replaced.size()) + ", leave " +
        std::to_string(result.unchanged.size()) + " unchanged\n");
}

void Export(const CatalogOptions& options) {
  CheckFamily(options.family);
  const auto parts = OpenCatalog(options.catalog, Access::kRead).List(options.family);
  Print(catalog::WriteCsv(options.family, parts));
}

int Check(const CatalogOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto faults = store.Check();
  const auto parts = store.List().size();
  if (options.json) {
    Print(Dump({{"parts", parts}, {"faults", faults}}) + "\n");
  } else if (faults.empty()) {
    Print(std::to_string(parts) + " parts, no faults\n");
  }
  for (const auto& fault : faults) std::fprintf(stderr, "%s\n", fault.c_str());
  return faults.empty() ? kAnswered : kBadInput;
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

}  // namespace

void AddCatalogCommand(CLI::App& app, int& status) {
  CatalogCommands commands(app, status);
  auto& list = commands.Add("list", "The parts, of one family or all", Answered<List>);
  list.add_option("FAMILY", commands.options().family, "One of " + FamilyNames())->type_name("");
  AddJsonFlag(list, commands.options().json);
  list.add_flag("--csv", commands.options().csv, "CSV, as import takes it")->excludes("--json");

  auto& show = commands.Add("show", "One part with the source of every number", Answered<Show>);
  show.add_option("ID", commands.options().id, "Its id")->required()->type_name("");
  AddJsonFlag(show, commands.options().json);

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

  auto& check = commands.Add("check", "Checks the file and every row", Check);
  AddJsonFlag(check, commands.options().json);
}

}  // namespace plenum::server
