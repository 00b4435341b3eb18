// Anderson acceleration of x ← F(x): the next iterate is the image of that affine combination of
// the last iterates whose residuals F(x) − x cancel best, in the least squares of the components
// over their scales. Near a fixed point it finds as many slow modes as it is deep.
// Source: Walker and Ni, SIAM J. Numer. Anal. 49 (2011), type II without damping.
#ifndef PLENUM_MODEL_INTEGRATE_ANDERSON_H_
#define PLENUM_MODEL_INTEGRATE_ANDERSON_H_

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <deque>

namespace plenum::model {

class Anderson {
 public:
  explicit Anderson(std::size_t depth) : depth_(depth) {}

  void Clear() { pairs_.clear(); }

  // `image` = F(x); x and image alone until there is a history.
  Eigen::VectorXd Next(const Eigen::VectorXd& x, const Eigen::VectorXd& image,
                       const Eigen::VectorXd& scale) {
    pairs_.push_back({x, image});
    // More differences than components determine nothing.
    const std::size_t most = 1 + std::min(depth_, static_cast<std::size_t>(x.size()));
    if (pairs_.size() > most) pairs_.pop_front();
    const Eigen::Index columns = static_cast<Eigen::Index>(pairs_.size()) - 1;
    if (columns == 0) return image;

    Eigen::MatrixXd images(x.size(), columns), residuals(x.size(), columns);
    for (Eigen::Index k = 0; k < columns; ++k) {
      const Pair& pair = pairs_[static_cast<std::size_t>(k)];
      const Pair& next = pairs_[static_cast<std::size_t>(k) + 1];
      images.col(k) = next.image - pair.image;
      residuals.col(k) = (images.col(k) - (next.x - pair.x)).cwiseQuotient(scale);
      // Of equal length, so that the rank is judged by directions.
      const double length = residuals.col(k).norm();
      if (length > 0.0) images.col(k) /= length, residuals.col(k) /= length;
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(kDependent);
    qr.compute(residuals);
    return image - images * qr.solve((image - x).cwiseQuotient(scale));
  }

 private:
  static constexpr double kDependent = 1e-8;
  struct Pair {
    Eigen::VectorXd x, image;
  };
  std::size_t depth_;
  std::deque<Pair> pairs_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_ANDERSON_H_
