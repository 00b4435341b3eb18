#include "catalog/store/tables/models.h"

#include <algorithm>

#include "catalog/store/content_hash.h"

namespace plenum::catalog {
namespace {

constexpr char kSelect[] = "SELECT name, version, at, who, document, hash FROM model ";

std::vector<ModelRevision> ReadAll(SqlStatement& query) {
  std::vector<ModelRevision> models;
  while (query.Step())
    models.push_back({query.Text(0), query.Integer(1), query.Text(2), query.Text(3), query.Text(4),
                      query.Text(5)});
  return models;
}

}  // namespace

std::string WhyInvalidModelName(std::string_view name) {
  const auto alphanumeric = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  const auto allowed = [&](char c) { return alphanumeric(c) || c == '.' || c == '_' || c == '-'; };
  if (name == "nominal") return "\"nominal\" stands for the base model";
  if (name.empty() || name.size() > 100 || !alphanumeric(name.front()) ||
      !std::all_of(name.begin(), name.end(), allowed))
    return "must be 1 to 100 of a-z, 0-9, '.', '_' and '-', the first a letter or a digit";
  return "";
}

std::vector<ModelRevision> ReadModels(SqlDatabase& db) {
  return ReadAll(*Query(db, std::string(kSelect) +
                                "AS m WHERE version = (SELECT max(version) FROM model WHERE name "
                                "= m.name) ORDER BY name"));
}

std::vector<ModelRevision> ReadVersions(SqlDatabase& db, const std::string& name) {
  return ReadAll(*Query(db, std::string(kSelect) + "WHERE name = ? ORDER BY version DESC", name));
}

std::optional<ModelRevision> ReadModel(SqlDatabase& db, const std::string& name,
                                       std::optional<std::int64_t> version) {
  for (ModelRevision& model : ReadVersions(db, name))
    if (!version || model.version == *version) return std::move(model);
  return std::nullopt;
}

std::optional<ModelRevision> FindDocument(SqlDatabase& db, const std::string& name,
                                          const std::string& document) {
  const std::string hash = Sha256(document);
  for (ModelRevision& model : ReadVersions(db, name))
    if (model.hash == hash) return std::move(model);
  return std::nullopt;
}

ModelRevision InsertModel(SqlDatabase& db, const std::string& name, const std::string& document,
                          const std::string& who) {
  const std::string hash = Sha256(document);
  const std::optional<ModelRevision> newest = ReadModel(db, name, std::nullopt);
  if (newest && newest->hash == hash) return *newest;
  Run(db, std::string("INSERT INTO model VALUES (?, ?, ") + db.words().now + ", ?, ?, ?)", name,
      newest ? newest->version + 1 : std::int64_t{1}, who, document, hash);
  return ReadModel(db, name, std::nullopt).value();
}

std::vector<std::string> CheckModels(SqlDatabase& db) {
  std::vector<std::string> faults;
  for (const ModelRevision& model :
       ReadAll(*Query(db, std::string(kSelect) + "ORDER BY name, version")))
    if (Sha256(model.document) != model.hash)
      faults.push_back("model " + model.name + ", version " + std::to_string(model.version) +
                       ": the document does not have its hash");
  return faults;
}

}  // namespace plenum::catalog
