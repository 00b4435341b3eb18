// What only a catalogue on a server meets: sessions that end, strangers' databases, passwords.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "catalog/store/seed/seed_update.h"
#include "catalog/store/shared_tokens.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/sql/postgres_database.h"
#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace postgres_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class OnPostgres : public InStore {
 protected:
  std::unique_ptr<SqlDatabase> Server() const { return ConnectToServer(path_.string()); }
};

TEST_P(OnPostgres, GoesOnAfterItsSessionsWereCut) {
  Store store = Write();
  store.Add(Reservoir("a"));
  test::CutSessions();
  EXPECT_THAT(store.List(), SizeIs(1));
  test::CutSessions();
  EXPECT_EQ(store.Add(Reservoir("b")).status, WriteStatus::kDone);
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_P(OnPostgres, KeepsWhatWasAcknowledgedBeforeTheServerDied) {
  Store store = Write();
  store.Add(Reservoir("a"));
  test::CrashPostgres();
  EXPECT_EQ(store.Get("a"), Reservoir("a"));
  EXPECT_EQ(store.Add(Reservoir("b")).status, WriteStatus::kDone);
  EXPECT_EQ(store.Head().number, 2);
  EXPECT_THAT(store.Check(), IsEmpty());
}

// The precondition cuts the session of the write that it belongs to.
TEST_P(OnPostgres, DoesNothingOfAWriteThatLostItsSession) {
  Store store = Write();
  store.Add(Reservoir("a"));
  Part other = Reservoir("a");
  other.notes = "other";
  const auto cut = [](const Part&) {
    test::CutSessions();
    return true;
  };
  const std::string why = Refusal([&] { store.Replace(other, {}, cut); });
  EXPECT_THAT(why, HasSubstr("the connection to the server was lost"));
  EXPECT_EQ(store.Get("a"), Reservoir("a"));
  EXPECT_EQ(store.Head().number, 1);
}

// The session is cut in the midst of a commit.
TEST_P(OnPostgres, SaysSoWhereAWriteMayOrMayNotHaveBeenDone) {
  Store store = Write();
  Server()->Execute(
      "CREATE FUNCTION cut() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM "
      "pg_terminate_backend(pg_backend_pid()); RETURN NULL; END $$; CREATE CONSTRAINT TRIGGER cut "
      "AFTER INSERT ON revision DEFERRABLE INITIALLY DEFERRED FOR EACH ROW EXECUTE FUNCTION cut()");
  const Signature by{"ann", "key", "digest"};
  EXPECT_THROW(store.Add(Reservoir("a"), by), UncertainWrite);
  Server()->Execute("DROP TRIGGER cut ON revision");
  EXPECT_EQ(store.Add(Reservoir("a"), by).status, WriteStatus::kDone);
  EXPECT_EQ(store.Add(Reservoir("a"), by).status, WriteStatus::kRepeated);
  EXPECT_EQ(store.Head().number, 1);
}

TEST_P(OnPostgres, AWriteBehindAnotherWaitsAndThenSaysThatItIsBusy) {
  Store store = Write();
  const auto other = Server();
  const SqlTransaction held(*other, Purpose::kWrite);
  store.WaitForLocks(std::chrono::milliseconds(50));
  try {
    store.Add(Reservoir("a"));
    FAIL();
  } catch (const StoreError& error) {
    EXPECT_EQ(error.fault(), StoreFault::kBusy);
  }
  EXPECT_THAT(store.List(), IsEmpty());  // who reads does not wait
}

TEST_P(OnPostgres, ASecondStatementKeepsTheRowsOfTheFirst) {
  const auto db = Server();
  const SqlTransaction reading(*db, Purpose::kRead);
  const auto rows = Query(*db, "SELECT n FROM generate_series(1, ?) AS n", 100);
  std::int64_t sum = 0;
  while (rows->Step()) {
    sum += rows->Integer(0);
    if (rows->Integer(0) == 3) {
      EXPECT_TRUE(Query(*db, "SELECT 1")->Step());
    }
  }
  EXPECT_EQ(sum, 5050);
  const auto fails = Query(*db, "SELECT 1 / (5 - n) FROM generate_series(1, 9) AS n");
  EXPECT_TRUE(fails->Step());
  Query(*db, "SELECT 1");
  EXPECT_THROW(
      {
        while (fails->Step()) {
        }
      },
      SqlError);
}

TEST_P(OnPostgres, RefusesADatabaseOfAnotherProgramAndANewerSchema) {
  EXPECT_THAT(Refusal([&] { Read(); }), HasSubstr("holds no catalogue yet"));
  Server()->Execute("CREATE TABLE theirs (x int)");
  EXPECT_THAT(Refusal([&] { Write(); }), HasSubstr("tables of another program"));
  Server()->Execute("DROP TABLE theirs");
  Write();
  Sql("INSERT INTO migration SELECT n, 'later ' || n, '' FROM generate_series(98, 99) AS n");
  EXPECT_THAT(Refusal([&] { Write(); }), HasSubstr("use a newer program"));
}

TEST_P(OnPostgres, FollowsANewerSeed) {
  const std::filesystem::path seed = folder_ / "seed.db";
  Store(seed, Access::kWrite).ReplaceSeed({Reservoir("a"), Reservoir("b")});
  Write().Add(Reservoir("b"));
  const SeedUpdate update = UpdateSeed(path_, seed, "me", false);
  EXPECT_THAT(update.plan.added, ::testing::ElementsAre("a"));
  EXPECT_THAT(update.plan.kept, ::testing::ElementsAre("b"));
  EXPECT_THAT(Read().Check(), IsEmpty());
}

TEST_P(OnPostgres, KeepsTokensThroughCuts) {
  SharedTokens tokens(path_.string());
  const TokenRow one{"0123abcd", "laptop", "write", std::string(64, 'a'), "2026-01-31"};
  tokens.Add(one);
  test::CutSessions();
  EXPECT_THAT(SharedTokens(path_.string()).List(), ::testing::ElementsAre(one));
  EXPECT_THAT(tokens.List(), SizeIs(1));
  EXPECT_TRUE(tokens.Remove("0123abcd"));
  EXPECT_FALSE(tokens.Remove("0123abcd"));
  EXPECT_THAT(Refusal([&] { SharedTokens((folder_ / "a.db").string()); }), HasSubstr("is a file"));
}

INSTANTIATE_TEST_SUITE_P(Each, OnPostgres, ::testing::Values(Engine::kPostgresql), NameOf);

TEST(Addresses, AreShownWithoutTheirPassword) {
  if (!KnowsServers()) GTEST_SKIP() << test::WhyNoPostgres();
  const std::string secret = "postgresql://ann:s3cret@db.example:5433/parts?sslmode=require";
  EXPECT_EQ(Shown(secret), "postgresql://ann@db.example:5433/parts");
  EXPECT_EQ(Shown("postgresql:///parts?host=/run/pg&password=s3cret"),
            "postgresql:///parts?host=/run/pg");
  EXPECT_EQ(Shown("a/catalog.db"), "a/catalog.db");
  EXPECT_TRUE(IsServer("postgres://x/y"));
  EXPECT_FALSE(IsServer("./postgresql/catalog.db"));
}

TEST(Addresses, AreRefusedWithoutTheirPassword) {
  for (const char* address :
       {"postgresql://ann:s3cret@127.0.0.1:1/parts", "postgresql://ann:s3cret@h:port/parts",
        "postgresql://ann:s3cret@[::1/parts", "postgresql://ann:s3cret@h/d?s3cret=s3cret",
        "postgresql://ann:s3cret%zz@h/d"}) {
    try {
      const Store store(address, Access::kRead);
      ADD_FAILURE() << address;
    } catch (const StoreError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("cannot be opened"), Not(HasSubstr("s3cret"))));
      // An address that is no address is not away.
      EXPECT_EQ(error.fault() == StoreFault::kAway,
                std::string_view(address) == "postgresql://ann:s3cret@127.0.0.1:1/parts")
          << address;
    }
  }
}

}  // namespace postgres_test
}  // namespace plenum::catalog
