#include "calibration/values/parallel.h"

#include <gtest/gtest.h>
#include <sched.h>

#include "calibration/search/contenders.h"

namespace plenum::calibration {
namespace parallel_test {

TEST(Parallel, AProcessHeldToOneCoreUsesOneThread) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(UsableCores(), CPU_COUNT(&before));
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(UsableCores(), 1);
  EXPECT_EQ(SearchOptions().threads, 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

}  // namespace parallel_test
}  // namespace plenum::calibration
