#include "catalog/check/plausibility.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace {

constexpr double kOutlierZ = 3.5;
constexpr double kMedianToSigma = 1.4826;
constexpr double kLeastFactor = 1.5;  // what numbers of a family differ by anyway
constexpr std::size_t kFewest = 8;
constexpr char kDensity[] = "mass_kg / body_volume_ml";

struct Sample {
  const Part* part;
  double value, log;
};

// 0 < `values`.
double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// Whether no other maker has a part with about this number. Makers seldom make the same slip, but a
// family may hold parts of several kinds.
bool StandsAlone(const Sample& sample, const std::vector<Sample>& samples) {
  return std::none_of(samples.begin(), samples.end(), [&](const Sample& other) {
    return other.part->manufacturer != sample.part->manufacturer &&
           std::abs(other.log - sample.log) <= std::log(kLeastFactor);
  });
}

void Judge(const Family& family, const std::string& field, const std::vector<Sample>& samples,
           std::vector<Outlier>& outliers) {
  if (samples.size() < kFewest) return;
  std::vector<double> logs, deviations;
  for (const Sample& sample : samples) logs.push_back(sample.log);
  const double median = Median(logs);
  for (const double log : logs) deviations.push_back(std::abs(log - median));
  const double sigma = std::max(kMedianToSigma * Median(deviations), std::log(kLeastFactor));
  for (const Sample& sample : samples) {
    const double z = (sample.log - median) / sigma;
    if (std::abs(z) > kOutlierZ && StandsAlone(sample, samples))
      outliers.push_back(
          {sample.part->id, std::string(family.name), field, sample.value, std::exp(median), z});
  }
}

std::optional<double> Value(const Part& part, const std::string& field) {
  const auto found = part.numbers.find(field);
  if (found == part.numbers.end()) return std::nullopt;
  return found->second.value;
}

std::optional<double> Density(const Part& part) {
  const auto mass = Value(part, "mass_kg"), body = Value(part, "body_volume_ml");
  if (!mass || !body) return std::nullopt;
  return *mass / *body;
}

template <class Measure>
std::vector<Sample> Samples(const Family& family, const std::vector<Part>& parts,
                            const Measure& measure) {
  std::vector<Sample> samples;
  for (const Part& part : parts) {
    if (part.family != family.name) continue;
    const std::optional<double> value = measure(part);
    if (value && *value > 0 && std::isfinite(*value))
      samples.push_back({&part, *value, std::log(*value)});
  }
  return samples;
}

}  // namespace

std::vector<Outlier> FindOutliers(const std::vector<Part>& parts) {
  std::vector<Outlier> outliers;
  for (const Family& family : Families()) {
    for (const NumberField& field : family.numbers) {
      const std::string name(field.name);
      Judge(family, name,
            Samples(family, parts, [&](const Part& part) { return Value(part, name); }), outliers);
    }
    Judge(family, kDensity, Samples(family, parts, Density), outliers);
  }
  return outliers;
}

std::vector<Gap> FindGaps(const std::vector<Part>& parts) {
  std::vector<Gap> gaps;
  for (const Family& family : Families())
    for (const NumberField& field : family.numbers) {
      if (!field.name.starts_with("price_eur")) continue;
      Gap gap{std::string(family.name), std::string(field.name), "cost_eur", {}, 0};
      for (const Part& part : parts) {
        if (part.family != family.name) continue;
        ++gap.parts;
        if (!part.numbers.contains(gap.field)) gap.ids.push_back(part.id);
      }
      if (!gap.ids.empty()) gaps.push_back(std::move(gap));
    }
  return gaps;
}

}  // namespace plenum::catalog
