#include "server/import_parts.h"

#include <algorithm>

#include "api/services.h"

namespace plenum::server {
namespace {

api::Errors ToErrors(const std::vector<catalog::CsvError>& csv_errors) {
  api::Errors errors;
  for (const auto& error : csv_errors) {
    errors.push_back({"/" + std::to_string(error.row) + "/" + error.column, error.detail});
  }
  return errors;
}

}  // namespace

std::string FamilyNames() {
  std::string names;
  for (const auto& family : catalog::Families()) {
    names += (names.empty() ? "" : ", ") + std::string(family.name);
  }
  return names;
}

api::Errors FieldErrors(const std::vector<catalog::FieldError>& field_errors) {
  api::Errors errors;
  for (const auto& error : field_errors) {
    errors.push_back({error.field.empty() ? "" : "/" + error.field, error.detail});
  }
  return errors;
}

CsvImport ImportCsv(catalog::Store& store, const std::string& family, std::string_view text,
                    bool dry_run, const catalog::Signature& by) {
  CsvImport result;
  if (catalog::FindFamily(family) == nullptr) {
    result.errors.push_back(
        {"/family", "must be one of " + FamilyNames() + ", not \"" + family + "\""});
    return result;
  }
  const auto csv = catalog::ReadCsv(family, text);
  result.errors = ToErrors(csv.errors);
  if (!result.errors.empty()) return result;

  if (dry_run) {
    result.plan = store.PlanImport(csv.parts);
    result.revision = store.Head();
  } else {
    auto imported = store.Import(csv.parts, by);
    result.plan = std::move(imported.plan);
    result.status = imported.write.status;
    result.revision = std::move(imported.write.revision);
  }
  for (std::size_t i = 0; i < csv.parts.size(); ++i) {
    const std::string& id = csv.parts[i].id;
    if (std::count(result.plan.taken.begin(), result.plan.taken.end(), id) == 0) continue;
    result.errors.push_back({"/" + std::to_string(csv.rows[i]) + "/id",
                             "\"" + id + "\" is taken by a part of another family"});
  }
  return result;
}

api::Json ToJson(const CsvImport& import, bool dry_run) {
  return {{"added", import.plan.added},
          {"replaced", import.plan.replaced},
          {"unchanged", import.plan.unchanged},
          {"dry_run", dry_run},
          {"catalogue_revision", api::RenderRevisionName(import.revision)}};
}

}  // namespace plenum::server
