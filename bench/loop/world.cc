#include "bench/loop/world.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "api/design/read/worst_parts.h"
#include "catalog/fields/fields.h"

namespace plenum::bench {
namespace {

constexpr double kFar = 3.0, kFarthest = 4.0;  // standard deviations

// FNV-1a.
constexpr std::uint64_t kBasis = 0xcbf29ce484222325ull;
std::uint64_t HashOf(std::string_view text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return (hash ^ 0xff) * 0x100000001b3ull;  // the end of a text
}

double InRange(const catalog::Part& row, const std::string& field, double value) {
  for (const catalog::NumberField& known : catalog::FindFamily(row.family)->numbers)
    if (known.name == field) return std::clamp(value, known.min, known.max);
  return value;
}

class Drawing {
 public:
  Drawing(const catalog::Part& row, std::string_view world, Weights weights)
      : row_(row), world_(world), weights_(weights) {}

  double FactorOf(const std::string& field, catalog::Provenance provenance,
                  const std::optional<double>& uncertainty) const {
    const bool as_printed =
        weights_ == Weights::kAsPrinted && api::WorstOf(row_.family, field) == api::Worst::kSum;
    const double half_width = api::HalfWidth(row_, field, api::Tolerance());
    if (as_printed || half_width == 0.0) return 1.0;
    return std::exp(uncertainty.value_or(0.5 * half_width) *
                    ErrorInDeviations(world_, row_.id, field, provenance));
  }

 private:
  const catalog::Part& row_;
  std::string_view world_;
  Weights weights_;
};

catalog::Part TruthOf(const catalog::Part& row, std::string_view world, Weights weights) {
  const Drawing drawing(row, world, weights);
  catalog::Part truth = row;
  for (auto& [field, number] : truth.numbers)
    number.value = InRange(
        row, field, number.value * drawing.FactorOf(field, number.provenance, number.uncertainty));
  if (row.curve) {
    const catalog::Curve& curve = *row.curve;
    const double delivery =
        drawing.FactorOf("free_air", curve.free_air_provenance, curve.free_air_uncertainty);
    const double current =
        drawing.FactorOf("current", curve.current_provenance, curve.current_uncertainty);
    for (catalog::CurvePoint& point : truth.curve->points) {
      point.free_air_l_per_min *= delivery;
      point.current_a *= current;
    }
  }
  return truth;
}

}  // namespace

double ErrorInDeviations(std::string_view world, const std::string& part, std::string_view field,
                         catalog::Provenance provenance) {
  std::mt19937_64 generator(HashOf(field, HashOf(part, HashOf(world, kBasis))));
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  if (provenance == catalog::Provenance::kEstimated && uniform(0.0, 1.0) < kFarShare) {
    const double far = uniform(kFar, kFarthest);
    return uniform(0.0, 1.0) < 0.5 ? -far : far;
  }
  std::normal_distribution<double> normal;
  double error = normal(generator);
  while (std::abs(error) > kFar) error = normal(generator);
  return error;
}

std::uint64_t SeedOf(std::string_view world) { return HashOf(world, kBasis); }

std::vector<catalog::Part> DrawWorld(std::vector<catalog::Part> rows, std::string_view world,
                                     Weights weights) {
  for (catalog::Part& row : rows) row = TruthOf(row, world, weights);
  return rows;
}

}  // namespace plenum::bench
