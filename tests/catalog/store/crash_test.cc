// A writer dies before every single system call that changes or syncs a file, one after the other:
// the catalogue is as it was before or as it is after, and sound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <functional>
#include <memory>

#include "catalog/store/backup.h"
#include "catalog/store/content_hash.h"
#include "catalog/store/documents/document_files.h"
#include "tests/catalog/folder.h"
#include "tests/catalog/samples.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace crash_test {

using ::testing::IsEmpty;
namespace fs = std::filesystem;

#ifdef PLENUM_SANITIZED
constexpr int kParts = 10;
#else
constexpr int kParts = 30;
#endif

// Whether a traced child is about to make such a call. (SQLite writes at offsets; a plain write
// is a sanitizer's.)
bool EntersFileChange(pid_t child) {
  __ptrace_syscall_info call{};
  ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof call, &call);
  if (call.op != PTRACE_SYSCALL_INFO_ENTRY) return false;
  switch (call.entry.nr) {
    case SYS_pwrite64:
    case SYS_ftruncate:
    case SYS_fsync:
    case SYS_fdatasync:
#ifdef SYS_unlink
    case SYS_unlink:
#endif
    case SYS_unlinkat:
      return true;
    default:
      return false;
  }
}

class Crash : public InFolder {
 protected:
  enum class End { kKilled, kDone, kFailed };

  // Runs `prepare` in a child and then what it gives, which is killed before its `call`-th change;
  // `call` becomes how many it began.
  static End KillAt(int& call, const std::function<std::function<void()>()>& prepare) {
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
    // Without TRACESYSGOOD the kernel does not tell which call a stop belongs to.
    ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
    int calls = 0;
    while (calls < call && WIFSTOPPED(status)) {
      ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
      waitpid(child, &status, 0);
      calls += WIFSTOPPED(status) && EntersFileChange(child);
    }
    call = calls;
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

  // Kills the write everywhere, each time on the catalogue as it is now, and calls `check` with
  // whether the write came to its end.
  void KillEverywhere(const std::function<std::function<void()>()>& prepare,
                      const std::function<void(bool)>& check) {
    const std::string start = Bytes(path_);
    const auto reset = [&] {
      fs::remove(path_.string() + "-journal");
      std::ofstream(path_, std::ios::binary) << start;
    };
    int total = INT_MAX;
    ASSERT_EQ(KillAt(total, prepare), End::kDone);
    check(true);
    for (int call = 1; call <= total; ++call) {
      reset();
      int begun = call;
      const End end = KillAt(begun, prepare);
      ASSERT_EQ(end, End::kKilled);
      check(false);
      if (HasFailure()) FAIL() << "killed at call " << call << " of " << total;
    }
    reset();
  }

  // The parts are those of before or those of after; some kills tore the file.
  void ExpectAllOrNothing(const std::function<std::function<void()>()>& prepare) {
    const std::vector<Part> before = Recovered();
    const std::string start = Bytes(path_);
    std::vector<Part> after;
    int kept = 0, rolled_back = 0, done = 0;
    KillEverywhere(prepare, [&](bool ended) {
      const bool touched = Bytes(path_) != start;
      const std::vector<Part> parts = Recovered();
      if (after.empty()) after = parts;  // the first run is not killed
      EXPECT_TRUE(parts == after || (!ended && parts == before));
      ++(parts == after ? done : touched ? rolled_back : kept);
    });
    EXPECT_GT(kept, 0);
    EXPECT_GT(rolled_back, 0);
    EXPECT_GT(done, 1);
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
  Write().Import(EachOf({Reservoir("a"), Reservoir("b")}), {});
  ExpectAllOrNothing(Writing([](Store& store) { store.Add(Reservoir("new")); }));
  Part other = Reservoir("a");
  other.notes = std::string(4000, 'n');
  ExpectAllOrNothing(Writing([&](Store& store) { store.Replace(other); }));
  ExpectAllOrNothing(Writing([](Store& store) { store.Remove("b"); }));
}

TEST_F(Crash, ImportingAndUndoingAreAllOrNothing) {
  std::mt19937 random(67);
  std::vector<Part> parts;
  parts.reserve(kParts);
  for (int i = 0; i < kParts; ++i)
    parts.push_back(AnyPart(*FindFamily("compressor"), "p" + std::to_string(i), random));
  Write().Add(parts.front());
  ExpectAllOrNothing(Writing([&](Store& store) {
    store.Import(EachOf(parts), {"", "key", "digest"});
  }));
  Write().Import(EachOf(parts), {});
  ExpectAllOrNothing(Writing([](Store& store) { store.Undo(store.Head().number, {}); }));
}

// Of a file that is kept its part tells, and of a part that refers to it the file is whole.
TEST_F(Crash, AddingADocumentIsAllOrNothing) {
  Write().Add(Reservoir("a"));
  const std::string bytes(700'000, 'd');
  ExpectAllOrNothing(Writing([&](Store& store) {
    DocumentFiles::Add(store, "a", {"sheet.pdf", "application/pdf", bytes});
  }));
  const Store store = Read();
  const auto kept = DocumentFiles::Content(store, Sha256(bytes));
  EXPECT_EQ(store.Get("a")->documents.empty(), !kept);
  EXPECT_TRUE(!kept || kept == bytes);
}

TEST_F(Crash, RestoringIsAllOrNothing) {
  std::mt19937 random(71);
  for (int i = 0; i < 12; ++i)
    Write().Add(AnyPart(*FindFamily("valve"), "p" + std::to_string(i), random));
  const fs::path copy = folder_ / "copy.db";
  Backup(path_, copy);
  for (int i = 0; i < 9; ++i) Write().Remove("p" + std::to_string(i));
  ExpectAllOrNothing([&]() -> std::function<void()> { return [&] { Restore(path_, copy); }; });
}

// The old or the new schema, nothing between: the old one is migrated by the next to open it.
TEST_F(Crash, MigratingIsAllOrNothing) {
  Sql(Bytes(test::SourceDir() / "tests/catalog/schema_1.sql"));
  int old = 0;
  KillEverywhere([&]() -> std::function<void()> { return [&] { Write(); }; },
                 [&](bool ended) {
                   SQLite::Database db(path_.string(), SQLite::OPEN_READWRITE);
                   const bool is_old = db.execAndGet("PRAGMA user_version").getInt() == 1;
                   EXPECT_FALSE(ended && is_old);
                   old += is_old;
                   EXPECT_EQ(Recovered().size(), 4u);
                 });
  EXPECT_GT(old, 0);
}

}  // namespace crash_test
}  // namespace plenum::catalog
