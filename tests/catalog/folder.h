// A folder of its own for a test of the catalogue, gone with the test.
#ifndef PLENUM_TESTS_CATALOG_FOLDER_H_
#define PLENUM_TESTS_CATALOG_FOLDER_H_

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "catalog/store/store.h"

namespace plenum::catalog {

class InFolder : public ::testing::Test {
 protected:
  InFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "plenum_cat_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "catalog.db";
  }
  ~InFolder() override { std::filesystem::remove_all(folder_); }

  Store Write() const { return Store(path_, Access::kWrite); }
  Store Read() const { return Store(path_, Access::kRead); }

  // Runs SQL past the store, as another program would.
  void Sql(const std::string& sql) const {
    SQLite::Database db(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    db.exec(sql);
  }

  static std::string Bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // What the store says when `action` fails.
  template <class Action>
  static std::string Refusal(const Action& action) {
    try {
      action();
      return "";
    } catch (const StoreError& error) {
      return error.what();
    }
  }

  std::filesystem::path folder_, path_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_TESTS_CATALOG_FOLDER_H_
