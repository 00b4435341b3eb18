#include "server/resources/import_parts.h"

#include <set>
#include <utility>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"

namespace plenum::server {
namespace {

constexpr std::size_t kErrorsShown = 99;  // and one that counts the rest

std::string PointerTo(int row, const std::string& column) {
  return "/" + std::to_string(row) + "/" + column;
}

api::Errors ToErrors(const catalog::CsvErrors& found, const catalog::TableReading& reading) {
  api::Errors errors;
  for (const auto& error : found.errors) {
    if (errors.size() == kErrorsShown) break;
    errors.push_back({PointerTo(error.row, HeadingOf(reading, error.column)), error.detail});
  }
  if (found.count > errors.size())
    errors.push_back({"", std::to_string(found.count - errors.size()) + " more errors"});
  return errors;
}

// Of the rows whose ids are those of parts of another family.
api::Errors TakenErrors(const catalog::TableReading& reading, std::string_view bytes,
                        const std::vector<std::string>& taken) {
  const std::set<std::string> ids(taken.begin(), taken.end());
  catalog::CsvErrors errors;
  const auto rows = catalog::RowsOf(reading, bytes);
  catalog::ReadRows(reading.family, rows, [&](const catalog::Part& part, int row) {
    if (!ids.contains(part.id)) return;
    if (++errors.count <= catalog::kCsvErrorsMax)
      errors.errors.push_back(
          {row, "id", "\"" + part.id + "\" is taken by a part of another family"});
  });
  return ToErrors(errors, reading);
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

// Once for the errors, so that nothing is written before all of it is known to be right, then again
// as the parts are wanted: all at once would take many times the text.
api::Errors CheckTable(const catalog::TableReading& reading, std::string_view bytes) {
  if (catalog::FindFamily(reading.family) == nullptr)
    return {{"/family", "must be one of " + FamilyNames() + ", not \"" + reading.family + "\""}};
  if (auto open = api::ErrorsOf(reading); !open.empty()) return open;
  return ToErrors(catalog::ReadRows(reading.family, catalog::RowsOf(reading, bytes),
                                    [](const catalog::Part&, int) {}),
                  reading);
}

TableImport ImportTable(catalog::Store& store, const catalog::TableReading& reading,
                        std::string_view bytes, bool dry_run, const catalog::Signature& by) {
  TableImport result;
  const auto rows = catalog::RowsOf(reading, bytes);
  const catalog::PartSource parts = [&](const catalog::TakeEach& take) {
    catalog::ReadRows(reading.family, rows, [&](const catalog::Part& part, int) { take(part); });
  };
  if (dry_run) {
    result.plan = store.PlanImport(parts);
    result.revision = store.Head();
  } else {
    auto imported = store.Import(parts, by);
    result.plan = std::move(imported.plan);
    result.status = imported.write.status;
    result.revision = std::move(imported.write.revision);
  }
  if (!result.plan.taken.empty()) result.errors = TakenErrors(reading, bytes, result.plan.taken);
  return result;
}

api::Json ToJson(const TableImport& import, const catalog::TableReading& reading, bool dry_run) {
  return {{"added", import.plan.added},
          {"replaced", import.plan.replaced},
          {"unchanged", import.plan.unchanged},
          {"dry_run", dry_run},
          {"catalogue_revision", api::RenderRevisionName(import.revision)},
          {"understood", api::RenderUnderstood(reading)}};
}

}  // namespace plenum::server
