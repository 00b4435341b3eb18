// A saved model revision: a document that api/ writes and reads, under a name and a version.
#ifndef PLENUM_CATALOG_STORE_MODEL_REVISION_H_
#define PLENUM_CATALOG_STORE_MODEL_REVISION_H_

#include <cstdint>
#include <string>
#include <string_view>

namespace plenum::catalog {

struct ModelRevision {
  std::string name;
  std::int64_t version = 0;  // 1, 2, … in the order of saving
  std::string at;            // UTC, ISO 8601
  std::string who;
  std::string document;
  std::string hash;  // SHA-256 of the document
  bool operator==(const ModelRevision&) const = default;
};

// Why the name may not be saved, or empty: 1 to 100 of a-z, 0-9, '.', '_' and '-', the first a
// letter or a digit, and not "nominal", which is the base model.
std::string WhyInvalidModelName(std::string_view name);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_MODEL_REVISION_H_
