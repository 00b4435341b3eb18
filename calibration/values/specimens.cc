#include "calibration/values/specimens.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plenum::calibration {
namespace {

constexpr double kAnything = 1.0;  // of the factor of a number of which nothing is known

// The factors of the specimens that the runs tell.
std::vector<double> ToldFactors(const Dataset& dataset, std::span<const std::size_t> runs,
                                const ModelState& state, Declared number) {
  std::vector<double> factors;
  for (const std::size_t specimen : SpecimensWith(dataset, runs, number))
    factors.push_back(state.specimen_factor[static_cast<std::size_t>(number)][specimen]);
  return factors;
}

}  // namespace

bool OfEachSpecimen(const Dataset& dataset, Declared number) {
  const auto at = static_cast<std::size_t>(number);
  return at < kOfActuator && dataset.specimens.size() > 1 &&
         (dataset.several || dataset.relative_uncertainty[at] > 0.0);
}

std::array<std::vector<double>, kOfActuator> DeclaredFactors(const Dataset& dataset) {
  std::array<std::vector<double>, kOfActuator> factors;
  for (std::size_t k = 0; k < factors.size(); ++k)
    if (OfEachSpecimen(dataset, static_cast<Declared>(k)))
      factors[k].assign(dataset.specimens.size(), 1.0);
  return factors;
}

std::vector<std::size_t> SpecimensWith(const Dataset& dataset, std::span<const std::size_t> runs,
                                       Declared number) {
  const bool each = OfEachSpecimen(dataset, number);
  std::set<std::size_t> specimens;
  for (const std::size_t index : runs) {
    const Run& run = dataset.runs[index];
    for (std::size_t i = 0; each && dataset.several && i < run.several.pieces(); ++i)
      if (Has(run, number, i)) specimens.insert(i);
    if (Has(run, number) && !(each && dataset.several)) specimens.insert(each ? run.specimen : 0);
  }
  return {specimens.begin(), specimens.end()};
}

std::vector<Declared> UntoldNumbers(const Dataset& dataset, std::span<const std::size_t> runs,
                                    std::size_t run) {
  std::vector<Declared> untold;
  if (dataset.several) return untold;
  for (int k = 0; k < kOfActuator; ++k) {
    const auto number = static_cast<Declared>(k);
    if (!OfEachSpecimen(dataset, number) || !Has(dataset.runs[run], number)) continue;
    const std::vector<std::size_t> told = SpecimensWith(dataset, runs, number);
    if (!told.empty() && !std::binary_search(told.begin(), told.end(), dataset.runs[run].specimen))
      untold.push_back(number);
  }
  return untold;
}

double MeanFactor(const Dataset& dataset, std::span<const std::size_t> runs,
                  const ModelState& state, Declared number) {
  const std::vector<double> told = ToldFactors(dataset, runs, state, number);
  return told.empty() ? 1.0 : MeanOf(told);
}

void TakeMeans(const Dataset& dataset, std::span<const std::size_t> runs, ModelState& state) {
  if (dataset.several) return;  // a chamber that has the number is told by each run
  for (std::size_t k = 0; k < state.specimen_factor.size(); ++k) {
    const auto number = static_cast<Declared>(k);
    if (!OfEachSpecimen(state, number)) continue;
    const std::vector<std::size_t> told = SpecimensWith(dataset, runs, number);
    const double mean = MeanFactor(dataset, runs, state, number);
    for (std::size_t specimen = 0; specimen < state.specimen_factor[k].size(); ++specimen)
      if (!std::binary_search(told.begin(), told.end(), specimen))
        state.specimen_factor[k][specimen] = mean;
  }
}

double ScatterOf(const Dataset& dataset, std::span<const std::size_t> runs, const ModelState& state,
                 Declared number) {
  const double declared = dataset.relative_uncertainty[static_cast<std::size_t>(number)];
  const std::vector<double> told = ToldFactors(dataset, runs, state, number);
  if (told.size() < 2) return declared == kUnknown ? kAnything : declared;
  const double between =
      DeviationOf(told) * std::sqrt(1.0 + 1.0 / static_cast<double>(told.size()));
  return declared == kUnknown ? between : std::max(between, declared);
}

double MeanOf(std::span<const double> numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}

double DeviationOf(std::span<const double> numbers) {
  const double mean = MeanOf(numbers);
  double squares = 0.0;
  for (const double number : numbers) squares += (number - mean) * (number - mean);
  return std::sqrt(squares / static_cast<double>(numbers.size() - 1));
}

std::string OfSpecimenInWords(const std::string& specimen) {
  return specimen.empty() ? " of the runs without a specimen" : " of " + specimen;
}

}  // namespace plenum::calibration
