// A writer dies at every single system call of a write, one after the other: the catalogue is as it
// was before or as it is after, and sound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <functional>
#include <memory>

#include "catalog/backup.h"
#include "folder.h"
#include "samples.h"

namespace plenum::catalog {
namespace {

using ::testing::IsEmpty;
namespace fs = std::filesystem;

#ifdef PLENUM_SANITIZED
constexpr int kStride = 7;
#else
constexpr int kStride = 1;
#endif

class Crash : public InFolder {
 protected:
  enum class End { kKilled, kDone, kFailed };

  // Runs `prepare` in a child and then what it gives, which is killed at the `stop`-th time that it
  // enters or leaves the kernel.
  static End KillAt(int stop, const std::function<std::function<void()>()>& prepare) {
    const pid_t child = fork();
    if (child == 0) {
      if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(2);
      const std::function<void()> act = prepare();
      raise(SIGSTOP);
      act();
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    for (int i = 0; i < stop && WIFSTOPPED(status); ++i) {
      ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
      waitpid(child, &status, 0);
    }
    if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? End::kDone : End::kFailed;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return End::kKilled;
  }

  // The parts afterwards; the catalogue must be sound.
  std::vector<Part> Recovered() const {
    const Store store = Read();
    EXPECT_THAT(store.Check(), IsEmpty());
    return store.List();
  }

  // Kills the write at every `stride`-th stop; each time the catalogue starts as it is now.
  void KillEverywhere(const std::function<std::function<void()>()>& prepare, int stride = kStride) {
    const std::string start = Bytes(path_);
    const auto reset = [&] {
      fs::remove(path_.string() + "-journal");
      std::ofstream(path_, std::ios::binary) << start;
    };
    ASSERT_EQ(KillAt(INT_MAX, prepare), End::kDone);
    const std::vector<Part> after = Recovered();
    reset();
    const std::vector<Part> before = Recovered();
    int undone = 0, rolled_back = 0, done = 0;
    for (int stop = 1;; stop += stride) {
      reset();
      const End end = KillAt(stop, prepare);
      ASSERT_NE(end, End::kFailed);
      const bool torn = fs::exists(path_.string() + "-journal");
      const std::vector<Part> parts = Recovered();
      ASSERT_TRUE(parts == before || parts == after) << "killed at stop " << stop;
      if (end == End::kDone) {
        ASSERT_EQ(parts, after);
        break;
      }
      ++(parts == after ? done : torn ? rolled_back : undone);
    }
    EXPECT_GT(undone, 0);
    EXPECT_GT(rolled_back, 0);  // the journal was needed
    EXPECT_GT(done, 0);
    reset();
  }

  // A write to the catalogue as it is.
  std::function<std::function<void()>()> Writing(const std::function<void(Store&)>& write) const {
    return [this, write]() -> std::function<void()> {
      const auto store = std::make_shared<Store>(path_, Access::kWrite);
      return [store, write] { write(*store); };
    };
  }
};

TEST_F(Crash, AddingReplacingAndRemovingAreAllOrNothing) {
  Write().Import({Reservoir("a"), Reservoir("b")}, {});
  KillEverywhere(Writing([](Store& store) { store.Add(Reservoir("new")); }));
  Part other = Reservoir("a");
  other.notes = std::string(4000, 'n');
  KillEverywhere(Writing([&](Store& store) { store.Replace(other); }));
  KillEverywhere(Writing([](Store& store) { store.Remove("b"); }));
}

TEST_F(Crash, ImportingAndUndoingAreAllOrNothing) {
  std::mt19937 random(67);
  std::vector<Part> parts;
  for (int i = 0; i < 60; ++i)
    parts.push_back(AnyPart(*FindFamily("compressor"), "p" + std::to_string(i), random));
  Write().Add(parts.front());
  KillEverywhere(Writing([&](Store& store) {
                   store.Import(parts, {"", "key", "digest"});
                 }),
                 9 * kStride);
  Write().Import(parts, {});
  KillEverywhere(Writing([](Store& store) { store.Undo(store.Head().number, {}); }), 9 * kStride);
}

TEST_F(Crash, RestoringIsAllOrNothing) {
  std::mt19937 random(71);
  for (int i = 0; i < 20; ++i)
    Write().Add(AnyPart(*FindFamily("valve"), "p" + std::to_string(i), random));
  const fs::path copy = folder_ / "copy.db";
  Backup(path_, copy);
  for (int i = 0; i < 15; ++i) Write().Remove("p" + std::to_string(i));
  KillEverywhere([&]() -> std::function<void()> { return [&] { Restore(path_, copy); }; },
                 17 * kStride);
}

TEST_F(Crash, MigratingIsAllOrNothing) {
  const std::string sql = Bytes(fs::path(PLENUM_SOURCE_DIR) / "tests/catalog/schema_1.sql");
  Sql(sql);
  const std::string old = Bytes(path_);
  const auto migrate = [&]() -> std::function<void()> { return [&] { Write(); }; };
  int killed = 0;
  for (int stop = 1;; stop += 2 * kStride, ++killed) {
    std::ofstream(path_, std::ios::binary) << old;
    fs::remove(path_.string() + "-journal");
    const End end = KillAt(stop, migrate);
    ASSERT_NE(end, End::kFailed);
    // The old or the new schema, nothing between: the old one is migrated by the next to open it.
    EXPECT_EQ(Recovered().size(), 4u);
    if (end == End::kDone) break;
  }
  EXPECT_GT(killed, 20);
}

}  // namespace
}  // namespace plenum::catalog
