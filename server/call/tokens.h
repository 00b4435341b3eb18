// Bearer tokens (RFC 6750): who may use the service from elsewhere. Only hashes are kept: a token
// is 256 random bits, so its plain SHA-256 can neither be turned back nor guessed.
#ifndef PLENUM_SERVER_CALL_TOKENS_H_
#define PLENUM_SERVER_CALL_TOKENS_H_

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::server {

enum class Scope { kRead, kWrite };  // writing includes reading
const char* Name(Scope scope);

struct Token {
  std::string id;    // eight characters, to name it
  std::string name;  // whose it is; stands in the history of what it writes
  Scope scope = Scope::kRead;
  std::string hash;     // SHA-256 in hexadecimal digits
  std::string created;  // date
};

// The file beside a catalogue; readable by its owner only.
std::filesystem::path TokenFile(const std::filesystem::path& catalog);

// None if there is no file; std::runtime_error if it cannot be read.
std::vector<Token> ReadTokens(const std::filesystem::path& file);

// Adds a token and gives its text, which is kept nowhere.
std::string CreateToken(const std::filesystem::path& file, const std::string& name, Scope scope);
// False if no token has the id.
bool RevokeToken(const std::filesystem::path& file, const std::string& id);

// The tokens of a file as it is: read again when it changes, so that a revoked token ends at once.
// While the file cannot be read, as where the process has too many open, the tokens that were read
// last go on and each call tries again.
class TokenKeeper {
 public:
  explicit TokenKeeper(std::filesystem::path file) : file_(std::move(file)) {}
  // The token with this text. Takes the same time wherever texts differ.
  std::optional<Token> Find(std::string_view text);

 private:
  void Refresh();

  const std::filesystem::path file_;
  std::mutex mutex_;
  // What the file system said of the file that was read.
  struct FileState {
    std::uint64_t inode = 0;
    std::int64_t size = 0, written_ns = 0, changed_ns = 0;
    bool operator==(const FileState&) const = default;
  };
  static FileState StateOf(const std::filesystem::path& file);
  std::optional<FileState> read_;
  std::vector<Token> tokens_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_TOKENS_H_
