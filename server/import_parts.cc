#include "server/import_parts.h"

#include <map>

#include "api/services.h"

namespace plenum::server {
namespace {

// Equal but for the origin, which a CSV file does not carry.
bool SameContent(catalog::Part a, const catalog::Part& b) {
  a.origin = b.origin;
  return a == b;
}

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

ImportResult ImportCsv(catalog::Store& store, const std::string& family, std::string_view text,
                       bool dry_run) {
  ImportResult result;
  if (catalog::FindFamily(family) == nullptr) {
    result.errors.push_back(
        {"/family", "must be one of " + FamilyNames() + ", not \"" + family + "\""});
    return result;
  }
  const auto csv = catalog::ReadCsv(family, text);
  result.errors = ToErrors(csv.errors);
  std::map<std::string, catalog::Part> stored;
  for (const auto& part : csv.parts) {
    auto old = store.Get(part.id);
    if (!old) continue;
    if (old->family != family) {
      result.errors.push_back({"/id", "\"" + part.id + "\" is taken by a part of the family " +
                                          old->family + "; choose another id"});
    }
    stored.emplace(part.id, std::move(*old));
  }
  if (!result.errors.empty()) return result;

  std::vector<const catalog::Part*> changed;
  for (const auto& part : csv.parts) {
    const auto old = stored.find(part.id);
    const bool is_new = old == stored.end();
    const bool same = !is_new && SameContent(part, old->second);
    (is_new ? result.added : same ? result.unchanged : result.replaced).push_back(part.id);
    if (!same) changed.push_back(&part);
  }
  if (dry_run) return result;
  for (const auto* part : changed) {
    const auto written = stored.count(part->id) > 0 ? store.Replace(*part) : store.Add(*part);
    if (written.status != catalog::WriteStatus::kDone) {
      throw catalog::StoreError("import stopped at part " + part->id +
                                ": the catalogue was changed meanwhile; import again");
    }
  }
  return result;
}

api::Json ToJson(const ImportResult& result) {
  return {{"added", result.added}, {"replaced", result.replaced}, {"unchanged", result.unchanged}};
}

}  // namespace plenum::server
