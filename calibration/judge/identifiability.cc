#include "calibration/judge/identifiability.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/run_worth.h"
#include "calibration/values/specimens.h"
#include "calibration/values/symmetric.h"

namespace plenum::calibration {
namespace {

constexpr double kLeastCurvature = 1e-14;
constexpr double kTakesPart = 0.25;  // of a unit eigenvector

// The deviation in u from which a coordinate counts as not fixed.
double Unfixed(const Coordinate& coordinate) {
  const bool range = coordinate.kind == Coordinate::Kind::kLinear && !coordinate.prior;
  return kUnidentified * (range ? std::min(1.0, coordinate.high - coordinate.low) : 1.0);
}

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

}  // namespace

std::string NameOf(const Parameter& parameter, const ModelState& state, const Dataset& dataset) {
  switch (parameter.kind) {
    case Parameter::Kind::kEffect: {
      const model::EffectSpec& spec = *state.effects[parameter.effect].spec;
      return std::string(spec.id) + "." + std::string(spec.parameters[parameter.number].name);
    }
    case Parameter::Kind::kMeasured: {
      const MeasuredNumber& number = dataset.measured[parameter.number];
      return number.name + " of " + number.part;
    }
    case Parameter::Kind::kInitialPressure:
      return "initial pressure of " + dataset.runs[parameter.run].id;
    case Parameter::Kind::kInitialTemperature:
      return "initial temperature of " + dataset.runs[parameter.run].id;
    case Parameter::Kind::kClock:
      return "clock of " + dataset.runs[parameter.run].id;
    case Parameter::Kind::kPhase:
      return "phase of " + dataset.runs[parameter.run].id;
    case Parameter::Kind::kLateness:
      return "time of command " + std::to_string(parameter.number + 1) + " of " +
             dataset.runs[parameter.run].id;
    case Parameter::Kind::kInstant:
      return "instant of command " + std::to_string(parameter.number + 1) + " of " +
             dataset.runs[parameter.run].id;
    case Parameter::Kind::kDeclared:
      break;
  }
  const std::string name(Name(parameter.declared));
  if (!OfEachSpecimen(state, parameter.declared)) return name;
  return name + OfSpecimenInWords(dataset.specimens[parameter.specimen]);
}

std::optional<Identifiability> Identify(const FitData& data, const Fit& fit,
                                        const FitOptions& options) {
  std::optional<Eigen::MatrixXd> curvature = Curvature(data, fit, options);
  if (!curvature) return {};
  const auto size = static_cast<std::size_t>(curvature->rows());
  std::vector<std::string> names;
  for (std::size_t j = 0; j < size; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    if (fit.coordinates[j].prior) (*curvature)(at, at) -= 1.0;
    names.push_back(NameOf(fit.coordinates[j].parameter, fit.state, data.forward->dataset()));
  }
  Identifiability found;
  std::vector<std::size_t> heard;  // not silent
  for (std::size_t j = 0; j < size; ++j) {
    const double alone = (*curvature)(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j));
    if (alone > std::pow(Unfixed(fit.coordinates[j]), -2))
      heard.push_back(j);
    else
      found.silent.push_back(names[j]);
  }
  const auto count = static_cast<Eigen::Index>(heard.size());
  if (count < 2) return found;
  Eigen::MatrixXd scaled(count, count);
  Eigen::VectorXd root(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const auto i = static_cast<Eigen::Index>(heard[static_cast<std::size_t>(a)]);
    root[a] = std::sqrt((*curvature)(i, i));
  }
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b < count; ++b)
      scaled(a, b) = (*curvature)(static_cast<Eigen::Index>(heard[static_cast<std::size_t>(a)]),
                                  static_cast<Eigen::Index>(heard[static_cast<std::size_t>(b)])) /
                     (root[a] * root[b]);
  const SymmetricEigen eigen = EigenOf(scaled);
  const Eigen::VectorXd spread = eigen.values.cwiseMax(kLeastCurvature).cwiseInverse();
  const auto deviation = [&](Eigen::Index a) {
    return std::sqrt(eigen.vectors.row(a).cwiseAbs2().dot(spread.transpose())) / root[a];
  };
  for (Eigen::Index v = 0; v < count && eigen.values[v] < kAliasEigenvalue; ++v) {
    std::vector<std::string> group;
    for (Eigen::Index a = 0; a < count; ++a) {
      const std::size_t j = heard[static_cast<std::size_t>(a)];
      if (std::abs(eigen.vectors(a, v)) >= kTakesPart && deviation(a) > Unfixed(fit.coordinates[j]))
        group.push_back(names[j]);
    }
    if (group.size() > 1) found.aliases.push_back(std::move(group));
  }
  return found;
}

std::vector<std::string> Sentences(const Identifiability& found) {
  std::vector<std::string> sentences;
  if (!found.silent.empty())
    sentences.push_back("The data say nothing about " + Joined(found.silent) +
                        ": what is shown is what was declared or assumed.");
  for (auto group = found.aliases.begin(); group != found.aliases.end(); ++group) {
    // Several directions may have the same names.
    if (std::find(found.aliases.begin(), group, *group) != group) continue;
    sentences.push_back("The data fix only a combination of " + Joined(*group) +
                        ", not each of them.");
  }
  return sentences;
}

}  // namespace plenum::calibration
