#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "api/catalogue/part_comparison.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/part_query.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/remarks.h"
#include "server/call/reply.h"
#include "server/commands/catalog_keeping.h"
#include "server/commands/commands.h"
#include "server/commands/documents/command_documents.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"
#include "server/render/text/text_catalog.h"
#include "server/render/text/text_parts.h"
#include "server/render/text/text_remarks.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

using catalog::Access;
using catalog::WriteStatus;

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
  if (!options.list.sort.empty()) query.emplace("sort", options.list.sort);
  if (!options.list.search.empty()) query.emplace("q", options.list.search);
  for (const auto& filter : options.list.filters) {
    const auto equals = filter.find('=');
    if (equals == std::string::npos) {
      throw BadInput("--where: must be FIELD=VALUE, FIELD_min=VALUE or FIELD_max=VALUE, not \"" +
                     filter + "\"");
    }
    const std::string field = filter.substr(0, equals);
    for (const char* of_pages : {"q", "limit", "cursor", "facets", "revision"}) {
      if (field == of_pages) throw BadInput("--where: " + field + " is not a field");
    }
    query.emplace(field, filter.substr(equals + 1));
  }
  return ValueOrRefuse(api::ParsePartQuery(query));
}

void List(const CatalogOptions& options) {
  if (!options.family.empty()) CheckFamily(options.family);
  if (options.csv && options.family.empty()) {
    throw BadInput("--csv: needs a family, one of " + FamilyNames());
  }
  const auto query = ListQuery(options);
  const auto family = options.family.empty() ? std::nullopt : std::optional(options.family);
  std::vector<std::string> columns;
  for (const std::string& given : options.list.columns) {
    std::istringstream names(given);
    for (std::string one; std::getline(names, one, ',');)
      if (!one.empty()) columns.push_back(one);
  }
  if (const auto wrong = api::CheckColumns(columns, family); !wrong.empty()) Refuse(wrong);
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  const auto revision = RevisionOrHead(store, options.revision);
  const auto all = store.ListAt(revision.number);
  std::vector<catalog::Part> parts;
  const api::PartTable table(all);
  for (const auto* part : api::Select(query, table)) parts.push_back(*part);
  if (options.csv) return Print(catalog::WriteCsv(options.family, parts));
  const auto facets = options.list.facets ? api::FacetsOf(query, table) : api::Json();
  if (!options.json)
    return Print(PartsText(parts, columns) + (options.list.facets ? FacetsText(facets) : ""));
  api::Json list = api::Json::array();
  for (const auto& part : parts) list.push_back(api::RenderPart(part));
  api::Json answer = {{"parts", std::move(list)},
                      {"catalogue_revision", api::RenderRevisionName(revision)}};
  if (options.list.facets) answer["facets"] = facets;
  Print(Dump(answer) + "\n");
}

void Compare(const CatalogOptions& options) {
  if (const auto wrong = api::CheckCompared(options.list.ids); !wrong.empty()) Refuse(wrong);
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  std::vector<catalog::Part> parts;
  parts.reserve(options.list.ids.size());
  for (const auto& id : options.list.ids) {
    auto part = store.Get(id);
    if (!part) throw BadInput("ID: no part has the id " + id);
    parts.push_back(std::move(*part));
  }
  const auto comparison = api::RenderComparison(parts);
  Print(options.json ? Dump(comparison) + "\n" : ComparisonText(comparison));
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
  api::RemarkRecorder recorder;
  const auto part = ValueOrRefuse(api::ParsePart(ReadJson(options.file)));
  api::Json remarks = {{"understood", recorder.Take().understood}};
  const auto written = OpenCatalog(options.catalog, Access::kWrite).Add(part, CommandSignature());
  if (written.status == WriteStatus::kExists) {
    throw BadInput("/id: " + part.id + " is taken; choose another id or remove that part first");
  }
  if (written.status == WriteStatus::kInvalid) Refuse(FieldErrors(written.errors));
  Print("added " + part.id + "\n" + RemarksText(remarks));
}

void Remove(const CatalogOptions& options) {
  const auto written =
      OpenCatalog(options.catalog, Access::kWrite).Remove(options.id, CommandSignature());
  if (written.status == WriteStatus::kNotFound) {
    throw BadInput("ID: no part has the id " + options.id);
  }
  Print("removed " + options.id + "\n");
}

catalog::TableOptions TableOptionsOf(const CatalogOptions& options) {
  catalog::TableOptions table = options.table;
  api::Errors errors;
  api::ReadTableColumns(options.columns, table, errors);
  api::ReadTableSet(options.set, table, errors);
  if (!errors.empty()) Refuse(errors);
  return table;
}

void Import(const CatalogOptions& options) {
  const auto bytes = ReadText(options.file);
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  const auto reading = catalog::ReadTable(options.family, bytes, TableOptionsOf(options));
  if (!reading.questions.empty()) throw BadInput(QuestionsText(reading));
  if (const auto wrong = CheckTable(reading, bytes); !wrong.empty()) Refuse(wrong);
  const auto result = ImportTable(store, reading, bytes, options.dry_run, CommandSignature());
  if (!result.errors.empty()) Refuse(result.errors);
  if (options.json) return Print(Dump(ToJson(result, reading, options.dry_run)) + "\n");
  const auto& plan = result.plan;
  Print(UnderstoodText(reading) + (options.dry_run ? "would add " : "added ") +
        std::to_string(plan.added.size()) + ", replace " + std::to_string(plan.replaced.size()) +
        ", leave " + std::to_string(plan.unchanged.size()) + " unchanged\n");
}

void Export(const CatalogOptions& options) {
  CheckFamily(options.family);
  const auto parts = OpenCatalog(options.catalog, Access::kRead).List(options.family);
  Print(catalog::WriteCsv(options.family, parts));
}

template <void (*run)(const CatalogOptions&)>
int Answered(const CatalogOptions& options) {
  run(options);
  return kAnswered;
}

using OptionTable = std::vector<Option>;

// A command below `catalog`, with options of its own.
Command Below(const char* name, const char* help, const char* example,
              int (*run)(const CatalogOptions&),
              const std::function<OptionTable(CatalogOptions&)>& table) {
  auto options = std::make_shared<CatalogOptions>();
  OptionTable all = table(*options);
  all.insert(all.begin(), CatalogOption(options->catalog));
  return {name, help, example, std::move(all), [options, run] { return run(*options); }};
}

Option Family(CatalogOptions& options) {
  return {"FAMILY", "One of " + FamilyNames(), &options.family, {.value_name = ""}};
}

Option RequiredFamily(CatalogOptions& options) {
  Option family = Family(options);
  family.rules.required = true;
  return family;
}

Option RevisionOption(CatalogOptions& options) {
  return {"--revision",
          "As the catalogue was in this revision",
          &options.revision,
          {.value_name = "N"}};
}

OptionTable ListTable(CatalogOptions& options) {
  return {
      Family(options),
      {"--where",
       "FIELD=VALUE, FIELD_min=VALUE or FIELD_max=VALUE; may be repeated",
       &options.list.filters,
       {.value_name = "FILTER"}},
      {"--search",
       "Words in any text of a part, in any order",
       &options.list.search,
       {.value_name = "WORDS"}},
      {"--sort",
       "Field; -FIELD for the opposite order",
       &options.list.sort,
       {.value_name = "FIELD"}},
      {"--columns",
       "Fields to show instead of mass and conductance, with commas between them; may be repeated",
       &options.list.columns,
       {.value_name = "FIELD"}},
      {"--facets", "Also what the parts hold: values and ranges with counts", &options.list.facets},
      RevisionOption(options),
      JsonFlag(options.json),
      {"--csv", "CSV, as import takes it", &options.csv, {.excludes = "--json"}}};
}

OptionTable ShowTable(CatalogOptions& options) {
  return {Argument("ID", "Its id", &options.id), RevisionOption(options), JsonFlag(options.json)};
}

OptionTable CompareTable(CatalogOptions& options) {
  return {Argument("ID", "Ids of two to eight parts", &options.list.ids), JsonFlag(options.json)};
}

OptionTable HistoryTable(CatalogOptions& options) {
  return {{"ID", "A part's id; all writes without", &options.id, {.value_name = ""}},
          {"--limit",
           "Newest N",
           &options.limit,
           {.value_name = "N", .shows_default = true, .allowed = Within{1, 1'000'000}}},
          JsonFlag(options.json)};
}

OptionTable ImportOptions(CatalogOptions& options) {
  catalog::TableOptions& table = options.table;
  return {
      RequiredFamily(options),
      Argument("FILE", "CSV or TSV of any dialect; - is standard input", &options.file),
      {"--dry-run", "Says what it would do", &options.dry_run},
      {"--encoding",
       "utf-8, utf-16le, utf-16be or windows-1252; found without",
       &table.encoding,
       {.value_name = "NAME", .allowed = OneOf(catalog::EncodingNames())}},
      {"--delimiter",
       "comma, semicolon, tab or pipe; found without",
       &table.delimiter,
       {.value_name = "NAME", .allowed = OneOf(catalog::DelimiterNames())}},
      {"--decimal",
       "What stands before decimals: point or comma; found without",
       &table.decimal,
       {.value_name = "MARK", .allowed = OneOf{"point", "comma"}}},
      {"--header-row",
       "Row with the headings; found without",
       &table.header_row,
       {.value_name = "N", .allowed = Within{1, 1'000'000}}},
      {"--column",
       "HEADING=COLUMN or \"HEADING=COLUMN [UNIT]\", HEADING= to leave it out, *= all that is not "
       "known; may be repeated",
       &options.columns,
       {.value_name = "MEANING"}},
      {"--set",
       "COLUMN=VALUE for all rows; may be repeated",
       &options.set,
       {.value_name = "VALUE"}},
      JsonFlag(options.json)};
}

OptionTable CopyTable(CatalogOptions& options) {
  return {Argument("FROM", "A file, or postgresql://USER@HOST/DATABASE", &options.file),
          Argument("TO", "The same; it must hold no catalogue yet", &options.id)};
}

OptionTable UpdateTable(CatalogOptions& options) {
  return {{"--from",
           "The catalogue with the newer rows; without it the one that was installed with plenum",
           &options.file,
           {.value_name = "DB"}},
          {"--dry-run", "Only say what would be done", &options.dry_run},
          JsonFlag(options.json)};
}

OptionTable MeasuredTable(CatalogOptions& options) {
  return {Argument("ID", "The part's id", &options.id),
          Argument("READING", "FIELD=VALUE, with a unit: \"mass_kg=25.3 g\"",
                   &options.reading.readings),
          {"--uncertainty",
           "Of what was read, relative or in %, one standard deviation",
           &options.reading.uncertainty,
           {.value_name = "SHARE", .required = true}},
          {"--specimen",
           "The piece of the part's type that was measured",
           &options.reading.specimen,
           {.value_name = "NAME"}},
          {"--how",
           "How it was read; kept as its source",
           &options.reading.how,
           {.value_name = "TEXT"}},
          {"--anyway", "Also where it contradicts what stands there", &options.reading.anyway},
          JsonFlag(options.json)};
}

// One argument by its place.
std::function<OptionTable(CatalogOptions&)> FileTable(const char* help) {
  return [help](CatalogOptions& options) -> OptionTable {
    return {Argument("FILE", help, &options.file)};
  };
}

}  // namespace

Command CatalogCommand() {
  const auto id = [](CatalogOptions& options) -> OptionTable {
    return {Argument("ID", "Its id", &options.id)};
  };
  const auto revision = [](CatalogOptions& options) -> OptionTable {
    return {Argument("REVISION", "Its number, see history", &options.revision)};
  };
  const auto family = [](CatalogOptions& options) -> OptionTable {
    return {RequiredFamily(options)};
  };
  const auto json = [](CatalogOptions& options) -> OptionTable { return {JsonFlag(options.json)}; };
  return {
      "catalog",
      "The parts catalogue",
      "plenum catalog list valve --where mass_kg_max=0.02 --sort=mass_kg",
      {},
      {},
      {Below("list", "The parts, of one family or all",
             "plenum catalog list battery --where mass_kg_max=0.3", Answered<List>, ListTable),
       Below("show", "One part with the source of every number",
             "plenum catalog show smc-s070c-6dc-32", Answered<Show>, ShowTable),
       Below("compare", "Parts side by side, what differs marked",
             "plenum catalog compare smc-s070c-6dc-32 smc-s070c-sdg-32", Answered<Compare>,
             CompareTable),
       Below("history", "Changes of a part, or all writes", "plenum catalog history --limit 5",
             Answered<ShowHistory>, HistoryTable),
       Below("undo", "Takes the changes of a revision back", "plenum catalog undo 2",
             Answered<UndoWrite>, revision),
       Below("add", "Adds a part", "plenum catalog add part.json", Answered<Add>,
             FileTable("JSON as show --json prints it; - is standard input")),
       Below("measured", "Saves numbers of a part that were read by hand, as measured",
             "plenum catalog measured smc-vq110u-5m-m5 \"mass_kg=12.6 g\" --uncertainty \"0.5 %\"",
             Answered<WriteMeasured>, MeasuredTable),
       Below("remove", "Removes a part", "plenum catalog remove my-valve", Answered<Remove>, id),
       Below("import", "Adds and replaces parts from a table",
             "plenum catalog import battery packs.csv --dry-run", Answered<Import>, ImportOptions),
       Below("export", "Parts of a family as CSV", "plenum catalog export battery > packs.csv",
             Answered<Export>, family),
       DocumentCommand(),
       Below("backup", "Copies the catalogue while it is in use", "plenum catalog backup copy.db",
             Answered<BackupCatalog>, FileTable("The copy; replaced if there is one")),
       Below("restore", "Puts parts and history of a copy in place",
             "plenum catalog restore copy.db", Answered<RestoreCatalog>, FileTable("The copy")),
       Below("copy",
             "Copies all revisions, models, files of documents and tokens into another store",
             "plenum catalog copy catalog.db all-of-it.db", Answered<CopyCatalog>, CopyTable),
       Below("update", "Takes over what the installed catalogue has newer; your own rows stay",
             "plenum catalog update --from copy.db --dry-run", Answered<UpdateCatalog>,
             UpdateTable),
       Below("check",
             "Checks the file and its history, finds duplicates, odd numbers and what is missing",
             "plenum catalog check", CheckCatalog, json)}};
}

}  // namespace plenum::server
