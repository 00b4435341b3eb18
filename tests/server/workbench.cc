#include "tests/server/workbench.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
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

ServeProcess::ServeProcess(const std::string& catalog, unsigned long file_bytes_max) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    dup2(pipe_ends[1], STDERR_FILENO);
    pid_ = getpid();
    if (file_bytes_max > 0) LimitFiles(file_bytes_max);
    execl(PLENUM_BINARY, "plenum", "serve", "--port", "0", "--catalog", catalog.c_str(), nullptr);
    _exit(127);
  }
  close(pipe_ends[1]);
  FILE* err = fdopen(pipe_ends[0], "r");
  char line[256] = {};
  if (std::fgets(line, sizeof line, err) == nullptr ||
      std::sscanf(line, "plenum listens at http://127.0.0.1:%d/", &port_) != 1) {
    throw std::runtime_error(std::string("serve did not start: ") + line);
  }
  std::fclose(err);
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
