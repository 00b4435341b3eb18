// Saved model revisions: versions of a name, never lost, never changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/store/content_hash.h"
#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace models_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

using Models = InStore;

std::vector<std::string> Documents(const std::vector<ModelRevision>& models) {
  std::vector<std::string> documents;
  for (const ModelRevision& model : models) documents.push_back(model.document);
  return documents;
}

TEST_P(Models, SavingANameAgainAddsAVersion) {
  Store store = Write();
  const ModelRevision first = store.SaveModel("bench", "{\"a\":1}", "ann");
  EXPECT_EQ(first.version, 1);
  EXPECT_EQ(first.who, "ann");
  EXPECT_EQ(first.hash, Sha256("{\"a\":1}"));
  EXPECT_EQ(store.SaveModel("bench", "{\"a\":2}", "bob").version, 2);
  store.SaveModel("anvil", "{}", "");
  EXPECT_THAT(Documents(store.Models()), ElementsAre("{}", "{\"a\":2}"));
  EXPECT_THAT(Documents(store.ModelVersions("bench")), ElementsAre("{\"a\":2}", "{\"a\":1}"));
  EXPECT_EQ(store.FindModel("bench")->version, 2);
  EXPECT_EQ(store.FindModel("bench", 1), first);
  EXPECT_FALSE(store.FindModel("bench", 3));
  EXPECT_FALSE(store.FindModel("none"));
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_P(Models, AKeySavesOnce) {
  Store store = Write();
  const Signature once{"ann", "k", "digest"};
  const auto first = store.SaveModel("bench", "{}", once);
  EXPECT_EQ(first->who, "ann");
  store.SaveModel("bench", "[]", "bob");
  EXPECT_EQ(store.SaveModel("bench", "{}", once), first);  // not a step back to it
  EXPECT_EQ(store.FindModel("bench")->document, "[]");
  EXPECT_FALSE(store.SaveModel("bench", "{}", Signature{"ann", "k", "another"}));
  EXPECT_EQ(store.ModelVersions("bench").size(), 2u);
  EXPECT_EQ(store.Head().number, 0);
}

TEST_P(Models, TheSameDocumentIsNoNewVersion) {
  Store store = Write();
  const ModelRevision first = store.SaveModel("bench", "{}", "ann");
  EXPECT_EQ(store.SaveModel("bench", "{}", "bob"), first);
  store.SaveModel("bench", "[]", "ann");
  EXPECT_EQ(store.SaveModel("bench", "{}", "ann").version, 3);  // back to the first: a step again
}

TEST_P(Models, LeaveTheRevisionOfThePartsAlone) {
  Store store = Write();
  store.Add(Reservoir("r"));
  const Revision head = store.Head();
  store.SaveModel("bench", "{}", "");
  EXPECT_EQ(store.Head(), head);
  EXPECT_THAT(Read().Models(), SizeIs(1));
}

TEST_P(Models, AreNeitherChangedNorDeletedAndDamageIsFound) {
  Write().SaveModel("bench", "{}", "");
  EXPECT_THAT([&] { Sql("DELETE FROM model"); },
              ThrowsMessage<SqlError>(HasSubstr("never deleted")));
  EXPECT_THAT([&] { Sql("UPDATE model SET document = '[]'"); },
              ThrowsMessage<SqlError>(HasSubstr("never changed")));
  Sql(std::string("DROP TRIGGER model_is_not_changed") + (OnServer() ? " ON model" : "") +
      "; UPDATE model SET document = '[]'");
  EXPECT_THAT(Read().Check(), ElementsAre(HasSubstr("model bench, version 1")));
}

TEST(ModelNames, AreChecked) {
  for (const char* name : {"bench", "7", "a.b_c-d"}) EXPECT_EQ(WhyInvalidModelName(name), "");
  for (const char* name : {"", "Bench", "-a", "a b", "a/b", "nominal", "ä"})
    EXPECT_NE(WhyInvalidModelName(name), "") << name;
  EXPECT_NE(WhyInvalidModelName(std::string(101, 'a')), "");
}

PLENUM_ON_EACH_STORE(Models);

}  // namespace models_test
}  // namespace plenum::catalog
