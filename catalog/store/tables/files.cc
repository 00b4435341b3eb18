#include "catalog/store/tables/files.h"

#include <utility>

#include "catalog/store/content_hash.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kPieceBytes = 256 << 10;  // as the tables allow

std::vector<KeptFile> AllFiles(SqlDatabase& db) {
  std::vector<KeptFile> files;
  const auto query = Query(db, "SELECT sha256, media_type, bytes FROM file ORDER BY sha256");
  while (query->Step()) files.push_back({query->Text(0), query->Text(1), query->Integer(2)});
  return files;
}

}  // namespace

std::optional<KeptFile> FindFile(SqlDatabase& db, const std::string& sha256) {
  const auto query =
      Query(db, "SELECT sha256, media_type, bytes FROM file WHERE sha256 = ?", sha256);
  if (!query->Step()) return std::nullopt;
  return KeptFile{query->Text(0), query->Text(1), query->Integer(2)};
}

std::string ReadFile(SqlDatabase& db, const KeptFile& file) {
  std::string content;
  content.reserve(static_cast<std::size_t>(file.bytes));
  const auto query =
      Query(db, "SELECT content FROM file_piece WHERE sha256 = ? ORDER BY place", file.sha256);
  while (query->Step()) content += query->Bytes(0);
  return content;
}

void InsertFile(SqlDatabase& db, const KeptFile& file, std::string_view content) {
  if (FindFile(db, file.sha256)) return;
  Run(db, "INSERT INTO file VALUES (?, ?, ?)", file.sha256, file.media_type, file.bytes);
  const auto insert = db.Prepare("INSERT INTO file_piece VALUES (?, ?, ?)");
  for (int place = 0; !content.empty(); ++place) {
    const auto piece = content.substr(0, kPieceBytes);
    Run(*insert, file.sha256, place, SqlBytes{std::string(piece)});
    content.remove_prefix(piece.size());
  }
}

std::vector<std::string> CheckFiles(SqlDatabase& db) {
  std::vector<std::string> faults;
  for (const KeptFile& file : AllFiles(db)) {
    const std::string content = ReadFile(db, file);
    if (static_cast<std::int64_t>(content.size()) != file.bytes || Sha256(content) != file.sha256)
      faults.push_back("file " + file.sha256 + ": the content does not have its hash");
  }
  return faults;
}

}  // namespace plenum::catalog
