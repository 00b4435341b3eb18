#include "api/protocol/test_sensor.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

constexpr double kLeastShare = 1e-4;  // of the largest pressure (calibration/fit/observations.cc)

}  // namespace

Parsed<TestSensor> ParseTestSensor(const std::multimap<std::string, std::string>& query) {
  Errors errors;
  const auto read = [&](const char* name, Range range) -> std::optional<double> {
    const auto found = query.find(name);
    if (found == query.end()) return {};
    const std::string& text = found->second;
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status == std::errc() && end == text.data() + text.size() && range.Contains(value))
      return value;
    errors.push_back(
        {std::string("/") + name, "must be a number " + range.Text() + ", not " + Quoted(text)});
    return {};
  };
  TestSensor sensor;
  sensor.noise_kpa = read("sensor_noise_kpa", SensorKpaRange()).value_or(sensor.noise_kpa);
  sensor.resolution_kpa =
      read("sensor_resolution_kpa", SensorKpaRange()).value_or(sensor.resolution_kpa);
  sensor.sampling_hz = read("sampling_hz", SamplingRange()).value_or(sensor.sampling_hz);
  sensor.bottle_l = read("bottle_l", BottleRange());
  sensor.bottle_uncertainty = read("bottle_uncertainty", BottleUncertaintyRange());
  if (!errors.empty()) return errors;
  return sensor;
}

double NumberOf(const catalog::Part& part, const char* field) {
  const auto number = part.numbers.find(field);
  return number == part.numbers.end() ? 0.0 : number->second.value;
}

double ReadingNoisePa(const TestSensor& sensor, double gauge_pa) {
  const double noise_kpa = std::hypot(sensor.noise_kpa, sensor.resolution_kpa / std::sqrt(12.0));
  return std::max(noise_kpa * kPaPerKpa, kLeastShare * gauge_pa);
}

}  // namespace plenum::api
