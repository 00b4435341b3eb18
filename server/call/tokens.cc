#include "server/call/tokens.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/call/reply.h"
#include "server/call/request_log.h"

namespace plenum::server {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kAskServerEvery{1};

std::string RandomHex(std::size_t bytes) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::vector<unsigned char> random(bytes);
  if (getrandom(random.data(), bytes, 0) != static_cast<ssize_t>(bytes))
    throw std::runtime_error("no random numbers");
  std::string text;
  for (const unsigned char byte : random) text += {kHex[byte >> 4], kHex[byte & 15]};
  return text;
}

std::string Today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

Token FromJson(const api::Json& json) {
  return {json.at("id"), json.at("name"),
          json.at("scope") == "write" ? Scope::kWrite : Scope::kRead, json.at("sha256"),
          json.at("created")};
}

api::Json ToJson(const Token& token) {
  return {{"id", token.id},
          {"name", token.name},
          {"scope", Name(token.scope)},
          {"sha256", token.hash},
          {"created", token.created}};
}

std::vector<Token> FromRows(const std::vector<catalog::TokenRow>& rows) {
  std::vector<Token> tokens;
  tokens.reserve(rows.size());
  for (const catalog::TokenRow& row : rows)
    tokens.push_back({row.id, row.name, row.scope == "write" ? Scope::kWrite : Scope::kRead,
                      row.hash, row.created});
  return tokens;
}

// One writer at a time, and readers see the file before or after.
class Lock {
 public:
  explicit Lock(const fs::path& file)
      : fd_(open((file.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (fd_ < 0 || flock(fd_, LOCK_EX) != 0)
      throw std::runtime_error(file.string() + ": its lock cannot be taken");
  }
  ~Lock() { close(fd_); }
  Lock(const Lock&) = delete;

 private:
  int fd_;
};

void WriteTokens(const fs::path& file, const std::vector<Token>& tokens) {
  api::Json list = api::Json::array();
  for (const Token& token : tokens) list.push_back(ToJson(token));
  const std::string text = Dump({{"schema", "tokens/1"}, {"tokens", list}}, 2) + "\n";
  const fs::path fresh = file.string() + ".new";
  const int fd = open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool written =
      fd >= 0 && write(fd, text.data(), text.size()) == ssize_t(text.size()) && fsync(fd) == 0;
  if (fd >= 0) close(fd);
  if (!written || std::rename(fresh.c_str(), file.c_str()) != 0)
    throw std::runtime_error(file.string() + ": cannot be written");
}

bool EqualInConstantTime(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

}  // namespace

const char* Name(Scope scope) { return scope == Scope::kWrite ? "write" : "read"; }

fs::path TokenFile(const fs::path& catalog) {
  return catalog::IsServer(catalog) ? catalog : fs::path(catalog.string() + ".tokens");
}

std::vector<Token> ReadTokens(const fs::path& file) {
  if (catalog::IsServer(file)) return FromRows(catalog::SharedTokens(file.string()).List());
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    if (fs::exists(file)) throw std::runtime_error(file.string() + ": cannot be read");
    return {};
  }
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto json = api::ParseJson(text);
  try {
    std::vector<Token> tokens;
    for (const api::Json& token : std::get<api::Json>(json).at("tokens"))
      tokens.push_back(FromJson(token));
    return tokens;
  } catch (const std::exception&) {
    throw std::runtime_error(file.string() + ": is not a file of tokens");
  }
}

std::string CreateToken(const fs::path& file, const std::string& name, Scope scope) {
  std::string text = "plenum_" + RandomHex(32);
  const Token token{RandomHex(4), name, scope, catalog::Sha256(text), Today()};
  if (catalog::IsServer(file)) {
    catalog::SharedTokens(file.string())
        .Add({token.id, name, Name(scope), token.hash, token.created});
    return text;
  }
  const Lock lock(file);
  auto tokens = ReadTokens(file);
  tokens.push_back(token);
  WriteTokens(file, tokens);
  return text;
}

bool RevokeToken(const fs::path& file, const std::string& id) {
  if (catalog::IsServer(file)) return catalog::SharedTokens(file.string()).Remove(id);
  const Lock lock(file);
  auto tokens = ReadTokens(file);
  if (std::erase_if(tokens, [&](const Token& token) { return token.id == id; }) == 0) return false;
  WriteTokens(file, tokens);
  return true;
}

void CopyTokens(const fs::path& from, const fs::path& to) {
  const auto tokens = ReadTokens(from);
  if (tokens.empty()) return;
  if (catalog::IsServer(to)) {
    catalog::SharedTokens rows(to.string());
    for (const Token& token : tokens)
      rows.Add({token.id, token.name, Name(token.scope), token.hash, token.created});
    return;
  }
  const Lock lock(to);
  auto all = ReadTokens(to);
  all.insert(all.end(), tokens.begin(), tokens.end());
  WriteTokens(to, all);
}

TokenKeeper::TokenKeeper(fs::path file) : file_(std::move(file)) {}

TokenKeeper::~TokenKeeper() = default;

TokenKeeper::FileState TokenKeeper::StateOf(const fs::path& file) {
  struct stat state {};
  if (stat(file.c_str(), &state) != 0) return {};
  return {state.st_ino, state.st_size,
          state.st_mtim.tv_sec * std::nano::den + state.st_mtim.tv_nsec,
          state.st_ctim.tv_sec * std::nano::den + state.st_ctim.tv_nsec};
}

void TokenKeeper::RefreshFromServer() {
  const auto now = std::chrono::steady_clock::now();
  if (read_ && now - asked_ < kAskServerEvery) return;
  try {
    if (!server_) server_ = std::make_unique<catalog::SharedTokens>(file_.string());
    tokens_ = FromRows(server_->List());
    read_ = FileState();
    asked_ = now;
  } catch (const catalog::StoreError& error) {
    Log({{"level", "error"}, {"fault", error.what()}});
    if (!read_) throw;
  }
}

void TokenKeeper::Refresh() {
  if (catalog::IsServer(file_)) return RefreshFromServer();
  const FileState state = StateOf(file_);
  if (state == read_) return;
  try {
    tokens_ = ReadTokens(file_);
    read_ = state;
  } catch (const std::exception& error) {
    Log({{"level", "error"}, {"fault", error.what()}});
    if (!read_) throw;
  }
}

std::optional<Token> TokenKeeper::Find(std::string_view text) {
  const std::string hash = catalog::Sha256(text);
  const std::lock_guard lock(mutex_);
  Refresh();
  std::optional<Token> found;
  for (const Token& token : tokens_)
    if (EqualInConstantTime(token.hash, hash)) found = token;
  return found;
}

}  // namespace plenum::server
