// Bearer tokens (RFC 6750): who may use the service from elsewhere. Only hashes are kept: a token
// is 256 random bits, so its plain SHA-256 can neither be turned back nor guessed.
#ifndef PLENUM_SERVER_CALL_TOKENS_H_
#define PLENUM_SERVER_CALL_TOKENS_H_

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {
class SharedTokens;
}

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

// Where the tokens of a catalogue are: the file beside it, readable by its owner only; those of a
// catalogue on a server stand there, and its address is their place.
std::filesystem::path TokenFile(const std::filesystem::path& catalog);

// None if there is no file; std::runtime_error if they cannot be read.
std::vector<Token> ReadTokens(const std::filesystem::path& file);

// Adds a token and gives its text, which is kept nowhere.
std::string CreateToken(const std::filesystem::path& file, const std::string& name, Scope scope);
// False if no token has the id.
bool RevokeToken(const std::filesystem::path& file, const std::string& id);

// Adds the tokens of one place to another that has none of them.
void CopyTokens(const std::filesystem::path& from, const std::filesystem::path& to);

// The tokens as they are: read again when their file changes, so that a revoked token ends at once,
// and once a second from a server. While they cannot be read, as where the process has too many
// files open, the tokens that were read last go on and each call tries again.
class TokenKeeper {
 public:
  explicit TokenKeeper(std::filesystem::path file);
  ~TokenKeeper();
  // The token with this text. Takes the same time wherever texts differ.
  std::optional<Token> Find(std::string_view text);

 private:
  void Refresh();
  void RefreshFromServer();

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
  std::unique_ptr<catalog::SharedTokens> server_;
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_TOKENS_H_
