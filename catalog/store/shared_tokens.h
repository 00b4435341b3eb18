// The tokens of services that share a catalogue on a server, as rows.
#ifndef PLENUM_CATALOG_STORE_SHARED_TOKENS_H_
#define PLENUM_CATALOG_STORE_SHARED_TOKENS_H_

#include <memory>
#include <string>
#include <vector>

namespace plenum::catalog {

struct TokenRow {
  std::string id, name;
  std::string scope;  // "read" or "write"
  std::string hash;   // SHA-256 of its text, in hexadecimal digits
  std::string created;
  bool operator==(const TokenRow&) const = default;
};

// One connection, whose calls take turns. All throw StoreError.
class SharedTokens {
 public:
  explicit SharedTokens(const std::string& address);
  ~SharedTokens();
  SharedTokens(const SharedTokens&) = delete;
  SharedTokens& operator=(const SharedTokens&) = delete;

  std::vector<TokenRow> List() const;  // in the order of their days
  void Add(const TokenRow& token);
  bool Remove(const std::string& id);  // false where no token has the id

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SHARED_TOKENS_H_
