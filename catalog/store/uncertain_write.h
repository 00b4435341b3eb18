// The one fault of a store after which something may have been done.
#ifndef PLENUM_CATALOG_STORE_UNCERTAIN_WRITE_H_
#define PLENUM_CATALOG_STORE_UNCERTAIN_WRITE_H_

#include "catalog/store/store_error.h"

namespace plenum::catalog {

// The connection to a server was lost while a write was being confirmed: it was done in whole or
// not at all. Who asked with a key may ask again; others look first.
class UncertainWrite : public StoreError {
 public:
  using StoreError::StoreError;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_UNCERTAIN_WRITE_H_
