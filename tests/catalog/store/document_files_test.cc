// Files of documents: kept once under their hash, whatever becomes of the parts.
#include "catalog/store/documents/document_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/store/backup.h"
#include "catalog/store/content_hash.h"
#include "catalog/store/copy.h"
#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace document_files_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kPdf[] = "application/pdf";

// Bytes of all values, more than one piece, NUL and "\x" among them.
std::string AnyBytes(std::size_t size, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

class DocumentsOfParts : public InStore {
 protected:
  // A catalogue with the parts a and b.
  Store WithParts() const {
    Store store = Write();
    store.Import(EachOf({Reservoir("a"), Reservoir("b")}), {});
    return store;
  }
  static std::vector<std::string> Details(const WriteResult& result) {
    std::vector<std::string> details;
    for (const FieldError& error : result.errors)
      details.push_back(error.field + ": " + error.detail);
    return details;
  }
};

TEST_P(DocumentsOfParts, ComeBackByteForByte) {
  Store store = WithParts();
  for (const std::size_t size : {1u, 262'143u, 262'144u, 262'145u, 1'000'003u}) {
    const std::string bytes = AnyBytes(size, static_cast<unsigned>(size)), hash = Sha256(bytes);
    const auto written =
        DocumentFiles::Add(store, "a", {"sheet.pdf", kPdf, bytes}, {"ann", "", ""});
    ASSERT_EQ(written.status, WriteStatus::kDone);
    EXPECT_EQ(written.revision.who, "ann");
    EXPECT_EQ(written.revision.what, "add a document to a");
    EXPECT_EQ(DocumentFiles::Find(store, hash),
              (KeptFile{hash, kPdf, static_cast<std::int64_t>(size)}));
    EXPECT_TRUE(DocumentFiles::Content(Read(), hash) == bytes);
    EXPECT_EQ(store.Get("a")->documents.back(), (Document{"sheet.pdf", hash}));
  }
  EXPECT_EQ(store.Get("a")->origin, "user");
  EXPECT_FALSE(DocumentFiles::Find(store, Sha256("never")));
  EXPECT_FALSE(DocumentFiles::Content(store, Sha256("never")));
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_P(DocumentsOfParts, AreKeptOnceHoweverManyPartsReferToThem) {
  Store store = WithParts();
  const std::string bytes = AnyBytes(300'000);
  DocumentFiles::Add(store, "a", {"sheet.pdf", kPdf, bytes});
  DocumentFiles::Add(store, "b", {"https://example.org/s.pdf", "application/octet-stream", bytes});
  EXPECT_EQ(Count("file"), 1);
  EXPECT_EQ(Count("file_piece"), 2);
  EXPECT_EQ(DocumentFiles::Find(store, Sha256(bytes))->media_type, kPdf);
  const Revision head = store.Head();
  EXPECT_EQ(DocumentFiles::Add(store, "a", {"another.pdf", kPdf, bytes}).revision, head);
  EXPECT_THAT(store.Get("a")->documents, ElementsAre(Document{"sheet.pdf", Sha256(bytes)}));
}

TEST_P(DocumentsOfParts, TakeTheFileOfAReferenceThatIsThere) {
  Store store = WithParts();
  Part part = Reservoir("a");
  part.documents = {{"run.csv", Sha256("run")}, {"https://example.org/s.pdf", ""}};
  store.Replace(part);
  const Revision head = store.Head();
  EXPECT_EQ(DocumentFiles::Add(store, "a", {"", "text/csv", "run"}).revision, head);
  EXPECT_EQ(DocumentFiles::Content(store, Sha256("run")), "run");
  DocumentFiles::Add(store, "a", {"https://example.org/s.pdf", kPdf, "sheet"});
  part.documents[1].sha256 = Sha256("sheet");
  EXPECT_EQ(store.Get("a"), part);
}

TEST_P(DocumentsOfParts, AreRefusedWithTheReasonAndNothingIsKept) {
  Store store = WithParts();
  const Revision head = store.Head();
  const auto refusal = [&](const NewDocument& document) {
    const auto written = DocumentFiles::Add(store, "a", document);
    EXPECT_EQ(written.status, WriteStatus::kInvalid);
    return Details(written);
  };
  EXPECT_THAT(refusal({"s.pdf", kPdf, "sheet", Sha256("other")}),
              ElementsAre("sha256: must be that of the file, " + Sha256("sheet") + ", not \"" +
                          Sha256("other") + "\""));
  EXPECT_THAT(refusal({"s.pdf", kPdf, ""}),
              ElementsAre("file: must have 1 to 20971520 bytes, has 0"));
  EXPECT_THAT(refusal({"s.pdf", kPdf, std::string(kFileBytesMax + 1, 'x')}),
              ElementsAre("file: must have 1 to 20971520 bytes, has 20971521"));
  EXPECT_THAT(refusal({"", kPdf, "sheet"}), ElementsAre(HasSubstr("link: is missing")));
  EXPECT_THAT(refusal({"a\x01", kPdf, "sheet"}), ElementsAre(HasSubstr("control characters")));
  EXPECT_EQ(DocumentFiles::Add(store, "none", {"s.pdf", kPdf, "sheet"}).status,
            WriteStatus::kNotFound);
  EXPECT_EQ(Count("file"), 0);
  EXPECT_EQ(store.Head(), head);
}

TEST_P(DocumentsOfParts, MayHaveTheLargestSize) {
  Store store = WithParts();
  const std::string bytes = AnyBytes(kFileBytesMax);
  ASSERT_EQ(DocumentFiles::Add(store, "a", {"s.pdf", kPdf, bytes}).status, WriteStatus::kDone);
  EXPECT_TRUE(DocumentFiles::Content(store, Sha256(bytes)) == bytes);
}

TEST_P(DocumentsOfParts, OutliveUndoRemovalAndTheirPart) {
  Store store = WithParts();
  const std::int64_t added = DocumentFiles::Add(store, "a", {"s.pdf", kPdf, "s"}).revision.number;
  const std::string hash = Sha256("s");
  const auto removed = DocumentFiles::Remove(store, "a", hash, {"bob", "", ""});
  EXPECT_EQ(removed.revision.what, "remove a document of a");
  EXPECT_THAT(store.Get("a")->documents, IsEmpty());
  EXPECT_EQ(DocumentFiles::Remove(store, "a", hash).status, WriteStatus::kNotFound);
  EXPECT_EQ(DocumentFiles::Remove(store, "none", hash).status, WriteStatus::kNotFound);
  ASSERT_EQ(store.Undo(removed.revision.number, {}).status, WriteStatus::kDone);
  EXPECT_THAT(store.Get("a")->documents, ElementsAre(Document{"s.pdf", hash}));
  store.Remove("a");
  EXPECT_THAT(store.GetAt("a", added)->documents, ElementsAre(Document{"s.pdf", hash}));
  EXPECT_EQ(DocumentFiles::Content(store, hash), "s");
  for (const char* change :
       {"DELETE FROM file_piece", "DELETE FROM file", "UPDATE file SET media_type = 'text/html'"})
    EXPECT_THROW(Sql(change), SqlError) << change;
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_P(DocumentsOfParts, AKeyAddsOnce) {
  Store store = WithParts();
  const Signature once{"ann", "k", "digest"};
  const auto first = DocumentFiles::Add(store, "a", {"s.pdf", kPdf, "s"}, once);
  DocumentFiles::Remove(store, "a", Sha256("s"));
  const auto again = DocumentFiles::Add(store, "a", {"s.pdf", kPdf, "s"}, once);
  EXPECT_EQ(again.status, WriteStatus::kRepeated);
  EXPECT_EQ(again.revision, first.revision);
  EXPECT_THAT(store.Get("a")->documents, IsEmpty());
}

TEST_P(DocumentsOfParts, DamageIsFoundByItsHashAndNotCopied) {
  Store store = WithParts();
  const std::string bytes = AnyBytes(600'000);
  DocumentFiles::Add(store, "a", {"s.pdf", kPdf, bytes});
  DocumentFiles::Add(store, "b", {"t.pdf", kPdf, "sound"});
  Sql(OnServer() ? "DROP TRIGGER file_piece_is_not_changed ON file_piece"
                 : "DROP TRIGGER file_piece_is_not_changed");
  Sql(std::string("UPDATE file_piece SET content = ") + (OnServer() ? "'\\x00'" : "x'00'") +
      " WHERE place = 2");
  EXPECT_THAT(store.Check(),
              ElementsAre("file " + Sha256(bytes) + ": the content does not have its hash"));
  EXPECT_THAT(Refusal([&] { CopyCatalogue(path_, Another()); }),
              HasSubstr("would not be a true copy: file " + Sha256(bytes)));
}

TEST_P(DocumentsOfParts, AreInCopies) {
  Store store = WithParts();
  const std::string bytes = AnyBytes(3'000'000);
  DocumentFiles::Add(store, "a", {"s.pdf", kPdf, bytes});
  DocumentFiles::Add(store, "b", {"t.csv", "text/csv", "t"});
  std::vector<std::filesystem::path> copies = {folder_ / "copy.db"};
  if (test::WhyNoPostgres().empty()) copies.emplace_back(test::NewDatabase());
  for (const auto& copy : copies) CopyCatalogue(path_, copy);
  if (!OnServer()) Backup(path_, copies.emplace_back(folder_ / "backup.db"));
  for (const auto& copy : copies) {
    const Store copied(copy, Access::kRead);
    EXPECT_TRUE(DocumentFiles::Content(copied, Sha256(bytes)) == bytes);
    EXPECT_EQ(DocumentFiles::Find(copied, Sha256("t")), (KeptFile{Sha256("t"), "text/csv", 1}));
    EXPECT_THAT(copied.Check(), IsEmpty());
  }
}

PLENUM_ON_EACH_STORE(DocumentsOfParts);

}  // namespace document_files_test
}  // namespace plenum::catalog
