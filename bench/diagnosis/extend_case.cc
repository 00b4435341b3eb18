// Carries out the experiment that a diagnosis proposes, on the case's true rig.
//   extend_case TRUTH.json ANSWER.json OUT.json
// OUT.json is the case's measurement with that run added, recorded by the same sensor.
#include <cstdio>
#include <exception>
#include <fstream>

#include "tests/support/bench_json.h"

namespace {

plenum::api::Json Read(const char* path) {
  std::ifstream file(path);
  return plenum::api::Json::parse(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: extend_case TRUTH.json ANSWER.json OUT.json\n");
    return 2;
  }
  try {
    const plenum::api::Json truth = Read(argv[1]), answer = Read(argv[2]);
    const plenum::test::BenchCase bench =
        plenum::test::CaseOfSeries(truth["series"], truth["index"]);
    const plenum::test::BenchRun run = ExperimentFromJson(bench, answer.at("next_experiment"));
    plenum::api::Json measurement = MeasurementJson(bench);
    const plenum::test::Record record = Observe(bench, run, static_cast<int>(bench.runs.size()));
    measurement["runs"].push_back(RunJson(bench, run, record));
    std::ofstream(argv[3]) << measurement.dump() << '\n';
  } catch (const std::exception& e) {
    std::fprintf(stderr, "extend_case: %s\n", e.what());
    return 3;
  }
  return 0;
}
