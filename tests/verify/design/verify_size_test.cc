// A verifier that is told to stop does so within a stroke, wherever it is in the sizing of a
// design.
#include "verify/design/verify_size.h"

#include <gtest/gtest.h>

#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace verify_size_test {

// With a reservoir of any volume a sizing takes thousands of strokes, and there the question was
// once never asked.
TEST(VerifySizeTest, StopsWithinAStroke) {
  optimizer::Problem problem = EasyProblem(3, {optimizer::Configuration::kCompressor});
  verify::Assembly assembly;
  assembly.configuration = optimizer::Configuration::kCompressor;
  assembly.lines = {
      {&problem.parts.tubing[0], &problem.parts.fittings[0], &problem.parts.valves[0]}};
  assembly.compressor = &problem.parts.compressors[0];
  assembly.compressors = 1;
  assembly.battery = &problem.parts.batteries[0];
  assembly.batteries = 1;
  const auto asked = [&](int allowed) {
    int questions = 0;
    verify::Sizer sizer(problem, [&] { return ++questions > allowed; });
    const verify::Sizing sizing = sizer.Size(assembly, 1e-6, verify::kUnlimited);
    return std::pair(questions, sizing.status);
  };
  const auto [all, status] = asked(1 << 30);
  ASSERT_GT(all, 200) << "the sizing asks at every stroke";
  for (int allowed : {0, 1, 10, all / 2, all - 2}) {
    SCOPED_TRACE(allowed);
    const auto [questions, stopped] = asked(allowed);
    EXPECT_LE(questions, allowed + 5);
    if (allowed <= 10) {
      EXPECT_EQ(stopped, verify::Sized::kUnknown);
    }
  }
}

}  // namespace verify_size_test
}  // namespace plenum::test
