// What is too long for every commit, for which ./test.sh full has time.
#ifndef PLENUM_TESTS_SUPPORT_IN_FULL_H_
#define PLENUM_TESTS_SUPPORT_IN_FULL_H_

#include <cstdlib>

namespace plenum::test {

inline bool InFull() { return std::getenv("PLENUM_FULL") != nullptr; }

// How many of a test's draws are made: all in full, else a third.
inline int Draws(int all) { return InFull() ? all : (all + 2) / 3; }

}  // namespace plenum::test

// At the top of a test that takes half a minute and more.
#define PLENUM_ONLY_IN_FULL() \
  if (!plenum::test::InFull()) GTEST_SKIP() << "too long for every commit: ./test.sh full"

#endif  // PLENUM_TESTS_SUPPORT_IN_FULL_H_
