#include "calibration/judge/closeness.h"

#include <cmath>
#include <limits>

#include "calibration/fit/run_worth.h"
#include "calibration/judge/evidence.h"
#include "calibration/values/symmetric.h"

namespace plenum::calibration {

double EvidenceOf(const Bench& bench, const Fit& fit, double memory) {
  std::optional<Eigen::MatrixXd> curvature = Curvature(bench.data, fit, bench.tight);
  if (!curvature) return std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < curvature->rows(); ++j) {
    const bool prior = fit.coordinates[static_cast<std::size_t>(j)].prior;
    (*curvature)(j, j) += memory - (prior ? 1.0 : 0.0);
  }
  const Eigen::VectorXd taken = PivotsOf(*curvature / memory);
  const double n = static_cast<double>(fit.rows);
  return n / memory * std::log(fit.chi2_data / n) + fit.chi2_prior + taken.array().log().sum();
}

Gap GapTo(const Bench& bench, const Fit& fit, const Fit& other, double memory) {
  std::vector<std::vector<double>> products = WhitenedOf(bench, fit);
  const std::vector<std::vector<double>> theirs = WhitenedOf(bench, other);
  double squares = 0.0;
  for (std::size_t run = 0; run < products.size(); ++run) {
    for (std::size_t i = 0; i < products[run].size(); ++i) {
      products[run][i] *= theirs[run][i] - products[run][i];
      squares += products[run][i] * products[run][i];
    }
  }
  const double unit = static_cast<double>(fit.rows) / fit.chi2_data / memory;
  const double more = unit * (other.chi2_data - fit.chi2_data);
  const double as_logarithm = unit * fit.chi2_data * std::log(other.chi2_data / fit.chi2_data);
  Gap gap;
  gap.size = BicWith(other, memory) - BicWith(fit, memory) + more - as_logarithm;
  if (squares > 0.0) gap.scatter = 2.0 * unit * std::sqrt(squares * MemoryOf(products));
  return gap;
}

}  // namespace plenum::calibration
