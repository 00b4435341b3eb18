#include "calibration/learn/term_bounds.h"

#include <algorithm>
#include <span>
#include <string_view>

namespace plenum::calibration {
namespace {

// Numbers that shape a term: of them an interval over all that is searched, and of the first two an
// end of it, is no fault of the term.
constexpr std::string_view kShapes[] = {"critical_ratio", "width", "centre", "time_constant_s"};

bool IsAmong(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Whether a number of the last effect ended where the search does, its absence apart.
bool EndsAtBound(const Fit& fit, std::size_t j) {
  const Coordinate& coordinate = fit.coordinates[j];
  const double u = fit.u[static_cast<Eigen::Index>(j)];
  const std::string_view name =
      fit.state.effects.back().spec->parameters[coordinate.parameter.number].name;
  return coordinate.AtEnd(u) && coordinate.Number(u) != 0.0 &&
         !IsAmong(std::span(kShapes).first(2), name);
}

// Values on knots, of which some may lie where no reading is.
bool IsCurve(const model::EffectSpec& spec) { return spec.law.find('_') != std::string_view::npos; }

}  // namespace

std::vector<std::size_t> NumbersOfTerm(const Fit& fit) {
  std::vector<std::size_t> numbers;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind == Parameter::Kind::kEffect &&
        parameter.effect + 1 == fit.state.effects.size())
      numbers.push_back(j);
  }
  return numbers;
}

bool IsWithin(const Fit& fit) {
  const std::vector<std::size_t> numbers = NumbersOfTerm(fit);
  const auto at_bound = std::count_if(numbers.begin(), numbers.end(),
                                      [&](std::size_t j) { return EndsAtBound(fit, j); });
  return IsCurve(*fit.state.effects.back().spec)
             ? at_bound < static_cast<std::ptrdiff_t>(numbers.size())
             : at_bound == 0;
}

bool IsFound(const FitData& data, const Fit& fit, const FitOptions& options) {
  if (!IsWithin(fit)) return false;
  const std::vector<std::size_t> numbers = NumbersOfTerm(fit);
  const std::vector<Estimate> intervals = Intervals(fit, Covariance(data, fit, options));
  const auto open = std::count_if(numbers.begin(), numbers.end(), [&](std::size_t j) {
    const Coordinate& coordinate = fit.coordinates[j];
    const double low = coordinate.Number(coordinate.low), high = coordinate.Number(coordinate.high);
    const std::string_view name =
        fit.state.effects.back().spec->parameters[coordinate.parameter.number].name;
    return !IsAmong(kShapes, name) && intervals[j].low <= std::min(low, high) &&
           intervals[j].high >= std::max(low, high);
  });
  return IsCurve(*fit.state.effects.back().spec)
             ? open < static_cast<std::ptrdiff_t>(numbers.size())
             : open == 0;
}

FittedEffect LearnedOf(const FitData& data, const Fit& fit, const FitOptions& options) {
  FittedEffect learned{fit.state.effects.back(), {}};
  for (const double number : learned.effect.parameters)
    learned.parameters.push_back({number, number, number, false});
  const std::vector<Estimate> estimates = Intervals(fit, Covariance(data, fit, options));
  for (const std::size_t j : NumbersOfTerm(fit))
    learned.parameters[fit.coordinates[j].parameter.number] = estimates[j];
  return learned;
}

bool OfOnePlace(const std::vector<model::Effect>& effects, const model::Effect& term) {
  return term.spec->place == model::EffectPlace::kSensor &&
         std::all_of(effects.begin(), effects.end(), [&](const model::Effect& effect) {
           return effect.spec->place == term.spec->place;
         });
}

}  // namespace plenum::calibration
