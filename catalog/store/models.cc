#include "catalog/store/models.h"

#include <algorithm>

#include "catalog/store/content_hash.h"

namespace plenum::catalog {
namespace {

constexpr char kSelect[] = "SELECT name, version, at, who, document, hash FROM model ";

std::vector<ModelRevision> ReadAll(SQLite::Statement& query) {
  std::vector<ModelRevision> models;
  while (query.executeStep())
    models.push_back({query.getColumn(0).getString(), query.getColumn(1).getInt64(),
                      query.getColumn(2).getString(), query.getColumn(3).getString(),
                      query.getColumn(4).getString(), query.getColumn(5).getString()});
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

std::vector<ModelRevision> ReadModels(SQLite::Database& db) {
  SQLite::Statement query(db, std::string(kSelect) +
                                  "AS m WHERE version = (SELECT max(version) FROM model WHERE name "
                                  "= m.name) ORDER BY name");
  return ReadAll(query);
}

std::vector<ModelRevision> ReadVersions(SQLite::Database& db, const std::string& name) {
  SQLite::Statement query(db, std::string(kSelect) + "WHERE name = ? ORDER BY version DESC");
  query.bind(1, name);
  return ReadAll(query);
}

std::optional<ModelRevision> ReadModel(SQLite::Database& db, const std::string& name,
                                       std::optional<std::int64_t> version) {
  for (ModelRevision& model : ReadVersions(db, name))
    if (!version || model.version == *version) return std::move(model);
  return std::nullopt;
}

std::optional<ModelRevision> FindDocument(SQLite::Database& db, const std::string& name,
                                          const std::string& document) {
  const std::string hash = Sha256(document);
  for (ModelRevision& model : ReadVersions(db, name))
    if (model.hash == hash) return std::move(model);
  return std::nullopt;
}

ModelRevision InsertModel(SQLite::Database& db, const std::string& name,
                          const std::string& document, const std::string& who) {
  const std::string hash = Sha256(document);
  const std::optional<ModelRevision> newest = ReadModel(db, name, std::nullopt);
  if (newest && newest->hash == hash) return *newest;
  SQLite::Statement insert(db,
                           "INSERT INTO model VALUES (?, ?, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), "
                           "?, ?, ?)");
  insert.bind(1, name);
  insert.bind(2, newest ? newest->version + 1 : 1);
  insert.bind(3, who);
  insert.bind(4, document);
  insert.bind(5, hash);
  insert.exec();
  return ReadModel(db, name, std::nullopt).value();
}

std::vector<std::string> CheckModels(SQLite::Database& db) {
  std::vector<std::string> faults;
  SQLite::Statement query(db, std::string(kSelect) + "ORDER BY name, version");
  for (const ModelRevision& model : ReadAll(query))
    if (Sha256(model.document) != model.hash)
      faults.push_back("model " + model.name + ", version " + std::to_string(model.version) +
                       ": the document does not have its hash");
  return faults;
}

}  // namespace plenum::catalog
