// The fuzzers' corpora once more: what was interesting stays harmless (tests/fuzz/run.sh finds
// more).
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/fuzz/computations.h"
#include "tests/fuzz/targets.h"
#include "tests/server/workbench.h"
#include "tests/support/places.h"

namespace plenum::fuzz {
namespace fuzz_corpus_test {

void Replay(const std::string& name, void (*target)(std::string_view)) {
  const auto folder = test::SourceDir() / "tests/fuzz/corpus" / name;
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    target(server::ReadAll(file.path()));
    ++files;
  }
  EXPECT_GT(files, 0) << folder;
}

TEST(Fuzz, Requirements) { Replay("requirements", Requirements); }
TEST(Fuzz, Measurement) { Replay("measurement", Measurement); }
TEST(Fuzz, Csv) { Replay("csv", Csv); }
TEST(Fuzz, Query) { Replay("query", Query); }
TEST(Fuzz, Frame) { Replay("frame", Frame); }
TEST(Fuzz, Design) { Replay("design", Design); }
TEST(Fuzz, Evaluation) { Replay("evaluation", Evaluation); }
TEST(Fuzz, Simulation) { Replay("simulation", Simulation); }
TEST(Fuzz, Diagnosis) { Replay("diagnosis", Diagnosis); }
TEST(Fuzz, Recording) { Replay("recording", Recording); }
TEST(Fuzz, Import) { Replay("import", Import); }
TEST(Fuzz, Verify) { Replay("verify", Verify); }

}  // namespace fuzz_corpus_test
}  // namespace plenum::fuzz
