// Carries out the experiment that a diagnosis proposes, on the case's true rig.
//   extend_case TRUTH.json ANSWER.json OUT.json
// OUT.json is the case's measurement with that run added, recorded by the same sensor and by those
// that the answer asks for beside it.
#include <cstdio>
#include <exception>
#include <fstream>

#include "tests/support/bench/bench_channels.h"
#include "tests/support/bench/bench_json.h"

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
    const plenum::test::BenchCase bench = plenum::test::CaseOfTruth(truth);
    const plenum::test::BenchRun run = ExperimentFromJson(bench, answer.at("next_experiment"));
    plenum::api::Json measurement = MeasurementJson(bench);
    const int number = static_cast<int>(bench.runs.size());
    plenum::api::Json json = RunJson(bench, run, Observe(bench, run, number));
    for (const std::string channel : answer["next_experiment"]["measure"])
      if (channel != "pressure_kpa_gauge" && !json["channels"].contains(channel))
        json["channels"][channel] = ChannelReadings(bench, run, number, channel);
    measurement["runs"].push_back(std::move(json));
    std::ofstream(argv[3]) << measurement.dump() << '\n';
  } catch (const std::exception& e) {
    std::fprintf(stderr, "extend_case: %s\n", e.what());
    return 3;
  }
  return 0;
}
