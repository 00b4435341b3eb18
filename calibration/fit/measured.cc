// Numbers of parts that runs measure: their coordinates, their intervals, derivatives to them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "calibration/fit/fit.h"
#include "calibration/values/measured_place.h"

namespace plenum::calibration {
namespace {

using Kind = MeasuredNumber::Kind;

constexpr double kSpan = 3.0;  // e-folds either way, of conductances and volumes
constexpr double kCriticalRatioMax = 0.95;
constexpr double kMostDelivery = 20.0;  // times the largest one declared
constexpr double kVolumeStep = 1e-3;    // of the factor on an actuator's volumes
constexpr double kDifferenceTolerance = 1e-7;
constexpr double kAtBound = 1e-6;  // of the range that was searched
constexpr double kTwoSided95 = 1.959964;

std::set<std::size_t> NumbersOf(const Run& run) {
  std::set<std::size_t> numbers(run.measured.delivery.begin(), run.measured.delivery.end());
  for (const MeasuredPlace& place : run.measured.places) numbers.insert(place.number);
  return numbers;
}

// Of the declared pump, its largest delivery.
double LargestDelivery(const Dataset& dataset, std::size_t number) {
  double largest = 0.0;
  for (const Run& run : dataset.runs)
    if (std::count(run.measured.delivery.begin(), run.measured.delivery.end(), number) > 0)
      largest = std::max(largest, run.compressor.free_air_m3_per_s.y().front());
  return largest;
}

Coordinate CoordinateOf(const Dataset& dataset, std::size_t number) {
  Coordinate coordinate;
  coordinate.parameter = {.kind = Parameter::Kind::kMeasured, .number = number};
  const MeasuredNumber& measured = dataset.measured[number];
  switch (measured.kind) {
    case Kind::kRatio:
      coordinate.high = kCriticalRatioMax;
      break;
    case Kind::kDelivery:
      coordinate.scale = LargestDelivery(dataset, number);
      coordinate.high = kMostDelivery;
      break;
    case Kind::kConductance:
    case Kind::kVolume:
      coordinate.kind = Coordinate::Kind::kLog;
      coordinate.scale = measured.declared;
      coordinate.low = -kSpan, coordinate.high = kSpan;
      break;
  }
  return coordinate;
}

// The coordinates of the points of a pump's table, by point; those of other numbers by themselves.
std::vector<std::vector<std::size_t>> Groups(const Dataset& dataset, const Fit& fit) {
  std::vector<std::vector<std::size_t>> groups;
  std::string pump;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind != Parameter::Kind::kMeasured) continue;
    const MeasuredNumber& number = dataset.measured[parameter.number];
    const bool delivery = number.kind == Kind::kDelivery;
    if (!delivery || number.part != pump) groups.emplace_back();
    pump = delivery ? number.part : "";
    groups.back().push_back(j);
  }
  return groups;
}

bool AtBound(const Coordinate& coordinate, double u) {
  const double room = kAtBound * (coordinate.high - coordinate.low);
  return u <= coordinate.low + room || u >= coordinate.high - room;
}

// Of a number that has a coordinate for itself.
MeasuredEstimate Alone(const Fit& fit, const Eigen::MatrixXd& covariance, std::size_t j) {
  const Coordinate& coordinate = fit.coordinates[j];
  const auto at = static_cast<Eigen::Index>(j);
  const double deviation = std::sqrt(covariance(at, at)), u = fit.u[at];
  const auto edge = [&](double sign) {
    return coordinate.Number(
        std::clamp(u + sign * kTwoSided95 * deviation, coordinate.low, coordinate.high));
  };
  return {.number = coordinate.parameter.number,
          .value = coordinate.Number(u),
          .low = edge(-1.0),
          .high = edge(1.0),
          .deviation = std::abs(coordinate.Slope(u)) * deviation,
          .at_bound = AtBound(coordinate, u)};
}

// Of the pump's delivery at the point `first` of its table: the sum of the falls from there on.
MeasuredEstimate DeliveryAt(const Fit& fit, const Eigen::MatrixXd& covariance,
                            const std::vector<std::size_t>& points, std::size_t first) {
  MeasuredEstimate estimate{.number = fit.coordinates[points[first]].parameter.number};
  double variance = 0.0;
  for (std::size_t a = first; a < points.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(points[a]);
    const Coordinate& one = fit.coordinates[points[a]];
    estimate.value += one.Number(fit.u[i]);
    for (std::size_t b = first; b < points.size(); ++b)
      variance += one.scale * fit.coordinates[points[b]].scale *
                  covariance(i, static_cast<Eigen::Index>(points[b]));
  }
  estimate.deviation = std::sqrt(std::max(0.0, variance));
  estimate.low = std::max(0.0, estimate.value - kTwoSided95 * estimate.deviation);
  estimate.high = estimate.value + kTwoSided95 * estimate.deviation;
  estimate.at_bound = !(estimate.value > 0.0);
  return estimate;
}

std::vector<double> Slope(const std::vector<double>& at, const std::vector<double>& moved,
                          double step) {
  std::vector<double> slope(std::min(at.size(), moved.size()));
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (moved[i] - at[i]) / step;
  return slope;
}

Reading Slope(const Reading& at, const Reading& moved, double step) {
  Reading slope;
  slope.pressure_pa = Slope(at.pressure_pa, moved.pressure_pa, step);
  for (const auto channel :
       {&Channels::source_pressure_pa, &Channels::inlet_pressure_pa, &Channels::temperature_k,
        &Channels::volume_m3, &Channels::flow_m3_per_s})
    slope.channels.*channel = Slope(at.channels.*channel, moved.channels.*channel, step);
  return slope;
}

}  // namespace

std::vector<Coordinate> MeasuredCoordinates(const Dataset& dataset,
                                            const std::vector<std::size_t>& runs) {
  std::set<std::size_t> numbers;
  for (const std::size_t run : runs) numbers.merge(NumbersOf(dataset.runs[run]));
  std::vector<Coordinate> coordinates;
  coordinates.reserve(numbers.size());
  for (const std::size_t number : numbers) coordinates.push_back(CoordinateOf(dataset, number));
  return coordinates;
}

std::vector<MeasuredEstimate> MeasuredEstimates(const Dataset& dataset, const Fit& fit,
                                                const Eigen::MatrixXd& covariance) {
  std::vector<double> declared;
  declared.reserve(dataset.measured.size());
  for (const MeasuredNumber& number : dataset.measured) declared.push_back(number.declared);
  declared = ValuesOf(dataset, declared);
  std::vector<MeasuredEstimate> estimates;
  for (const std::vector<std::size_t>& group : Groups(dataset, fit)) {
    const std::size_t number = fit.coordinates[group.front()].parameter.number;
    const bool delivery = dataset.measured[number].kind == Kind::kDelivery;
    for (std::size_t point = 0; point < group.size(); ++point) {
      estimates.push_back(delivery ? DeliveryAt(fit, covariance, group, point)
                                   : Alone(fit, covariance, group[point]));
      estimates.back().declared = declared[estimates.back().number];
    }
  }
  return estimates;
}

void WidenByRoom(const Dataset& dataset, std::vector<MeasuredEstimate>& estimates) {
  const double kelvin_share = kRoomK / dataset.runs.front().ambient.temperature_k;
  for (MeasuredEstimate& estimate : estimates) {
    const Kind kind = dataset.measured[estimate.number].kind;
    if (kind == Kind::kRatio) continue;
    const double room = (kind == Kind::kDelivery ? 1.0 : 0.5) * kelvin_share * estimate.value;
    const double half = kTwoSided95 * room;
    estimate.low = estimate.value - std::hypot(estimate.value - estimate.low, half);
    estimate.low = std::max(0.0, estimate.low);
    estimate.high = estimate.value + std::hypot(estimate.high - estimate.value, half);
    estimate.deviation = std::hypot(estimate.deviation, room);
  }
}

// The state a step of difference further along the factor on the run's table of volumes; none where
// it moves none.
static std::optional<ModelState> MovedTable(const Run& run, const Parameter& parameter,
                                            const ModelState& state) {
  const bool swells =
      parameter.kind == Parameter::Kind::kDeclared && parameter.declared == Declared::kRestVolume &&
      Concerns(parameter, run, state) && !ChamberOf(run, parameter.specimen).volume_curve.empty();
  if (!swells) return std::nullopt;
  ModelState moved = state;
  NumberOf(moved, parameter) += kVolumeStep;
  return moved;
}

void AddTableSlopes(const ForwardModel& forward, std::size_t run, const ModelState& state,
                    std::span<const Parameter> parameters, const PredictOptions& options,
                    Prediction& prediction) {
  if (prediction.status != model::SimulateStatus::kDone) return;
  PredictOptions tight = options;
  tight.relative_tolerance = std::min(options.relative_tolerance, kDifferenceTolerance);
  std::optional<Prediction> at;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto moved = MovedTable(forward.dataset().runs[run], parameters[j], state);
    if (!moved) continue;
    if (!at) at = forward.Predict(run, state, {}, tight);
    const Prediction there = forward.Predict(run, *moved, {}, tight);
    prediction.derivatives[j] = Slope(at->reading, there.reading, kVolumeStep);
  }
}

}  // namespace plenum::calibration
