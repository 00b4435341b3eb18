// Tests that run on each store: in a file of SQLite and on a server of PostgreSQL.
#ifndef PLENUM_TESTS_CATALOG_STORES_H_
#define PLENUM_TESTS_CATALOG_STORES_H_

#include <gtest/gtest.h>

#include <string>

#include "catalog/store/connection.h"
#include "tests/catalog/folder.h"
#include "tests/support/postgres/postgres_server.h"

namespace plenum::catalog {

enum class Engine { kSqlite, kPostgresql };

class InStore : public InFolder, public ::testing::WithParamInterface<Engine> {
 protected:
  void SetUp() override {
    if (!OnServer()) return;
    if (const std::string why = test::WhyNoPostgres(); !why.empty()) GTEST_SKIP() << why;
    path_ = test::NewDatabase();
  }
  static bool OnServer() { return GetParam() == Engine::kPostgresql; }

  // Another empty place of the same kind.
  std::filesystem::path Another() const {
    return OnServer() ? std::filesystem::path(test::NewDatabase()) : folder_ / "other.db";
  }
  // Runs SQL past the store, as another program would.
  void Sql(const std::string& sql) const { Connect(path_.string(), Access::kWrite)->Execute(sql); }
  std::int64_t Count(const std::string& table) const {
    const auto db = Connect(path_.string(), Access::kRead);
    const auto query = Query(*db, "SELECT count(*) FROM " + table);
    return query->Step() ? query->Integer(0) : -1;
  }
};

inline std::string NameOf(const ::testing::TestParamInfo<Engine>& info) {
  return info.param == Engine::kSqlite ? "Sqlite" : "Postgresql";
}

// The names end in "/Postgresql", which tests/CMakeLists.txt runs together, on one server.
#define PLENUM_ON_EACH_STORE(suite)                                                              \
  INSTANTIATE_TEST_SUITE_P(Each, suite, ::testing::Values(Engine::kSqlite, Engine::kPostgresql), \
                           NameOf)

}  // namespace plenum::catalog

#endif  // PLENUM_TESTS_CATALOG_STORES_H_
