#include "calibration/judge/identifiability.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

bool IsStatedInstant(const Coordinate& coordinate) {
  const Parameter::Kind kind = coordinate.parameter.kind;
  return coordinate.prior &&
         (kind == Parameter::Kind::kInstant || kind == Parameter::Kind::kSharedInstant);
}

// What is left to the others where number j is as well known as data and prior make it.
void Eliminate(Eigen::Index j, Eigen::MatrixXd& curvature) {
  const Eigen::VectorXd column = curvature.col(j);
  curvature -= column * column.transpose() / column[j];
}

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

bool IsRestVolume(const Parameter& parameter) {
  return parameter.kind == Parameter::Kind::kDeclared &&
         parameter.declared == Declared::kRestVolume;
}

// The measured numbers of a group that are as well known as the rest volume; none where the group
// is of other numbers, too.
std::vector<std::size_t> KnownByVolume(const Dataset& dataset, const Fit& fit,
                                       const std::vector<std::size_t>& group) {
  using Kind = MeasuredNumber::Kind;
  bool volume = false;
  std::vector<std::size_t> measured;
  for (const std::size_t j : group) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (IsRestVolume(parameter))
      volume = true;
    else if (parameter.kind != Parameter::Kind::kMeasured)
      return {};
    else if (const Kind kind = dataset.measured[parameter.number].kind;
             kind == Kind::kConductance || kind == Kind::kDelivery)
      measured.push_back(j);
  }
  return volume ? measured : std::vector<std::size_t>();
}

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

std::string OfVolume(const Identifiability& found) {
  const bool one = found.by_volume.size() == 1u;
  const bool stated = found.volume_uncertainty > 0.0 && std::isfinite(found.volume_uncertainty);
  const std::string share = Percent(stated ? found.volume_uncertainty : 0.01);
  return Joined(found.by_volume) + (one ? " is" : " are") +
         " known only as well as the volume of the bottle" +
         (stated ? ", which is declared to " + share : "") + ": where the volume is " + share +
         " wrong, so " + (one ? "is it." : "are they.");
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
    case Parameter::Kind::kSharedInstant:
      return "what instants share";
    case Parameter::Kind::kDeclared:
      break;
  }
  std::string name(Name(parameter.declared));
  if (!OfEachSpecimen(state, parameter.declared)) return name;
  return name + OfSpecimenInWords(dataset.specimens[parameter.specimen]);
}

// Without priors but those of stated instants, and beside those.
static std::optional<Eigen::MatrixXd> CurvatureOfData(const FitData& data, const Fit& fit,
                                                      const FitOptions& options) {
  std::optional<Eigen::MatrixXd> curvature = Curvature(data, fit, options);
  if (!curvature) return {};
  for (Eigen::Index j = 0; j < curvature->rows(); ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    if (IsStatedInstant(coordinate))
      Eliminate(j, *curvature);
    else if (coordinate.prior)
      (*curvature)(j, j) -= 1.0;
  }
  return curvature;
}

std::optional<Identifiability> Identify(const FitData& data, const Fit& fit,
                                        const FitOptions& options) {
  const std::optional<Eigen::MatrixXd> curvature = CurvatureOfData(data, fit, options);
  if (!curvature) return {};
  const Dataset& dataset = data.forward->dataset();
  const auto size = static_cast<std::size_t>(curvature->rows());
  std::vector<std::string> names;
  for (const Coordinate& coordinate : fit.coordinates)
    names.push_back(NameOf(coordinate.parameter, fit.state, dataset));
  Identifiability found;
  found.volume_uncertainty =
      dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)];
  std::vector<std::size_t> heard;  // not silent
  for (std::size_t j = 0; j < size; ++j) {
    if (IsStatedInstant(fit.coordinates[j])) continue;
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
    std::vector<std::size_t> group;
    for (Eigen::Index a = 0; a < count; ++a) {
      const std::size_t j = heard[static_cast<std::size_t>(a)];
      if (std::abs(eigen.vectors(a, v)) >= kTakesPart && deviation(a) > Unfixed(fit.coordinates[j]))
        group.push_back(j);
    }
    if (group.size() < 2) continue;
    const std::vector<std::size_t> by_volume = KnownByVolume(dataset, fit, group);
    for (const std::size_t j : by_volume)
      if (std::find(found.by_volume.begin(), found.by_volume.end(), names[j]) ==
          found.by_volume.end())
        found.by_volume.push_back(names[j]);
    if (!by_volume.empty()) continue;
    std::vector<std::string>& alias = found.aliases.emplace_back();
    for (const std::size_t j : group) alias.push_back(names[j]);
  }
  return found;
}

std::vector<std::string> Sentences(const Identifiability& found) {
  std::vector<std::string> sentences;
  if (!found.silent.empty())
    sentences.push_back("The data say nothing about " + Joined(found.silent) +
                        ": what is shown is what was declared or assumed.");
  if (!found.by_volume.empty()) sentences.push_back(OfVolume(found));
  for (auto group = found.aliases.begin(); group != found.aliases.end(); ++group) {
    // Several directions may have the same names.
    if (std::find(found.aliases.begin(), group, *group) != group) continue;
    sentences.push_back("The data fix only a combination of " + Joined(*group) +
                        ", not each of them.");
  }
  return sentences;
}

}  // namespace plenum::calibration
