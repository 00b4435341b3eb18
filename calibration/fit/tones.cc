#include "calibration/fit/tones.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace plenum::calibration {
namespace {

constexpr std::size_t kSamples = 1500;  // of a run that are looked at
constexpr double kPerPeak = 4.0;        // frequencies over the width of a peak, 1/T
constexpr double kFastest = 30.0;       // turns within a stroke
constexpr double kNyquist = 0.4;        // of the sampling rate looked at

// One run's residual, whitened by its noise, and what the template is made of.
struct Course {
  std::size_t run = 0;
  std::vector<double> t_s, residual;
  std::vector<double> kept, driven_pa;  // κ and D' − κ·D
  double sigma_pa = 1.0;
};

// The command in force, −1 before the first.
int CommandAt(const Run& run, double t_s) {
  const auto next = std::upper_bound(
      run.valve.begin(), run.valve.end(), t_s,
      [](double t, const model::ValveCommand& command) { return t < command.time_s; });
  return static_cast<int>(next - run.valve.begin()) - 1;
}

// κ from sample k − 1 to k, where the valve has stood the same since k − 2.
double Kept(const Run& run, const std::vector<double>& t_s, const std::vector<double>& p_pa,
            std::size_t k) {
  if (k < 2) return 1.0;
  const int command = CommandAt(run, t_s[k]);
  if (command < 0 || command != CommandAt(run, t_s[k - 2])) return 1.0;
  if (run.valve[static_cast<std::size_t>(command)].state == model::ValveState::kHold) return 1.0;
  const double rate = (p_pa[k] - p_pa[k - 1]) / (t_s[k] - t_s[k - 1]);
  const double before = (p_pa[k - 1] - p_pa[k - 2]) / (t_s[k - 1] - t_s[k - 2]);
  return before == 0.0 ? 1.0 : std::clamp(rate / before, 0.0, 1.0);
}

std::vector<double> Thinned(const std::vector<double>& values, std::size_t every) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < values.size(); k += every) kept.push_back(values[k]);
  return kept;
}

std::optional<Course> CourseOf(const FitData& data, const ModelState& state, Swinging what,
                               std::size_t index, const FitOptions& options) {
  const Run& run = data.forward->dataset().runs[index];
  const ObservedRun& observed = (*data.observed)[index];
  std::vector<Parameter> source;
  if (what == Swinging::kSupply)
    source.push_back({.kind = Parameter::Kind::kDeclared, .declared = Declared::kSourcePressure});
  PredictOptions predict;
  predict.steps_max = options.steps_max;
  predict.cancelled = options.cancelled;
  const Prediction model = data.forward->Predict(index, state, source, predict);
  if (model.status != model::SimulateStatus::kDone) return {};
  const std::vector<double> residual = PressureResidual(run, observed, model.reading);
  const std::size_t every = std::max<std::size_t>(1, residual.size() / kSamples);
  Course course;
  course.run = index;
  course.sigma_pa = observed.signals.front().sigma;
  course.t_s = Thinned(run.t_s, every);
  for (const double r : Thinned(residual, every))
    course.residual.push_back(std::isnan(r) ? 0.0 : r / course.sigma_pa);
  if (what == Swinging::kSupply) {
    const double share =
        run.source_pressure_pa / (run.source_pressure_pa - run.ambient.pressure_pa);
    const std::vector<double> p_pa = Thinned(model.reading.pressure_pa, every);
    const std::vector<double> response_pa = Thinned(model.derivatives[0].pressure_pa, every);
    for (std::size_t k = 0; k < p_pa.size(); ++k) {
      course.kept.push_back(Kept(run, course.t_s, p_pa, k));
      const double before_pa = k > 0 ? response_pa[k - 1] : 0.0;
      course.driven_pa.push_back(share * (response_pa[k] - course.kept[k] * before_pa));
    }
  }
  for (double& t_s : course.t_s) t_s -= StartOf(run);
  return course;
}

// The sine and cosine of the template that fit best, and by how much χ² falls.
struct Match {
  double sine = 0.0, cosine = 0.0, gain = 0.0;
};

Match MatchOf(const Course& course, Swinging what, double frequency_hz) {
  const double turn = 2.0 * std::numbers::pi * frequency_hz;
  std::complex<double> wave = 0.0;
  double ss = 0.0, sc = 0.0, cc = 0.0, se = 0.0, ce = 0.0;
  for (std::size_t k = 0; k < course.t_s.size(); ++k) {
    const std::complex<double> now = std::polar(1.0, turn * course.t_s[k]);
    wave = what == Swinging::kSensor ? now : wave * course.kept[k] + course.driven_pa[k] * now;
    const double s = wave.imag() / course.sigma_pa, c = wave.real() / course.sigma_pa;
    ss += s * s, sc += s * c, cc += c * c;
    se += s * course.residual[k], ce += c * course.residual[k];
  }
  const double determinant = ss * cc - sc * sc;
  if (!(determinant > 1e-6 * ss * cc)) return {};
  Match match{(cc * se - sc * ce) / determinant, (ss * ce - sc * se) / determinant, 0.0};
  match.gain = match.sine * se + match.cosine * ce;
  return match;
}

Tone ToneAt(const std::vector<Course>& courses, Swinging what, double frequency_hz,
            std::size_t runs) {
  Tone tone{frequency_hz, 0.0, std::vector<double>(runs, 0.0)};
  for (const Course& course : courses) {
    const Match match = MatchOf(course, what, frequency_hz);
    tone.phase_rad[course.run] = std::atan2(match.cosine, match.sine);
    tone.amplitude += match.sine * match.sine + match.cosine * match.cosine;
  }
  tone.amplitude = std::sqrt(tone.amplitude / static_cast<double>(courses.size()));
  return tone;
}

}  // namespace

std::vector<Tone> TonesOf(const FitData& data, const ModelState& state, Swinging what,
                          std::size_t count, const FitOptions& options) {
  std::vector<Course> courses;
  double longest_s = 0.0, interval_s = 0.0;
  for (const std::size_t run : data.runs) {
    std::optional<Course> course = CourseOf(data, state, what, run, options);
    if (!course) return {};
    const double length_s = course->t_s.back() - course->t_s.front();
    longest_s = std::max(longest_s, length_s);
    interval_s = std::max(interval_s, length_s / static_cast<double>(course->t_s.size() - 1));
    courses.push_back(std::move(*course));
  }
  if (courses.empty()) return {};
  const double step_hz = 1.0 / (kPerPeak * longest_s);
  const double last_hz = std::min(kNyquist / interval_s, kFastest / data.sizes.stroke_s);
  std::vector<double> gains;
  for (double hz = step_hz; hz < last_hz; hz += step_hz) {
    double gain = 0.0;
    for (const Course& course : courses) gain += MatchOf(course, what, hz).gain;
    gains.push_back(gain);
  }
  std::vector<Tone> tones;
  while (tones.size() < count) {
    const auto most = std::max_element(gains.begin(), gains.end());
    if (most == gains.end() || !(*most > 0.0)) break;
    const std::ptrdiff_t at = most - gains.begin();
    tones.push_back(ToneAt(courses, what, static_cast<double>(at + 1) * step_hz,
                           data.forward->dataset().runs.size()));
    const auto width = static_cast<std::ptrdiff_t>(kPerPeak);
    const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(gains.size());
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, at - width);
         k <= std::min(at + width, end - 1); ++k)
      gains[static_cast<std::size_t>(k)] = 0.0;
  }
  return tones;
}

}  // namespace plenum::calibration
