// Jobs that crash the program, each service in a process of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "calibration/values/parallel.h"
#include "server/jobs/crash_marks.h"
#include "server/jobs/job_recovery.h"
#include "server/jobs/jobs.h"
#include "tests/server/jobs/waiting.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace job_crash_test {

using namespace std::chrono_literals;
using catalog::JobOrder;
using testing::HasSubstr;

int Deep(int depth) {
  volatile char block[4096];
  block[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : Deep(depth + 1) + block[0];
}

// What an order asks for. All but "ready" end the program.
api::Json Do(const JobOrder& order) {
  if (order.request == "sent") std::raise(SIGSEGV);
  if (order.request == "address") *reinterpret_cast<volatile int*>(8) = 1;
  if (order.request == "overflow") return Deep(1);
  if (order.request == "abort") std::abort();
  if (order.request == "thread")
    calibration::ForAll(2, 2, [caller = std::this_thread::get_id()](std::size_t) {
      if (std::this_thread::get_id() == caller)
        std::this_thread::sleep_for(60s);  // the other thread ends the program
      Deep(1);
    });
  std::this_thread::sleep_for(100ms);
  return {{"done", order.request}};
}

class JobCrash : public testing::Test {
 protected:
  JobCrash() { bench_.Write("together", ""); }

  std::filesystem::path Marks() const { return CrashFile(bench_.Path("catalog")); }
  std::unique_ptr<catalog::JobStore> Store() const {
    return std::make_unique<catalog::JobStore>(bench_.Path("catalog-jobs"), catalog::JobsKept());
  }
  void Add(const std::string& request) const {
    JobOrder order;
    order.kind = "design";
    order.request = request;
    order.hash = std::string(64, 'a');
    Store()->Add(request, order);
  }
  catalog::JobRecord OnDisk(const std::string& id) const {
    return Store()->Find("design", id).value();
  }

  // A service that does all jobs there are, two at a time where it may, and stops when they ended.
  // "bad" jobs wait until another runs, if one does. The signal that ended the service, or 0.
  int Serve() const {
    const pid_t child = fork();
    if (child == 0) ServeInChild();
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }

  const Workbench bench_;

 private:
  [[noreturn]] void ServeInChild() const {
    {
      const auto store = Store();
      RecoverJobs(*store, Marks());
      const CrashMarks marks(Marks());
      std::atomic<int> running = 0;
      std::atomic<bool> told = false;
      JobTurns turns;
      Jobs jobs(*store, turns, "design",
                [&](const JobOrder& order, const JobControl&) -> api::Parsed<api::Json> {
                  // Once: a third may begin while a sanitizer still reports the first one's end.
                  if (++running > 1 && !told.exchange(true))
                    std::ofstream(bench_.Path("together"), std::ios::app) << "x";
                  std::this_thread::sleep_for(50ms);  // so that both that may run do
                  auto result = Do(order);
                  --running;
                  return result;
                },
                {});
      for (const Job& job : jobs.List()) WaitForEnd(jobs, job.id, 60s);
    }
    _exit(0);
  }
};

// Under a sanitizer the program ends by its report.
void ExpectEndedBy(int signal, int ended) {
#ifdef PLENUM_SANITIZED
  EXPECT_NE(ended, 0) << signal;
#else
  EXPECT_EQ(ended, signal);
#endif
}

TEST_F(JobCrash, IsBegunAgainOnceAloneAndThenFails) {
  Add("sent");
  Add("ready");
  Add("ready too");
  ExpectEndedBy(SIGSEGV, Serve());
  EXPECT_EQ(ReadAll(bench_.Path("together")), "x");  // the first two ran side by side
  const auto marks = ReadCrashMarks(Marks());
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].job, OnDisk("sent").number);
  EXPECT_EQ(marks[0].signal, SIGSEGV);
  EXPECT_NEAR(double(marks[0].at_s), double(std::time(nullptr)), 600.0);

  bench_.Write("together", "");
  ExpectEndedBy(SIGSEGV, Serve());
  EXPECT_EQ(ReadAll(bench_.Path("together")), "");
  EXPECT_EQ(OnDisk("sent").crashes, 1);
  EXPECT_EQ(Serve(), 0);
  const auto failed = OnDisk("sent");
  EXPECT_EQ(failed.status, JobStatus::kFailed);
  EXPECT_EQ(failed.crashes, 2);
  EXPECT_EQ(failed.starts, 2);
  EXPECT_THAT(failed.failure, HasSubstr("twice"));
  EXPECT_THAT(failed.failure, HasSubstr("SIGSEGV (invalid access to memory) at 20"));
  EXPECT_EQ(OnDisk("ready").status, JobStatus::kDone);
  EXPECT_EQ(OnDisk("ready too").status, JobStatus::kDone);

  // Asked for again it gets one more try.
  Store()->Again("sent");
  EXPECT_EQ(OnDisk("sent").status, JobStatus::kQueued);
  ExpectEndedBy(SIGSEGV, Serve());
  EXPECT_EQ(Serve(), 0);
  EXPECT_THAT(OnDisk("sent").failure, HasSubstr("3 times"));
}

TEST_F(JobCrash, EveryKindIsMarked) {
  const std::map<std::string, int> signals = {
      {"address", SIGSEGV}, {"overflow", SIGSEGV}, {"thread", SIGSEGV}, {"abort", SIGABRT}};
  for (const auto& [request, signal] : signals) {
    Add(request);
    ExpectEndedBy(signal, Serve());
    const auto marks = ReadCrashMarks(Marks());
    ASSERT_EQ(marks.size(), 1u) << request;
    EXPECT_EQ(marks[0].signal, signal) << request;
    EXPECT_EQ(marks[0].job, OnDisk(request).number) << request;
    ExpectEndedBy(signal, Serve());
    EXPECT_EQ(Serve(), 0);
    EXPECT_EQ(OnDisk(request).status, JobStatus::kFailed) << request;
  }
}

TEST_F(JobCrash, AThreadOfNoJobLeavesNoMark) {
  const pid_t child = fork();
  if (child == 0) {
    const CrashMarks marks(Marks());
    std::raise(SIGSEGV);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ExpectEndedBy(SIGSEGV, WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
  EXPECT_TRUE(ReadCrashMarks(Marks()).empty());
}

TEST_F(JobCrash, OddMarksMarkNothing) {
  Add("ready");
  Store()->Start("ready");
  bench_.Write("catalog-jobs-crash",
               std::string("1 x\n99999999999999999999 11 1\n77 11 1\n\n") + std::string(100, '\0'));
  EXPECT_EQ(Serve(), 0);
  EXPECT_EQ(OnDisk("ready").crashes, 0);
  EXPECT_EQ(OnDisk("ready").status, JobStatus::kDone);
  EXPECT_THAT(Describe({1, 11, INT64_MAX}), HasSubstr("at 9999-"));
}

}  // namespace job_crash_test
}  // namespace plenum::server
