#include "catalog/store/server_session.h"

#include "catalog/store/connection.h"
#include "catalog/store/sql/address.h"

namespace plenum::catalog {

ServerSession::ServerSession(const std::string& address) : shown_(Shown(address)) {
  if (!IsServer(address))
    throw StoreError(shown_ + " is a file; what services share needs a server, postgresql://…");
  try {
    db_ = Connect(address, Access::kWrite);
  } catch (const SqlError& error) {
    throw ToStoreError(shown_ + ": cannot be opened for writing", error);
  } catch (const StoreError& error) {
    throw StoreError(shown_ + " " + error.what());
  }
}

}  // namespace plenum::catalog
