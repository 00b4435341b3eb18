// build_catalog CSV_FOLDER DB: reads <family>.csv of every family and makes them the seed rows of
// DB. Rows that users added stay. Exit status 0, 2 on bad input (all errors are printed), 3 if the
// database cannot be written.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "catalog/fields/csv.h"
#include "catalog/fields/fields.h"
#include "catalog/store/store.h"

namespace {

using namespace plenum::catalog;

// Appends the parts of one file; false if it cannot be used.
bool ReadFamily(const std::filesystem::path& path, std::string_view family,
                std::vector<Part>& parts) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open()) {
    std::cerr << path.string() << ": cannot be read\n";
    return false;
  }
  CsvParts read = ReadCsv(family, text);
  for (const CsvError& error : read.errors)
    std::cerr << path.string() << ": row " << error.row << ", " << error.column << ": "
              << error.detail << '\n';
  parts.insert(parts.end(), read.parts.begin(), read.parts.end());
  return read.errors.empty();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: build_catalog CSV_FOLDER DB\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::vector<Part> parts;
  bool usable = true;
  for (const Family& family : Families())
    usable &= ReadFamily(folder / (std::string(family.name) + ".csv"), family.name, parts);
  if (!usable) return 2;
  try {
    Store(argv[2], Access::kWrite).ReplaceSeed(parts);
  } catch (const StoreError& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  std::cout << argv[2] << ": " << parts.size() << " seed parts\n";
  return 0;
}
