// What became of a write to the catalogue.
#ifndef PLENUM_CATALOG_STORE_WRITE_RESULT_H_
#define PLENUM_CATALOG_STORE_WRITE_RESULT_H_

#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/store/revision.h"

namespace plenum::catalog {

enum class WriteStatus {
  kDone,
  kRepeated,    // the signature's key and request were done before; nothing was written
  kInvalid,     // see errors
  kExists,      // the id is taken
  kNotFound,    // no part has the id, no revision the number
  kChanged,     // the precondition does not hold
  kSuperseded,  // undo: a part was changed again since; errors name them
  kKeyReused    // the key stands for another request
};
struct WriteResult {
  WriteStatus status = WriteStatus::kDone;
  std::vector<FieldError> errors;
  Revision revision;  // kDone, kRepeated: the one that holds the write
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_WRITE_RESULT_H_
