#include "tests/support/bench/bench_channels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "tests/support/flow/iso_chain.h"

namespace plenum::test {
namespace {

constexpr double kNoiseShare = 0.01, kTemperatureNoiseK = 0.5;
constexpr double kSpanS = 1e-5;  // over which a flow is a difference
constexpr double kWidthPa = 1e-3;
constexpr std::uint64_t kChannelStream = 3000;

// The true rig at each sample and a moment later: a sample at a switch sees what comes of it.
struct Moments {
  EffectRig plant;
  EffectResult course;
  double At(const std::vector<double>& values, std::size_t i) const { return values[2 * i]; }
  double Rate(const std::vector<double>& values, std::size_t i) const {
    return (values[2 * i + 1] - values[2 * i]) / kSpanS;
  }
};

// Between valve and tube: the pressure that sends the flow through the tube.
double Inlet(const Moments& moments, std::size_t i) {
  const EffectRig& plant = moments.plant;
  const double end_pa = moments.At(moments.course.node_pa, i);
  if (plant.fill.size() < 2) return end_pa;
  const double density = kReferenceDensity * std::sqrt(kReferenceK / plant.ambient_k);
  const double in = moments.Rate(moments.course.filled_kg, i);
  const double out = moments.Rate(moments.course.emptied_kg, i);
  if (in > 0.0) {
    MassElement tube = plant.fill.back();
    tube.conductance *= plant.fill_factor;
    const double supply_pa = moments.At(moments.course.supply_pa, i);
    return Bisect(
        end_pa, std::max(end_pa, supply_pa),
        [&](double p) { return in - ChainFlow({tube}, p, end_pa, density, plant.linear_ratio); },
        kWidthPa);
  }
  if (out <= 0.0) return end_pa;
  return Bisect(
      plant.ambient_pa, end_pa,
      [&](double p) {
        return ChainFlow({plant.exhaust.front()}, end_pa, p, density, plant.linear_ratio) - out;
      },
      kWidthPa);
}

double ChannelAt(const BenchCase& bench, const Moments& moments, std::size_t i,
                 const std::string& channel) {
  const double ambient_pa = bench.declared.ambient_pa;
  const EffectResult& course = moments.course;
  if (channel == "flow_l_per_min_anr")
    return moments.Rate(course.filled_kg, i) / kReferenceDensity * 6e4;
  if (channel == "temperature_k") return moments.At(course.temperature_k, i);
  if (channel == "volume_ml")
    return (moments.At(course.volume_m3, i) - moments.plant.dead_volume_m3) * 1e6;
  if (channel == "source_pressure_kpa_gauge")
    return (moments.At(course.supply_pa, i) - ambient_pa) * 1e-3;
  if (channel == "inlet_pressure_kpa_gauge") return (Inlet(moments, i) - ambient_pa) * 1e-3;
  throw std::invalid_argument("bench_channels: no channel " + channel);
}

}  // namespace

std::vector<double> ChannelReadings(const BenchCase& bench, const BenchRun& run, int number,
                                    const std::string& channel) {
  std::vector<double> t_s;
  for (const double at_s : run.t_s) {
    t_s.push_back(at_s);
    t_s.push_back(at_s + kSpanS);
  }
  Moments moments{Plant(bench.declared, run, bench.factors),
                  TrueCourse(bench, run, number, bench.factors, bench.effects, t_s)};
  for (const TrueEffect& effect : bench.effects)
    Apply(effect, bench.declared, bench.seed, moments.plant);
  std::vector<double> readings;
  for (std::size_t i = 0; i < run.t_s.size(); ++i)
    readings.push_back(ChannelAt(bench, moments, i, channel));
  const auto [low, high] = std::minmax_element(readings.begin(), readings.end());
  double sigma = kNoiseShare * (*high - *low);
  if (channel == "temperature_k") sigma = std::max(sigma, kTemperatureNoiseK);
  if (channel.ends_with("kpa_gauge")) sigma = std::max(sigma, bench.sensor.noise_pa * 1e-3);
  Random random(bench.seed, kChannelStream + static_cast<std::uint64_t>(number));
  for (double& reading : readings) reading += sigma * random.Normal();
  return readings;
}

}  // namespace plenum::test
