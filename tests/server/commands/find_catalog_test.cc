// A program without --catalog finds a catalogue wherever it is started.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/catalogue/stores.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace find_catalog_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

// The command as a package installs it, with its seed, and an empty folder to start it in.
class Installed : public testing::Test {
 protected:
  Installed() {
    fs::create_directories(bench_.Path("usr/bin"));
    fs::create_directories(bench_.Path("usr/share/plenum"));
    fs::create_directories(bench_.Path("home"));
    fs::copy_file(PLENUM_BINARY, Program());
    fs::rename(bench_.catalog(), Seed());
  }
  fs::path Program() const { return bench_.Path("usr/bin/plenum"); }
  fs::path Seed() const { return bench_.Path("usr/share/plenum/catalog.db"); }
  fs::path Users() const { return bench_.Path("home/.local/share/plenum/catalog.db"); }

  // `arguments` with these variables alone, in the empty home.
  Workbench::Outcome Run(const std::string& arguments, const std::string& variables = "") const {
    const std::string home = bench_.Path("home");
    return bench_.Run(arguments, "",
                      "cd '" + home + "' && env -i HOME='" + home + "' " + variables + " '" +
                          Program().string() + "' " + arguments +
                          " >../stdout 2>../stderr; exit $?;");
  }
  Workbench bench_;
};

TEST_F(Installed, TheUsersCatalogueBeginsAsTheSeedAndIsKept) {
  ASSERT_EQ(Run("catalog check").status, 0);
  ASSERT_TRUE(fs::exists(Users()));
  const auto seed = ReadAll(Seed());
  ASSERT_EQ(Run("catalog remove smc-s070c-6dc-32").status, 0);
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32").status, 2);  // the user's stays as it is
  EXPECT_EQ(ReadAll(Seed()), seed);
  for (const auto& entry : fs::directory_iterator(Users().parent_path()))
    EXPECT_EQ(entry.path(), Users());  // no draft is left
}

// A newer package brings a newer seed: what the user did not touch follows it.
TEST_F(Installed, AnUpgradeIsTakenOverWithoutWhatTheUserChanged) {
  const std::string other = "smc-vq110u-5m-m5", mine = "smc-s070c-6dc-32";
  ASSERT_EQ(Run("catalog check").status, 0);
  ASSERT_EQ(Run("catalog remove " + mine).status, 0);
  EXPECT_THAT(Run("catalog update").out, HasSubstr("nothing to take over"));
  {  // as a new package would, its rows changed by a seed write
    catalog::Store seed(Seed(), catalog::Access::kWrite);
    auto parts = seed.List();
    for (auto& part : parts) part.notes = "of the new seed";
    seed.ReplaceSeed(parts);
  }
  const auto dry = Run("catalog update --dry-run");
  EXPECT_THAT(dry.out, HasSubstr("nothing was written"));
  EXPECT_EQ(Run("catalog show " + other).out.find("of the new seed"), std::string::npos);
  const auto updated = Run("catalog update");
  ASSERT_EQ(updated.status, 0) << updated.err;
  EXPECT_THAT(updated.out, HasSubstr("1 yours, left as it is: " + mine));
  EXPECT_THAT(Run("catalog show " + other).out, HasSubstr("of the new seed"));
  EXPECT_EQ(Run("catalog show " + mine).status, 2);
  EXPECT_EQ(Run("catalog check").status, 0);
}

TEST_F(Installed, TheFolderForDataMayBeNamed) {
  const std::string folder = bench_.Path("data");
  ASSERT_EQ(Run("catalog check", "XDG_DATA_HOME='" + folder + "'").status, 0);
  EXPECT_TRUE(fs::exists(bench_.Path("data/plenum/catalog.db")));
  EXPECT_FALSE(fs::exists(Users()));
}

// As the unit of the service does: deploy/plenum.service.
TEST_F(Installed, TheUsersCatalogueBeginsAlsoByItsName) {
  const std::string named = bench_.Path("data/plenum/catalog.db");
  const std::string folder = bench_.Path("data");
  ASSERT_EQ(
      Run("token create one --catalog '" + named + "'", "XDG_DATA_HOME='" + folder + "'").status,
      0);
  EXPECT_TRUE(fs::exists(named));
  EXPECT_EQ(Run("catalog list --catalog ../other.db").status, 2);
}

TEST_F(Installed, WhatIsNamedComesFirst) {
  fs::copy_file(Seed(), bench_.Path("mine.db"));
  const std::string named = "PLENUM_CATALOG='" + bench_.Path("mine.db").string() + "'";
  ASSERT_EQ(Run("catalog remove smc-s070c-6dc-32", named).status, 0);
  EXPECT_FALSE(fs::exists(Users()));
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32", named).status, 2);
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32").status, 0);
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32 --catalog ../mine.db").status, 2);
  fs::copy_file(bench_.Path("mine.db"), bench_.Path("home/catalog.db"));
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32").status, 2);  // that of the folder
}

TEST_F(Installed, WithoutAFolderThatCanBeWrittenTheSeedIsRead) {
  const std::string nowhere = "XDG_DATA_HOME=/proc/nowhere";
  EXPECT_EQ(Run("catalog show smc-s070c-6dc-32", nowhere).status, 0);
  const auto refused = Run("catalog remove smc-s070c-6dc-32", nowhere);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("/proc/nowhere"));
}

TEST_F(Installed, WithoutASeedWhatIsMissingIsNamed) {
  if (fs::exists("/usr/share/plenum/catalog.db")) GTEST_SKIP() << "plenum is installed here";
  fs::remove(Seed());
  const auto refused = Run("catalog list");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("catalog.db: no such catalogue"));
}

}  // namespace find_catalog_test
}  // namespace plenum::server
