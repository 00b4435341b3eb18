#include "python/core/part_store.h"

#include <algorithm>
#include <filesystem>

#include "api/catalogue/families.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/table_reading.h"
#include "api/measure/model_document.h"
#include "python/core/documents.h"

namespace plenum::python {
namespace {

using catalog::Access;
using catalog::WriteStatus;

// The revision that holds a write, or why there was none.
std::string Written(const catalog::WriteResult& written, const std::string& id) {
  if (written.status == WriteStatus::kDone) return Dump(api::RenderRevision(written.revision));
  if (written.status == WriteStatus::kExists)
    throw Refused({{"/id", "\"" + id + "\" is taken; choose another id, or replace that part"}});
  if (written.status == WriteStatus::kNotFound)
    throw Refused({{"/id", "no part has the id \"" + id + "\""}});
  api::Errors errors;
  for (const auto& error : written.errors) errors.push_back({"/" + error.field, error.detail});
  throw Refused(std::move(errors));
}

}  // namespace

std::string LocateCatalogue(const std::string& path, const std::string& seed) {
  const std::filesystem::path begin = seed.empty() ? catalog::InstalledSeed() : seed.c_str();
  const std::filesystem::path place = path.empty() ? catalog::DefaultCatalog(begin) : path.c_str();
  return catalog::BeginCatalog(place, begin);
}

catalog::Store OpenCatalogue(const std::string& path, Access access) {
  if (!catalog::IsServer(path) && !std::filesystem::exists(path))
    throw Refused({{"catalogue", path + ": no such catalogue; name one, or set PLENUM_CATALOG"}});
  return {path, access};
}

std::string Parts(const std::string& path, const std::optional<std::string>& family) {
  api::Json list = api::Json::array();
  for (const catalog::Part& part : OpenCatalogue(path, Access::kRead).List(family))
    list.push_back(api::RenderPart(part));
  return Dump(list);
}

std::string Families() { return Dump(api::RenderFamilies()); }

std::string Head(const std::string& path) {
  return Dump(api::RenderRevision(OpenCatalogue(path, Access::kRead).Head()));
}

std::string AddPart(const std::string& path, const std::string& part, bool replace,
                    const std::string& who) {
  const auto parsed = ValueOrRefuse(api::ParsePart(Parse(part)));
  auto store = OpenCatalogue(path, Access::kWrite);
  const catalog::Signature by{who, {}, {}};
  auto written = store.Add(parsed, by);
  if (replace && written.status == WriteStatus::kExists) written = store.Replace(parsed, by);
  return Written(written, parsed.id);
}

std::string RemovePart(const std::string& path, const std::string& id, const std::string& who) {
  return Written(OpenCatalogue(path, Access::kWrite).Remove(id, {who, {}, {}}), id);
}

std::string ImportTable(const std::string& path, const std::string& family,
                        const std::string& table, bool dry_run, const std::string& who) {
  if (catalog::FindFamily(family) == nullptr)
    throw Refused({{"family", "no family is called \"" + family + "\"; see Catalogue().families"}});
  const catalog::TableReading reading = catalog::ReadTable(family, table, {});
  if (auto open = api::ErrorsOf(reading); !open.empty()) throw Refused(std::move(open));
  const auto rows = catalog::RowsOf(reading, table);
  std::vector<catalog::Part> parts;
  const auto found = catalog::ReadRows(
      family, rows, [&](const catalog::Part& part, int) { parts.push_back(part); });
  api::Errors errors;
  for (const auto& error : found.errors)
    errors.push_back(
        {"/" + std::to_string(error.row) + "/" + HeadingOf(reading, error.column), error.detail});
  if (!errors.empty()) throw Refused(std::move(errors));
  auto store = OpenCatalogue(path, dry_run ? Access::kRead : Access::kWrite);
  const catalog::PartSource source = [&](const catalog::TakeEach& take) {
    std::for_each(parts.begin(), parts.end(), take);
  };
  const catalog::ImportPlan plan =
      dry_run ? store.PlanImport(source) : store.Import(source, {who, {}, {}}).plan;
  for (const std::string& id : plan.taken)
    errors.push_back({"/id", "\"" + id + "\" is taken by a part of another family"});
  if (!errors.empty()) throw Refused(std::move(errors));
  return Dump({{"added", plan.added}, {"replaced", plan.replaced}, {"unchanged", plan.unchanged}});
}

std::string SaveModel(const std::string& path, const std::string& name, const std::string& model,
                      const std::string& who) {
  if (const std::string why = catalog::WhyInvalidModelName(name); !why.empty())
    throw Refused({{"/name", why}});
  const auto parsed = ValueOrRefuse(api::ParseModel(Parse(model)));
  auto store = OpenCatalogue(path, Access::kWrite);
  return Dump(
      api::RenderModelRevision(store.SaveModel(name, Dump(api::RenderModel(parsed)), who), false));
}

std::string Models(const std::string& path) {
  api::Json list = api::Json::array();
  for (const auto& model : OpenCatalogue(path, Access::kRead).Models())
    list.push_back(api::RenderModelRevision(model, true));
  return Dump(list);
}

}  // namespace plenum::python
