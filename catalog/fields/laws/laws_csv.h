// catalog/estimates/laws.csv, compiled in so that the program needs no files at run time. The
// definition is generated when CMake configures.
#ifndef PLENUM_CATALOG_FIELDS_LAWS_LAWS_CSV_H_
#define PLENUM_CATALOG_FIELDS_LAWS_LAWS_CSV_H_

#include <string_view>

namespace plenum::catalog {

std::string_view LawsCsv();

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LAWS_LAWS_CSV_H_
