// Strokes per second and core: the scalar closed form and quadrature, and the batch functions in
// every variant that this machine supports. usage: bench_closed_form
#include "model/closed_form.h"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include "model/chamber.h"
#include "model/closed_form_batch.h"
#include "model/stroke.h"

namespace {

using namespace plenum::model;

constexpr std::size_t kCandidates = 1024;  // in cache, as a search would ask

// Evaluations per second of `pass`, which makes kCandidates of them.
template <class Pass>
double Rate(const Pass& pass) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double seconds = 0.0;
  std::size_t passes = 0;
  while (seconds < 0.3) {
    for (int i = 0; i < 16; ++i) pass();
    passes += 16;
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return static_cast<double>(passes * kCandidates) / seconds;
}

}  // namespace

int main() {
  std::mt19937_64 engine(7);
  const auto uniform = [&](double low, double high) {
    std::vector<double> values(kCandidates);
    for (double& value : values) value = std::uniform_real_distribution<double>(low, high)(engine);
    return values;
  };
  const Chamber chamber{5e-5, 1.7, 2e5, 1e5, 5e-6, {}};
  const auto c = uniform(1e-9, 1e-8), b = uniform(0.1, 0.5), source = uniform(2.2e5, 6e5),
             reservoir = uniform(5e-4, 5e-3);
  const std::vector<double> v0(kCandidates, Volume(chamber, 0.0)),
      v1(kCandidates, VolumeSlope(chamber, 0.0)), low(kCandidates, 1e5), end(kCandidates, 1.1e5),
      high(kCandidates, 2e5);
  const StrokeBatch rise{c, b, v0, v1, source, low, high, reservoir};
  const StrokeBatch fall{c, b, v0, v1, low, high, end, {}};
  std::vector<double> time_s(kCandidates);

  const auto stroke = [&](std::size_t i) { return NormalisedStroke{2.0, 1.6, b[i]}; };
  std::vector<Series> series;
  for (std::size_t i = 0; i < kCandidates; ++i) {
    FlowElement element;
    element.sonic_conductance_m3_per_s_pa = c[i];
    element.critical_ratio = b[i];
    series.push_back(MakeSeries({&element, 1}));
  }
  std::printf("%-12s %12s %12s %12s\n", "per second", "rise", "fall", "reservoir");
  const double scalar_rise = Rate([&] {
    for (std::size_t i = 0; i < kCandidates; ++i)
      time_s[i] = NormalisedRiseTime(stroke(i), source[i] * 1e-5, 1.0, 2.0);
  });
  const double scalar_fall = Rate([&] {
    for (std::size_t i = 0; i < kCandidates; ++i)
      time_s[i] = NormalisedFallTime(stroke(i), 2.0, 1.1);
  });
  const double scalar_reservoir = Rate([&] {
    for (std::size_t i = 0; i < kCandidates; ++i)
      time_s[i] = FillTimeFromReservoir(series[i], chamber, 1, reservoir[i], source[i], 1e5, 2e5);
  });
  std::printf("%-12s %12.3g %12.3g %12.3g\n", "scalar", scalar_rise, scalar_fall, scalar_reservoir);
  const char* const names[] = {"baseline", "avx2", "avx512"};
  for (const Instructions instructions :
       {Instructions::kBaseline, Instructions::kAvx2, Instructions::kAvx512}) {
    if (!Supported(instructions)) continue;
    const auto rate = [&](auto times, const StrokeBatch& batch) {
      return Rate([&] { times(batch, time_s, kReferenceTemperatureK, instructions); });
    };
    std::printf("%-12s %12.3g %12.3g %12.3g\n", names[static_cast<int>(instructions)],
                rate(RiseTimes, rise), rate(FallTimes, fall), rate(RiseTimesFromReservoir, rise));
  }
}
