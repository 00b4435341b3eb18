// Searches that take too much memory together.
#include "server/jobs/job_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>
#include <vector>

#include "server/resources/designs_resource.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace job_memory_test {

TEST(JobMemory, TheLargestSearchEndsAndTheOthersGoOn) {
  std::size_t resident = 1000;
  JobMemory memory(100, [&] { return resident; });
  const auto small = memory.Enter();
  auto large = memory.Enter();
  resident = 1100;
  small->Report(1);
  large->Report(9);
  EXPECT_FALSE(large->must_end());
  resident = 1101;
  small->Report(2);
  EXPECT_TRUE(large->must_end());
  small->Report(3);  // while the other one ends
  EXPECT_FALSE(small->must_end());
  large.reset();
  resident = 1050;
  small->Report(4);
  EXPECT_FALSE(small->must_end());
  resident = 1200;
  small->Report(5);
  EXPECT_TRUE(small->must_end());
}

TEST(JobMemory, IsMeasuredFromBeforeTheFirstSearch) {
  std::size_t resident = 1000;
  JobMemory memory(100, [&] { return resident; });
  memory.Enter()->Report(1);
  resident = 5000;  // a large catalogue
  const auto search = memory.Enter();
  search->Report(1);
  EXPECT_FALSE(search->must_end());
}

TEST(JobMemory, OfThisProcessIsRead) {
  const std::size_t before = ResidentBytes();
  const std::vector<char> block(64 << 20, 'x');
  EXPECT_GT(ResidentBytes(), before + (32 << 20));
}

// In processes whose heap nobody used, as with a sanitizer: there about one in sixty ended by
// glibc's own assertion.
TEST(JobMemory, ManyThreadsReturnTheirsAtOnce) {
  const auto all_at_once = [] {
    constexpr int kThreads = 8;
    std::atomic<int> ready = 0;
    std::vector<std::thread> threads;
    threads.reserve(kThreads);
    for (int i = 0; i < kThreads; ++i)
      threads.emplace_back([&ready] {
        ++ready;
        while (ready < kThreads) std::this_thread::yield();
        ReturnFreeMemory();
      });
    for (std::thread& thread : threads) thread.join();
    _exit(0);
  };
  for (int i = 0; i < 300; ++i) {
    const pid_t child = fork();
    if (child == 0) all_at_once();
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << i;
  }
}

// As at its time limit: the best that it has, with its gap, and the reason.
TEST(JobMemory, ASearchEndsFeasibleAtItsLimit) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  std::size_t resident = 0;
  JobMemory memory(1, [&] { return resident++; });
  const Work work = DesignWork(catalog, memory);
  const auto head = catalog.Head();
  catalog::JobOrder order;
  order.request = SlowToProve(100.0).dump();
  order.revision = head.number;
  order.hash = head.hash;
  const auto outcome = work(order, {[] { return false; }, [](const api::Json&) {}});
  ASSERT_TRUE(std::holds_alternative<api::Json>(outcome));
  const auto& answer = std::get<api::Json>(outcome);
  EXPECT_EQ(answer["status"], "feasible");
  EXPECT_LT(answer["seconds"], 60.0);
  EXPECT_NE(answer["warnings"].dump().find("memory"), std::string::npos);
}

}  // namespace job_memory_test
}  // namespace plenum::server
