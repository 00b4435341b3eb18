#include "calibration/names/wrong_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plenum::calibration {
namespace {

constexpr double kAtEnd = 1e-6;  // of the range that was searched

std::vector<std::string> IdsInsteadOfNumbers(std::span<const Contender> contenders, double memory) {
  std::vector<Contender> without_numbers;
  for (const Contender& contender : contenders)
    if (EffectsAlone(contender.effects) == contender.effects) without_numbers.push_back(contender);
  std::vector<std::string> ids;
  for (const model::EffectSpec* spec : without_numbers[Standing(without_numbers, memory)].effects)
    ids.emplace_back(spec->id);
  return ids;
}

std::string Tenths(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

std::vector<WrongNumber> WrongNumbersOf(const Dataset& dataset, const Contender& named,
                                        std::span<const Contender> contenders, double memory) {
  std::vector<WrongNumber> wrong;
  for (const model::EffectSpec* spec : named.effects) {
    const std::optional<Declared> number = FreedBy(*spec);
    if (!number) continue;
    const auto at = static_cast<std::size_t>(*number);
    const double stated = dataset.relative_uncertainty[at];
    const double factor = named.fit.state.factor[at];
    wrong.push_back(
        {.number = *number,
         .factor = factor,
         .deviation_sigma = (factor - 1.0) / (stated > 0.0 ? stated : kExactUncertainty),
         .instead_of = {}});
  }
  if (wrong.empty()) return wrong;
  const std::vector<std::string> instead_of = IdsInsteadOfNumbers(contenders, memory);
  for (WrongNumber& one : wrong) one.instead_of = instead_of;
  return wrong;
}

std::vector<std::string> FarNumbers(const Fit& fit) {
  std::vector<std::string> sentences;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Coordinate& coordinate = fit.coordinates[j];
    if (coordinate.parameter.kind != Parameter::Kind::kDeclared) continue;
    const double u = fit.u[static_cast<Eigen::Index>(j)];
    const double room = kAtEnd * (coordinate.high - coordinate.low);
    const std::string name(Name(coordinate.parameter.declared));
    if (u <= coordinate.low + room || u >= coordinate.high - room)
      sentences.push_back(name +
                          " ended at an end of what was searched: the readings do not fix it");
    else if (coordinate.prior && std::abs(u) > kFarSigmas)
      sentences.push_back(name + " was fitted " + Tenths(std::abs(u)) +
                          " of its standard deviations from what was declared");
  }
  return sentences;
}

}  // namespace plenum::calibration
