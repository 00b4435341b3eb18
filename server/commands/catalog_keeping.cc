#include "server/commands/catalog_keeping.h"

#include <cstdio>
#include <filesystem>

#include "api/catalogue/catalog_check.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/seed/seed_document.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/protocol/part_revision.h"
#include "api/protocol/read_by_hand.h"
#include "server/call/reply.h"
#include "server/call/tokens.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"
#include "server/render/text/text_catalog.h"
#include "server/render/text/text_protocol.h"
#include "server/render/text/text_table.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

using catalog::Access;
using catalog::WriteStatus;

constexpr std::size_t kUndoErrorsShown = 20;

void RevisionList(const CatalogOptions& options, const catalog::Store& store) {
  const auto revisions = store.Revisions(INT64_MAX, options.limit);
  if (!options.json) return Print(RevisionsText(revisions));
  api::Json list = api::Json::array();
  for (const auto& revision : revisions) list.push_back(api::RenderRevision(revision));
  Print(Dump({{"revisions", list}}) + "\n");
}

void CopyOrRefuse(void (*copy)(const std::filesystem::path&, const std::filesystem::path&),
                  const CatalogOptions& options) {
  try {
    copy(options.catalog, options.file);
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

// What is wrong with the jobs beside the catalogue. A service that runs holds them for itself.
std::vector<std::string> CheckJobsOf(const std::string& catalog) {
  const std::string path = catalog + "-jobs";
  if (catalog::IsServer(catalog) || !std::filesystem::exists(path)) return {};
  try {
    auto faults = catalog::CheckJobs(path);
    for (auto& fault : faults) fault.insert(0, path + ": ");
    return faults;
  } catch (const catalog::StoreError& error) {
    if (error.fault() != catalog::StoreFault::kBusy) return {error.what()};
    std::fprintf(stderr, "%s: not checked, a service holds it\n", path.c_str());
    return {};
  }
}

std::string Ids(const std::vector<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) text += (text.empty() ? "" : ", ") + id;
  return text;
}

std::string SeedText(const catalog::SeedUpdate& update, const std::string& seed, bool dry_run) {
  const catalog::SeedPlan& plan = update.plan;
  std::string text = "of " + seed + ":\n";
  for (const auto& [what, ids] :
       {std::pair("added", &plan.added), std::pair("changed", &plan.replaced),
        std::pair("removed", &plan.removed), std::pair("yours, left as it is", &plan.kept)})
    if (!ids->empty())
      text += "  " + std::to_string(ids->size()) + " " + what + ": " + Cut(Ids(*ids), 300) + "\n";
  if (plan.added.empty() && plan.replaced.empty() && plan.removed.empty())
    return text + "nothing to take over\n";
  const std::string number = std::to_string(update.revision.number);
  return text +
         (dry_run ? "nothing was written\n"
                  : "revision " + number + "; plenum catalog undo " + number + " takes it back\n");
}

}  // namespace

void ShowHistory(const CatalogOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  if (options.id.empty()) return RevisionList(options, store);
  const auto changes = store.History(options.id, INT64_MAX, options.limit);
  if (changes.empty() && !store.Get(options.id)) {
    throw BadInput("ID: no part has or had the id " + options.id);
  }
  if (!options.json) return Print(HistoryText(changes));
  api::Json list = api::Json::array();
  for (const auto& change : changes) {
    api::Json entry = {{"revision", api::RenderRevision(change.revision)}};
    entry.update(api::RenderChange(change));
    list.push_back(std::move(entry));
  }
  Print(Dump({{"id", options.id}, {"history", list}}) + "\n");
}

// A revision may have changed hundreds of parts.
api::Errors FirstOf(api::Errors errors) {
  if (errors.size() <= kUndoErrorsShown) return errors;
  const std::size_t more = errors.size() - kUndoErrorsShown;
  errors.resize(kUndoErrorsShown);
  errors.push_back({"", "and " + std::to_string(more) + " more"});
  return errors;
}

void UndoWrite(const CatalogOptions& options) {
  const auto number = options.revision.value();
  const auto written =
      OpenCatalog(options.catalog, Access::kWrite).Undo(number, CommandSignature());
  if (written.status == WriteStatus::kNotFound) {
    throw BadInput("REVISION: the catalogue has no revision " + std::to_string(number));
  }
  if (written.status != WriteStatus::kDone) Refuse(FirstOf(FieldErrors(written.errors)));
  Print("undone as revision " + std::to_string(written.revision.number) + "\n");
}

void WriteMeasured(const CatalogOptions& options) {
  if (const std::string why = api::WhyInvalidSpecimen(options.reading.specimen, options.id);
      !why.empty())
    throw BadInput("--specimen: " + why);
  auto store = OpenCatalog(options.catalog, Access::kWrite);
  const auto part = store.Get(options.id);
  if (!part) throw BadInput("ID: no part has the id " + options.id);
  api::Json answer = ValueOrRefuse(api::ReadByHandAnswer(
      *part, options.reading.readings, options.reading.uncertainty, options.reading.how));
  answer["saved_part"] = api::SavePart(store, options.id, answer, {}, options.reading.anyway,
                                       CommandSignature(), options.reading.specimen);
  Print(options.json ? Dump(answer.at("saved_part")) + "\n" : SavedPartText(answer));
}

void BackupCatalog(const CatalogOptions& options) {
  OpenCatalog(options.catalog, Access::kRead);  // says what is wrong with the file
  CopyOrRefuse(catalog::Backup, options);
  Print("copied to " + options.file + "\n");
}

void RestoreCatalog(const CatalogOptions& options) {
  catalog::BeginCatalog(options.catalog);
  CopyOrRefuse(catalog::Restore, options);
  Print("restored revision " +
        std::to_string(OpenCatalog(options.catalog, Access::kRead).Head().number) + " from " +
        options.file + "\n");
}

void CopyCatalog(const CatalogOptions& options) {
  OpenCatalog(options.file, Access::kRead);  // says what is wrong with it
  try {
    const auto head = catalog::CopyCatalogue(options.file, options.id);
    CopyTokens(TokenFile(options.file), TokenFile(options.id));
    Print("copied revision " + std::to_string(head.number) + " with all before it, hash " +
          head.hash + "\n");
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

void UpdateCatalog(const CatalogOptions& options) {
  OpenCatalog(options.catalog, Access::kWrite);  // says what is wrong with the file
  const std::string seed = options.file.empty() ? catalog::InstalledSeed().string() : options.file;
  if (seed.empty())
    throw BadInput("no catalogue was installed with this program; name one with --from");
  try {
    const auto update =
        catalog::UpdateSeed(options.catalog, seed, CommandSignature().who, options.dry_run);
    Print(options.json ? Dump(api::RenderSeedUpdate(update)) + "\n"
                       : SeedText(update, seed, options.dry_run));
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

int CheckCatalog(const CatalogOptions& options) {
  const auto store = OpenCatalog(options.catalog, Access::kRead);
  auto faults = store.Check();
  const bool readable = faults.empty();
  for (auto& fault : CheckJobsOf(options.catalog)) faults.push_back(std::move(fault));
  for (const auto& fault : faults) Tell(fault);
  std::vector<catalog::Part> parts;
  if (readable) parts = store.List();  // what is damaged cannot be read
  const auto check = api::CheckParts(parts);
  if (options.json) {
    api::Json json = {{"parts", readable ? api::Json(parts.size()) : api::Json()},
                      {"faults", faults}};
    json.update(api::RenderCheck(check));
    Print(Dump(json) + "\n");
  } else if (faults.empty()) {
    Print(std::to_string(parts.size()) + " parts, no faults\n" + CheckText(check));
  }
  return faults.empty() ? kAnswered : kBadInput;
}

}  // namespace plenum::server
