#include "calibration/noise/noise_memory.h"

#include <algorithm>
#include <cmath>

namespace plenum::calibration {
namespace {

constexpr double kLeastVariance = 1e-6;  // of an innovation: the same instant again
constexpr double kSameGap = 1e-3;        // of a gap: what a clock's digits make of even sampling
constexpr double kThetaAbout = 1.3, kShareAbout = 0.1;
constexpr int kSections = 9;

// −2·ln L of the series, their variance at its likeliest.
double Misfit(std::span<const NoiseSeries> series, const NoiseMemory& memory) {
  double squares = 0.0, logs = 0.0, count = 0.0;
  for (const NoiseSeries& one : series) {
    InnovationSteps steps(memory);
    double remembered = 0.0, scale = 1.0, log_scale = 0.0;
    for (std::size_t i = 0; i < one.e.size(); ++i) {
      if (!std::isfinite(one.e[i])) continue;
      const Innovation step = steps.Next(one.t_s[i]);
      const double expected = step.carry * remembered;
      const double off = one.e[i] - expected;
      remembered = expected + step.gain * off;
      squares += off * off * step.scale * step.scale;
      if (step.scale != scale) {  // at even spacing it soon stays the same
        scale = step.scale;
        log_scale = std::log(scale);
      }
      logs -= 2.0 * log_scale;
      count += 1.0;
    }
  }
  return count > 0.0 && squares > 0.0 ? count * std::log(squares / count) + logs : 0.0;
}

struct Least {
  double at = 0.0, value = 0.0;
};

// Golden section.
template <class Function>
Least Minimise(const Function& function, double low, double high) {
  const double ratio = (std::sqrt(5.0) - 1.0) / 2.0;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = function(a), at_b = function(b);
  for (int i = 0; i < kSections; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low), at_a = function(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low), at_b = function(b);
    }
  }
  return at_a < at_b ? Least{a, at_a} : Least{b, at_b};
}

}  // namespace

Innovation InnovationSteps::Next(double t_s) {
  const auto& [theta_s, share] = memory_;
  if (!(theta_s > 0.0)) return {};
  const double gap_s = t_s - last_s_;
  last_s_ = t_s;
  if (!(std::abs(gap_s - gap_s_) <= kSameGap * gap_s_)) {
    carry_ = std::exp(-gap_s / theta_s);
    gap_s_ = std::isfinite(gap_s) ? gap_s : 0.0;
  }
  const double before = carry_ * carry_ * variance_ + share * (1.0 - carry_ * carry_);
  const double total = before + 1.0 - share;
  if (total < kLeastVariance) {
    variance_ = 0.0;
    return {};
  }
  variance_ = before * (1.0 - before / total);
  return {carry_, before / total, 1.0 / std::sqrt(total)};
}

std::vector<double> Whitened(std::span<const double> t_s, std::span<const double> e,
                             const NoiseMemory& memory) {
  std::vector<double> white(e.begin(), e.end());
  InnovationSteps steps(memory);
  double remembered = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (!std::isfinite(e[i])) continue;
    const Innovation step = steps.Next(t_s[i]);
    const double expected = step.carry * remembered;
    white[i] = (e[i] - expected) * step.scale;
    remembered = expected + step.gain * (e[i] - expected);
  }
  return white;
}

double ThirdDifference(double rho, double share) {
  return 1.0 - share * (1.5 - 0.6 * rho + 0.1 * rho * rho) * rho;
}

NoiseMemory LikeliestMemory(std::span<const NoiseSeries> series,
                            std::span<const NoiseMemory> allowed,
                            const std::function<bool()>& cancelled) {
  const auto misfit_of = [&](const NoiseMemory& memory) {
    return cancelled && cancelled() ? 0.0 : Misfit(series, memory);
  };
  NoiseMemory best;
  double least = std::numeric_limits<double>::infinity();
  for (const NoiseMemory& memory : allowed) {
    const double misfit = misfit_of(memory);
    if (misfit < least) best = memory, least = misfit;
  }
  if (best.theta_s == 0.0) return best;
  const double lowest = std::max(0.0, best.share - kShareAbout);
  const double highest = std::min(1.0, best.share + kShareAbout);
  const auto best_share = [&](double theta_s) {
    return Minimise([&](double share) { return misfit_of({theta_s, share}); }, lowest, highest);
  };
  const double theta_s = Minimise([&](double at) { return best_share(at).value; },
                                  best.theta_s / kThetaAbout, best.theta_s * kThetaAbout)
                             .at;
  return {theta_s, best_share(theta_s).at};
}

}  // namespace plenum::calibration
