#include "server/call/signature.h"

#include <algorithm>
namespace plenum::server {
namespace {

constexpr std::size_t kWriterLongest = 200;
constexpr std::size_t kKeyLongest = 255;

bool IsVisibleAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

// What a key stands for: everything that decides what the request does.
std::string DigestOf(const Call& call) {
  std::string request = call.path + "\n";
  for (const auto& [name, value] : call.query) request += name + "=" + value + "\n";
  return catalog::Sha256(request + "\n" + catalog::Sha256(call.body));
}

}  // namespace

std::variant<catalog::Signature, Reply> SignatureOf(const Call& call) {
  catalog::Signature signature;
  signature.who = call.header("From").value_or("http");
  // A token says whose it is; From then only adds to it.
  if (!call.user.empty())
    signature.who = call.header("From") ? call.user + " (" + signature.who + ")" : call.user;
  if (signature.who.size() > kWriterLongest || !IsVisibleAscii(signature.who))
    return ProblemReply(400, "From must be at most 200 characters of visible ASCII");
  const auto key = call.header("Idempotency-Key");
  if (!key) return signature;
  if (key->empty() || key->size() > kKeyLongest || !IsVisibleAscii(*key))
    return ProblemReply(400, "Idempotency-Key must be 1 to 255 characters of visible ASCII");
  signature.key = *key;
  signature.request = DigestOf(call);
  return signature;
}

Reply KeyReused() {
  return ProblemReply(422, "the Idempotency-Key was used for another request; choose a new one");
}

}  // namespace plenum::server
