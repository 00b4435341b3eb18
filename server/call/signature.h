// Who sends a request that writes, and the key under which it acts only once.
#ifndef PLENUM_SERVER_CALL_SIGNATURE_H_
#define PLENUM_SERVER_CALL_SIGNATURE_H_

#include <variant>

#include "api/catalogue/stores.h"
#include "server/call/reply.h"

namespace plenum::server {

// The writer is the name of the token and the header From (RFC 9110), "http" without either; the
// key is Idempotency-Key, any visible ASCII text of 1 to 255 characters. The reply if one of them
// cannot be used.
std::variant<catalog::Signature, Reply> SignatureOf(const Call& call);

// 422: the key stands for another request.
Reply KeyReused();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_SIGNATURE_H_
