#include "tests/support/postgres/postgres_server.h"

#include <grp.h>
#include <pwd.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catalog/store/sql/address.h"

namespace plenum::test {
namespace {

namespace fs = std::filesystem;

constexpr char kPrograms[] = "/usr/lib/postgresql/15/bin/";
constexpr int kTries = 300;  // of 100 ms

// Runs the program as the user postgres where this one is root, which the server refuses.
pid_t Start(std::vector<std::string> words) {
  words.front() = kPrograms + words.front();
  const pid_t child = fork();
  if (child != 0) return child;
  if (geteuid() == 0) {
    const passwd* user = getpwnam("postgres");
    if (user == nullptr || initgroups("postgres", user->pw_gid) != 0 || setgid(user->pw_gid) != 0 ||
        setuid(user->pw_uid) != 0)
      _exit(1);
  }
  prctl(PR_SET_PDEATHSIG, SIGQUIT);
  if (freopen("/dev/null", "w", stdout) == nullptr || freopen("/dev/null", "w", stderr) == nullptr)
    _exit(1);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(argv.front(), argv.data());
  _exit(1);
}

bool RunToEnd(const std::vector<std::string>& words) {
  int status = 0;
  return waitpid(Start(words), &status, 0) > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

class Server {
 public:
  Server() {
    std::string name = (fs::temp_directory_path() / "plenum_pg_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    if (const passwd* user = geteuid() == 0 ? getpwnam("postgres") : nullptr)
      if (chown(folder_.c_str(), user->pw_uid, user->pw_gid) != 0)
        throw std::runtime_error("the folder of PostgreSQL cannot be given to its user");
    if (!RunToEnd({"initdb", "-D", Data(), "-A", "trust", "-U", "plenum", "-N", "-E", "UTF8",
                   "--locale=C.UTF-8", "--locale-provider=icu", "--icu-locale=en-US"}))
      throw std::runtime_error("initdb failed");
    Begin();
  }
  ~Server() {
    End(SIGINT);
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  void Begin() {
    server_ = Start({"postgres", "-D", Data(), "-k", folder_.string(), "-c",
                     "listen_addresses=", "-c", "fsync=off", "-c", "max_connections=200"});
    for (int i = 0; i < kTries; ++i) {
      if (RunToEnd({"pg_isready", "-q", "-h", folder_.string()})) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    throw std::runtime_error("PostgreSQL does not start");
  }
  void End(int signal) {
    kill(server_, signal);
    waitpid(server_, nullptr, 0);
  }
  void Sql(const std::string& sql) {
    if (!RunToEnd(
            {"psql", "-q", "-h", folder_.string(), "-U", "plenum", "-d", "postgres", "-c", sql}))
      throw std::runtime_error("psql failed: " + sql);
  }
  std::string NewDatabase() {
    const std::string name = "test" + std::to_string(++databases_);
    Sql("CREATE DATABASE " + name);
    return "postgresql://plenum@/" + name + "?host=" + folder_.string();
  }

 private:
  std::string Data() const { return (folder_ / "data").string(); }

  fs::path folder_;
  pid_t server_ = 0;
  int databases_ = 0;
};

Server& TheServer() {
  static Server server;
  return server;
}

}  // namespace

std::string WhyNoPostgres() {
  if (!catalog::KnowsServers()) return "plenum was built without libpq-dev";
  if (!fs::exists(std::string(kPrograms) + "initdb"))
    return "PostgreSQL 15 is not installed (Debian's postgresql-15): " + std::string(kPrograms) +
           "initdb is not there";
  return "";
}

std::string NewDatabase() { return TheServer().NewDatabase(); }

void CrashPostgres() {
  TheServer().End(SIGQUIT);
  TheServer().Begin();
}

void WhilePostgresIsAway(const std::function<void()>& run) {
  TheServer().End(SIGQUIT);
  run();
  TheServer().Begin();
}

void CutSessions() {
  TheServer().Sql(
      "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
      "WHERE pid <> pg_backend_pid() AND backend_type = 'client backend'");
}

}  // namespace plenum::test
