#include "tests/server/workbench.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/support/places.h"

namespace plenum::server {

namespace fs = std::filesystem;

namespace {

int EndOf(pid_t pid, int signal) {
  kill(pid, signal);
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// What stands in a file up to its first line's end, waited for as long as a busy machine takes.
std::string FirstLine(const fs::path& path) {
  for (int i = 0; i < 6000; ++i) {
    const std::string text = ReadAll(path);
    if (const auto end = text.find('\n'); end != std::string::npos) return text.substr(0, end);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return {};
}

}  // namespace

std::string ReadAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Workbench::Workbench() {
  std::string pattern = fs::temp_directory_path() / "plenum-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
  fs::copy_file(test::SourceDir() / "catalog.db", catalog());
  unsetenv("PLENUM_CATALOG");  // of who runs the tests
}

Workbench::~Workbench() { fs::remove_all(folder_); }

fs::path Workbench::Write(const std::string& name, const std::string& text) const {
  std::ofstream(Path(name), std::ios::binary) << text;
  return Path(name);
}

Workbench::Outcome Workbench::Run(const std::string& arguments, const std::string& input,
                                  const std::string& prefix) const {
  Write("stdin", input);
  const std::string command = "cd '" + folder_.string() + "' && " + prefix +
                              " '" PLENUM_BINARY "' " + arguments + " <stdin >stdout 2>stderr";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadAll(Path("stdout")),
          ReadAll(Path("stderr"))};
}

ServeProcess::ServeProcess(const std::string& catalog, const Options& options) {
  const std::string& log = options.log;
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    const bool to_pipe = log.empty();
    dup2(to_pipe ? pipe_ends[1] : open(log.c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
    pid_ = getpid();
    if (options.file_bytes_max > 0) LimitFiles(options.file_bytes_max);
    execl(PLENUM_BINARY, "plenum", "serve", "--port", "0", "--catalog", catalog.c_str(),
          options.is_known_elsewhere ? "--allow-host=x.example" : nullptr, nullptr);
    _exit(127);
  }
  close(pipe_ends[1]);
  FILE* err = fdopen(pipe_ends[0], "r");
  char line[256] = {};
  if (log.empty() && std::fgets(line, sizeof line, err) == nullptr) line[0] = 0;
  std::fclose(err);
  const std::string first = log.empty() ? line : FirstLine(log);
  if (std::sscanf(first.c_str(), "plenum listens at http://127.0.0.1:%d/", &port_) != 1)
    throw std::runtime_error("serve did not start: " + first);
}

void ServeProcess::LimitFiles(unsigned long bytes_max) const {
  const rlimit limit{bytes_max, RLIM_INFINITY};
  prlimit(pid_, RLIMIT_FSIZE, &limit, nullptr);
}

ServeProcess::~ServeProcess() {
  if (pid_ > 0) End(SIGKILL);
}

int ServeProcess::End(int signal) { return EndOf(std::exchange(pid_, -1), signal); }

WorkerProcess::WorkerProcess(const std::string& catalog, int lease_s) : pid_(fork()) {
  if (pid_ != 0) return;
  if (freopen("/dev/null", "w", stderr) == nullptr) _exit(127);
  execl(PLENUM_BINARY, "plenum", "worker", "--threads", "1", "--lease",
        std::to_string(lease_s).c_str(), "--catalog", catalog.c_str(), nullptr);
  _exit(127);
}

WorkerProcess::~WorkerProcess() {
  if (pid_ > 0) End(SIGKILL);
}

int WorkerProcess::End(int signal) { return EndOf(std::exchange(pid_, -1), signal); }

api::Json Example(const std::string& name, double time_limit_s) {
  const auto text = ReadAll(test::SourceDir() / "examples" / (name + ".json"));
  auto json = std::get<api::Json>(api::ParseJson(text));
  json["ranking"] = {{"count", 2}, {"time_limit_s", time_limit_s}};
  return json;
}

api::Json Exosuit(double time_limit_s) { return Example("exosuit", time_limit_s); }
api::Json SlowToProve(double time_limit_s) {
  api::Json request = Example("exosuit", time_limit_s);
  request["objective"] = {{"minimize", "volume_l"}};
  request["ranking"]["count"] = 100;
  return request;
}

api::Json NewFitting(const std::string& id) {
  return {{"id", id},
          {"family", "fitting"},
          {"manufacturer", "bench"},
          {"part_number", "F1"},
          {"tube_outer_diameter_mm", 4.0},
          {"sonic_conductance_dm3_per_s_bar", 0.31},
          {"critical_ratio", 0.4},
          {"mass_kg", 0.003},
          {"body_volume_ml", 0.7},
          {"pressure_max_kpa_gauge", 800.0},
          {"thread", "M5"}};
}

}  // namespace plenum::server
