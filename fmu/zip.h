// Files in a ZIP archive, stored as they are (APPNOTE 6.3, no extensions).
#ifndef PLENUM_FMU_ZIP_H_
#define PLENUM_FMU_ZIP_H_

#include <string>
#include <string_view>
#include <vector>

namespace plenum::fmu {

struct ZipEntry {
  std::string name;
  std::string_view bytes;
};

// Names and sizes below 4 GiB; all entries have the same date, so that equal files make equal
// bytes.
std::string Zip(const std::vector<ZipEntry>& entries);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_ZIP_H_
