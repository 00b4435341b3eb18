// Writes measured data sets with known truth.
//   make_cases SERIES COUNT FOLDER [KIND]
// FOLDER/cases/NNNN.json are measurements, FOLDER/truth/NNNN.json what is true of them,
// FOLDER/perfect/NNNN.json the same measurements by a perfect sensor, with the size of the white
// noise that would say as little as the sensor's; what is there already is kept. With a KIND
// (clean, full, fifth, pair, outside) only the cases of that kind among the first COUNT of the
// series; with `tie` COUNT cases that may be ties; with `real` COUNT cases as a workshop records
// them; with `five` COUNT cases of all kinds in turn, each of five runs and one held out with 1,000
// samples.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/bench/bench_json.h"
#include "tests/support/bench/real_case.h"

namespace {

void Write(const std::filesystem::path& path, const plenum::api::Json& json) {
  std::ofstream file(path);
  file << json.dump() << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: make_cases SERIES COUNT FOLDER [KIND]\n");
    return 2;
  }
  const std::uint64_t series = std::strtoull(argv[1], nullptr, 10);
  const int count = std::atoi(argv[2]);
  const std::filesystem::path folder = argv[3];
  const std::string kind = argc > 4 ? argv[4] : "";
  const bool tie = kind == NameOf(plenum::test::CaseKind::kTie), five = kind == "five";
  const bool real = kind == NameOf(plenum::test::CaseKind::kReal);
  std::filesystem::create_directories(folder / "cases");
  std::filesystem::create_directories(folder / "truth");
  std::filesystem::create_directories(folder / "perfect");
  std::atomic<int> next = 0, failed = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      if (!tie && !five && !real && !kind.empty() && NameOf(plenum::test::KindOfSeries(i)) != kind)
        continue;
      char name[32];
      std::snprintf(name, sizeof name, "%04d.json", i);
      if (std::filesystem::exists(folder / "truth" / name)) continue;
      try {
        const plenum::test::BenchCase bench = tie    ? plenum::test::TieOfSeries(series, i)
                                              : real ? plenum::test::RealOfSeries(series, i)
                                                     : plenum::test::CaseOfSeries(series, i, five);
        Write(folder / "cases" / name, MeasurementJson(bench));
        Write(folder / "perfect" / name, {{"measurement", MeasurementJson(WithoutFaults(bench))},
                                          {"noise_pa", bench.sensor.EffectiveNoise()}});
        plenum::api::Json truth = TruthJson(bench);
        truth["series"] = series;
        truth["index"] = i;
        Write(folder / "truth" / name, truth);
      } catch (const std::exception& e) {
        std::fprintf(stderr, "case %d: %s\n", i, e.what());
        ++failed;
      }
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < 2; ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return failed > 0 ? 3 : 0;
}
