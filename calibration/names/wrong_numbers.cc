#include "calibration/names/wrong_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "calibration/judge/identifiability.h"

namespace plenum::calibration {
namespace {

std::vector<std::string> IdsInsteadOfNumbers(std::span<const Contender> contenders, double memory) {
  std::vector<Contender> without_numbers;
  for (const Contender& contender : contenders)
    if (EffectsAlone(contender.effects) == contender.effects) without_numbers.push_back(contender);
  std::vector<std::string> ids;
  for (const model::EffectSpec* spec : without_numbers[Standing(without_numbers, memory)].effects)
    ids.emplace_back(spec->id);
  return ids;
}

// Whether a number of 0 is the effect's absence. Of others, which shape what an effect does, 0 is
// an end as any.
bool IsStrength(const Parameter& parameter, const ModelState& state) {
  const std::string_view name =
      state.effects[parameter.effect].spec->parameters[parameter.number].name;
  for (const std::string_view shape : {"critical_ratio", "damping_ratio", "start_share"})
    if (name == shape) return false;
  return true;
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
    const std::optional<std::size_t> chamber = ChamberFreedBy(*spec);
    const auto at = static_cast<std::size_t>(*number);
    const double stated = dataset.relative_uncertainty[at];
    for (const Coordinate& coordinate : named.fit.coordinates) {
      const Parameter& parameter = coordinate.parameter;
      if (parameter.kind != Parameter::Kind::kDeclared || parameter.declared != *number) continue;
      if (chamber && parameter.specimen != *chamber) continue;
      WrongNumber& one = wrong.emplace_back();
      one.number = *number;
      one.factor = NumberOf(named.fit.state, parameter);
      one.deviation_sigma = (one.factor - 1.0) / (stated > 0.0 ? stated : kExactUncertainty);
      if (OfEachSpecimen(named.fit.state, *number))
        one.specimen = dataset.specimens[parameter.specimen];
    }
  }
  if (wrong.empty()) return wrong;
  const std::vector<std::string> instead_of = IdsInsteadOfNumbers(contenders, memory);
  for (WrongNumber& one : wrong) one.instead_of = instead_of;
  return wrong;
}

std::vector<std::string> FarNumbers(const Dataset& dataset, const Fit& fit) {
  std::vector<std::string> sentences;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Coordinate& coordinate = fit.coordinates[j];
    const Parameter::Kind kind = coordinate.parameter.kind;
    if (kind != Parameter::Kind::kDeclared && kind != Parameter::Kind::kEffect) continue;
    const double u = fit.u[static_cast<Eigen::Index>(j)];
    const bool absent = kind == Parameter::Kind::kEffect && coordinate.Number(u) == 0.0 &&
                        IsStrength(coordinate.parameter, fit.state);
    const std::string name = NameOf(coordinate.parameter, fit.state, dataset);
    if (coordinate.AtEnd(u) && !absent)
      sentences.push_back(name +
                          " ended at an end of what was searched: the readings do not fix it");
    else if (coordinate.prior && std::abs(u) > kFarSigmas)
      sentences.push_back(name + " was fitted " + Tenths(std::abs(u)) +
                          " of its standard deviations from what was declared");
  }
  return sentences;
}

void AddLimits(const Bench& bench, const Fit& shown, Diagnosis& diagnosis) {
  std::vector<std::string>& warnings = diagnosis.warnings;
  for (std::string& sentence : FarNumbers(bench.dataset, shown))
    warnings.push_back(std::move(sentence));
  if (Stopped(bench)) {
    warnings.emplace_back(
        diagnosis.verdict == Verdict::kUndecided
            ? "stopped before all sets of effects were compared: what is listed is the best so far"
            : "stopped after the verdict: a learned term, the next experiment or held-out errors "
              "may be lacking");
  } else if (const auto found = Identify(bench.data, shown, bench.tight)) {
    for (std::string& sentence : Sentences(*found)) warnings.push_back(std::move(sentence));
  }
}

}  // namespace plenum::calibration
