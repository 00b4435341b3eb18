// The file of a document of a part, kept under the hash of its content.
#ifndef PLENUM_CATALOG_STORE_DOCUMENTS_KEPT_FILE_H_
#define PLENUM_CATALOG_STORE_DOCUMENTS_KEPT_FILE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace plenum::catalog {

inline constexpr std::size_t kFileBytesMax = 20 << 20;

struct KeptFile {
  std::string sha256;  // of the content: 64 hexadecimal digits
  std::string media_type;
  std::int64_t bytes = 0;
  bool operator==(const KeptFile&) const = default;
};

// A document to be added to a part, with its file.
struct NewDocument {
  std::string link;  // where it was found, or a file name; may be empty where the part refers to
                     // the content already
  std::string media_type;    // such as application/pdf
  std::string_view content;  // 1 to kFileBytesMax bytes
  std::string sha256 = {};   // what the content should have; empty: not known
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_DOCUMENTS_KEPT_FILE_H_
