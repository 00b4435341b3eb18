// Held-out errors of corrections that know no physics (correction.h), on the base model as fitted
// to the readings.
//   rival FOLDER
// For each FOLDER/cases/NNNN.json writes FOLDER/rival/NNNN.json.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "api/measure/measurement.h"
#include "bench/diagnosis/correction.h"
#include "calibration/fit/fit.h"

namespace plenum::bench {
namespace {

using calibration::Dataset;

constexpr std::size_t kSamples = 250;  // of a run

Dataset ReadCase(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto parsed = api::ParseMeasurement(api::Json::parse(file));
  if (const auto* errors = std::get_if<api::Errors>(&parsed)) {
    throw std::runtime_error((*errors)[0].pointer + ": " + (*errors)[0].detail);
  }
  return std::get<Dataset>(parsed);
}

api::Json Errors(const Dataset& dataset) {
  const calibration::ForwardModel forward(dataset);
  const auto observed = calibration::Observe(dataset);
  calibration::FitData data;
  data.forward = &forward;
  data.observed = &observed;
  for (std::size_t r = 0; r + 1 < dataset.runs.size(); ++r) data.runs.push_back(r);
  data.sizes = calibration::SizesOf(dataset);
  const calibration::Fit fit = calibration::FitModel(data, forward.Declared(), {});
  if (!fit.Usable()) throw std::runtime_error("the base model could not be fitted");
  std::vector<Sample> runs;
  for (std::size_t r = 0; r < dataset.runs.size(); ++r) {
    const calibration::Run& run = dataset.runs[r];
    const auto reading = calibration::Predicted(data, fit.state, r, {});
    if (reading.pressure_pa.empty()) throw std::runtime_error("a run could not be predicted");
    const Eigen::MatrixXd features = Features(run, reading.pressure_pa);
    const auto residual = calibration::PressureResidual(run, observed[r], reading);
    std::vector<Eigen::Index> kept;
    const std::size_t every = std::max<std::size_t>(1, residual.size() / kSamples);
    for (std::size_t i = 0; i < residual.size(); i += every) {
      if (std::isfinite(residual[i])) kept.push_back(static_cast<Eigen::Index>(i));
    }
    Sample sample{features(kept, Eigen::all), Eigen::VectorXd(kept.size())};
    for (std::size_t i = 0; i < kept.size(); ++i) {
      sample.residual[static_cast<Eigen::Index>(i)] = residual[static_cast<std::size_t>(kept[i])];
    }
    runs.push_back(std::move(sample));
  }
  const Sample& last = runs.back();
  const double base_pa =
      last.residual.norm() / std::sqrt(static_cast<double>(last.residual.size()));
  return {{"base_kpa", base_pa * 1e-3},
          {"ridge_kpa", RidgeError(runs) * 1e-3},
          {"neighbours_kpa", NeighbourError(runs) * 1e-3}};
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: rival FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "rival");
  int failed = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cases")) {
    const std::filesystem::path answer = folder / "rival" / entry.path().filename();
    if (std::filesystem::exists(answer)) continue;
    try {
      const auto json = plenum::bench::Errors(plenum::bench::ReadCase(entry.path()));
      std::ofstream(answer) << json.dump() << '\n';
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s: %s\n", entry.path().c_str(), e.what());
      ++failed;
    }
  }
  return failed > 0 ? 3 : 0;
}
