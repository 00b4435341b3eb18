#include "catalog/store/shared_tokens.h"

#include "catalog/store/server_session.h"

namespace plenum::catalog {

struct SharedTokens::Impl : ServerSession {
  using ServerSession::ServerSession;
};

SharedTokens::SharedTokens(const std::string& address) : impl_(std::make_unique<Impl>(address)) {}

SharedTokens::~SharedTokens() = default;

std::vector<TokenRow> SharedTokens::List() const {
  return impl_->Do(Purpose::kRead, [](SqlDatabase& db) {
    const auto query =
        Query(db, "SELECT id, name, scope, sha256, created FROM token ORDER BY created, id");
    std::vector<TokenRow> tokens;
    while (query->Step())
      tokens.push_back(
          {query->Text(0), query->Text(1), query->Text(2), query->Text(3), query->Text(4)});
    return tokens;
  });
}

void SharedTokens::Add(const TokenRow& token) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    Run(db, "INSERT INTO token VALUES (?, ?, ?, ?, ?) ON CONFLICT (sha256) DO NOTHING", token.id,
        token.name, token.scope, token.hash, token.created);
    return true;
  });
}

bool SharedTokens::Remove(const std::string& id) {
  bool found = false;  // also where the first confirmation was lost
  return impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    const auto removed = Query(db, "DELETE FROM token WHERE id = ? RETURNING id", id);
    found = removed->Step() || found;
    return found;
  });
}

}  // namespace plenum::catalog
